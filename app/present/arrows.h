// Arrows for what acts: contact forces, normals, velocities, wind; and the ladder of forces at the
// side.
#pragma once

#include <span>

#include "app/present/joints.h"
#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// How long arrows are, the same in all pictures of a run.
struct ArrowScale {
  double longest = 1.0;   ///< [m] of a force of the scene
  double fastest = 1.0;   ///< [m/s] of the longest velocity, twice as long
  double contact = 1.0;   ///< [N] of the longest contact force
  JointScale joint = {};  ///< of what joints exert
  /// [N] of the longest arrow of contacts and joints that are shown together
  double together(const ShowFlags& show) const;
};

/// About as long as bodies are high, but no longer than a share of the motion's radius [m]: arrows
/// as large as a picture would make bodies small. With forces of joints at least a share of it.
ArrowScale arrowScale(const Scene& scene, const Recording& recording, double fastest,
                      double radius);

/// All that the scene's `show` asks for of the following, and what joints exert.
void addArrows(const Scene& scene, const Sample& sample, const ArrowScale& scale, Picture& picture);

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
/// out, evenly. Bars stand to the right of the ways of other bodies [m] that would cross them.
void addForceLadder(const Scene& scene, const Sample& sample, const Eigen::Vector2d& page,
                    std::span<const Eigen::AlignedBox3d> ways, Picture& picture);

/// Whether the flags leave room for a ladder: a matrix stands in its place.
bool showsForceLadder(const ShowFlags& show);

/// Whether a ladder stands in any picture of the run.
bool hasForceLadder(const Scene& scene, const Recording& recording);

}  // namespace tumble
