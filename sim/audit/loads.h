// Chapter 10, audit: the forces of a scene, told once more from their definitions.
#pragma once

#include <span>
#include <vector>

#include "sim/audit/recorded.h"
#include "sim/body/force.h"

namespace tumble {

/// What the listed forces do at one instant; gravity is left out. World frame, SI.
struct Loads {
  std::vector<Vec3> force, torque;  ///< [N], [N m] per body, about its centre of mass
  std::vector<double> power;  ///< [W] per body: of all but the potentials of springs and fields

  /// @param bodies  masses, and which are fixed
  /// @param points  one per body
  void sum(std::span<const Force> forces, std::span<const RigidBody> bodies,
           std::span<const PathPoint> points);
};

/// The body that a spring is booked with: its first end that moves; kNoBody if none does.
int bearerOf(const Spring& spring, std::span<const RigidBody> bodies);

/// Energy [J] that a force has stored and that is booked with body `of`: of a field, its own.
double storedIn(const Force& force, std::span<const RigidBody> bodies,
                std::span<const Recorded> states, int of);

}  // namespace tumble
