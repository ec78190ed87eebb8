// Arrows for what acts: contact forces, normals, velocities, wind; and the ladder of forces at the
// side.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// The force [N] whose arrow is longest: nearly the largest of the run, impacts that are rare left
/// out.
double largestContactForce(const Recording& recording);

/// One arrow per contact point, on the body that is pushed up; length proportional to the force,
/// `fmax` [N] drawn `length` [m] long.
void addContactForces(const Sample& sample, double fmax, double length, Picture& picture);

/// Contact normals, `length` [m] long.
void addNormals(const Sample& sample, double length, Picture& picture);

/// Velocities of the centres of mass, one of `fastest` [m/s] drawn `length` [m] long.
void addVelocities(const Scene& scene, const Sample& sample, double fastest, double length,
                   Picture& picture);

/// Uniform and point forces, the largest drawn `length` [m] long, or all by a scale [m/N] that is
/// not 0. They blow onto the bodies. If asked for, they have names, and each body its sum and
/// torque.
void addForces(const Scene& scene, const Sample& sample, double length, Picture& picture,
               double scale = 0.0, bool resultant = false);

/// A bar for each pair of bodies that touch in the tallest group of touching bodies: the sum of the
/// pair's contact forces in newtons, as long as it is large, level with the contact.
/// The picture's camera decides where on a page of that many pixels; rows that do not fit are left
/// out, evenly.
void addForceLadder(const Scene& scene, const Sample& sample, const Eigen::Vector2d& page,
                    Picture& picture);

}  // namespace tumble
