// Chapter 5, collide: the shape pairs, one file each. Only the table in collide.cpp calls them.
//
// Every pair gives the three functions of collide.h for its own two types, in one order; the table
// swaps. `collide` appends its points to `out`.
#pragma once

#include "sim/collide/contact_point.h"
#include "sim/shape/shape.h"

namespace tumble::pairs {

double separation(const Sphere& a, const Pose& poseA, const Sphere& b, const Pose& poseB);
ContactPoint separatingPlane(const Sphere& a, const Pose& poseA, const Sphere& b,
                             const Pose& poseB);
void collide(const Sphere& a, const Pose& poseA, const Sphere& b, const Pose& poseB, double margin,
             Manifold& out);

double separation(const Sphere& a, const Pose& poseA, const Box& b, const Pose& poseB);
ContactPoint separatingPlane(const Sphere& a, const Pose& poseA, const Box& b, const Pose& poseB);
void collide(const Sphere& a, const Pose& poseA, const Box& b, const Pose& poseB, double margin,
             Manifold& out);

double separation(const Sphere& a, const Pose& poseA, const HalfSpace& b, const Pose&);
ContactPoint separatingPlane(const Sphere& a, const Pose& poseA, const HalfSpace& b, const Pose&);
void collide(const Sphere& a, const Pose& poseA, const HalfSpace& b, const Pose&, double margin,
             Manifold& out);

double separation(const Box& a, const Pose& poseA, const Box& b, const Pose& poseB);
ContactPoint separatingPlane(const Box& a, const Pose& poseA, const Box& b, const Pose& poseB);
void collide(const Box& a, const Pose& poseA, const Box& b, const Pose& poseB, double margin,
             Manifold& out);

double separation(const Box& a, const Pose& poseA, const HalfSpace& b, const Pose&);
ContactPoint separatingPlane(const Box& a, const Pose& poseA, const HalfSpace& b, const Pose&);
void collide(const Box& a, const Pose& poseA, const HalfSpace& b, const Pose&, double margin,
             Manifold& out);

// The general path, for any two solids that have a core (core.h), and for one and a half-space.

double convexSeparation(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB);
ContactPoint convexPlane(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB);
void convexCollide(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
                   double margin, Manifold& out);

double convexSeparation(const Shape& a, const Pose& poseA, const HalfSpace& b);
ContactPoint convexPlane(const Shape& a, const Pose& poseA, const HalfSpace& b);
void convexCollide(const Shape& a, const Pose& poseA, const HalfSpace& b, double margin,
                   Manifold& out);

}  // namespace tumble::pairs
