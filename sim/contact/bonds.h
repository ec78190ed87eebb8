// Chapter 7, contact: what holds bodies besides contacts, as rows for the same problem.
#pragma once

#include <span>
#include <vector>

#include "sim/body/rigid_body.h"
#include "sim/problem/problem.h"

namespace tumble {

/// Rows that others made – joints and their limits – to be solved together with those of contacts.
/// b of a row may be the number of bodies: the world, which never moves.
struct Bonds {
  std::vector<Row> rows;
  std::vector<ConeKind> kinds;  ///< per row: Equality or Push
  std::vector<int> owners;      ///< per row: the joint that it belongs to; −1: none
  std::vector<int> places;      ///< per row: its number among all rows of its owner
  std::vector<double> lambda;   ///< per row: force [N, N m] or impulse, as found
  double misfit = 0.0;          ///< [1] widest gap of an equality, of the arm of its joint

  bool empty() const { return rows.empty(); }
  void clear();
  void add(const Row& row, ConeKind kind, int owner, int place);
};

/// Appends the rows, and the world as the last body of the problem. Their first cone is what the
/// number of cones was.
void appendBonds(const Bonds& bonds, Problem& problem);

/// The multipliers of rows that were appended at that row of the problem.
void readBonds(std::span<const double> lambda, std::size_t firstRow, Bonds& bonds);

/// Adds λ to force and torque of the bodies.
void addBondForces(const Bonds& bonds, std::span<RigidBody> bodies);

/// Adds λ to the momenta of the bodies, and updates what is derived.
void addBondImpulses(const Bonds& bonds, std::span<RigidBody> bodies);

/// u of one row at the velocities that the bodies have, without bias.
double bondVelocity(const Row& row, std::span<const RigidBody> bodies);

/// Its rate under the forces and torques that the bodies carry, with the row's bias, J̇ v.
double bondAcceleration(const Row& row, std::span<const RigidBody> bodies);

/// What comes from fixed partners, of λ as they stand: force [N] or impulse on bodies that move,
/// and its power [W] or work at the velocities that the fixed ones have.
struct OuterBonds {
  Vec3 force = Vec3::Zero();
  double power = 0.0;
};
OuterBonds outerBonds(const Bonds& bonds, std::span<const RigidBody> bodies);

}  // namespace tumble
