// What bends, in a step: its part of the matrix and of the right side of the contact problem.
#pragma once

#include <memory>
#include <vector>

#include "sim/method/model.h"
#include "sim/problem/block_cholesky.h"

namespace tumble {

/// Points of an elastic body that elements join: as many parts as hang together of it, such as the
/// strands of a fur. The velocities v at the end of a step of h are those of implicit Euler with
/// forces linear about the motion u (Baraff and Witkin, Large Steps in Cloth Simulation, 1998, §3):
///   A v = M v⁻ + h F + c + Jᵀλ,   A = M + K,   K = h D + h² H,   c = −h ∂E/∂x + h² H u,
/// with E, H and D at x + h u, and F the forces from outside. First u = 0; u = v, again and again,
/// is Newton's method for the step. Points that are moved out within it go by h (v + w): E, H and D
/// are still at x + h u, c = −h ∂E/∂x + h² H (u − w), and Newton's method takes u = v + w.
struct BendingPart {
  const ElasticBody* body = nullptr;
  std::vector<const Element*> elements;
  std::vector<int> bodies;       ///< of the world, per point
  std::vector<int> mover;        ///< per point: its number among those that move, or −1
  std::vector<int> moving;       ///< those that move, by point
  std::vector<BlockEdge> edges;  ///< points that share an element, in order
  std::vector<int> edgesOf;      ///< of each element its pairs (0,1), (0,2), (1,2), (0,3), …
  std::vector<std::pair<int, int>> movingEdges;  ///< of two that move: edge, and its number in A
  bool several = false;                          ///< cloths that met, which may part

  /// Pairs of cloth that may press on each other in the step, by numbers of points; those that
  /// close do, and make edges behind those of the elements; and how many edges, of all and of those
  /// that move, there are without them.
  std::vector<LayerPair> pairs;
  std::size_t woven = 0, wovenMoving = 0;

  std::vector<Mat3> own,
      off;  ///< [kg] blocks of K: of points, and of edges with row first < second
  std::vector<Vec3> constant;            ///< [N·s] c
  std::vector<Mat3> wovenOwn, wovenOff;  ///< the same without what pairs push
  std::vector<Vec3> wovenConstant;
  std::vector<Vec3> about;   ///< [m/s] u
  std::vector<Vec3> wayOut;  ///< [m/s] w per point, if any is moved out within the step
  std::vector<Vec3> lean;    ///< [m/s] per point: what v⁻ gains as a chord, if it flies and turns
  std::vector<Vec3> side;    ///< [N·s] of those that move: M v⁻ + h F + c, less K of those led
  std::vector<Vec3> star;    ///< [m/s] per point: v without λ
  double stored = 0.0;       ///< [J] at the start of the step
  double reached = 0.0;      ///< [J] where the velocities found lead,
  double pressed = 0.0;      ///< [J] of these, of cloth that presses on cloth
  std::vector<Vec3> reachedAt;  ///< [m] places of the points there
  double turned = 0.0;          ///< [m/s] by which the last linearisation changed the motion
  bool anew = false;            ///< linear forces are others than when islands were solved last
  bool joined = false;          ///< a joint holds one of its points
  bool touched = false;         ///< an island with contacts has it
  bool held = false;            ///< something that stands holds that island
  bool placed = false;          ///< its points go where reachedAt says
  bool newton = false;          ///< is linearised until Newton's method ends
  bool fresh = false;           ///< velocities may be others than those of its books
  bool costly = false;          ///< a factor of A costs more than a number of sweeps
  bool sweeps = false;          ///< solved by sweeps where it can be
  std::vector<Vec3> swept;      ///< [m/s] per point: v as the last sweeps left it

  std::unique_ptr<BlockStructure> structure;  ///< of A,
  std::unique_ptr<BlockStructure> pressing;   ///< and where pairs have edges of their own
  BlockCholesky<3> factor;

  /// v⁻ as the step takes it, but for what a body has of it.
  Vec3 leanOf(std::size_t p) const { return lean.empty() ? Vec3(Vec3::Zero()) : lean[p]; }
  bool movesOut() const { return !wayOut.empty(); }
  /// Whether none of its points is led along.
  bool flies() const { return moving.size() == bodies.size(); }
  /// K v of the points at these velocities, per point.
  void timesK(const std::vector<Vec3>& v, std::vector<Vec3>& out) const;
  /// The number of the edge of two points.
  int edgeOf(int p, int q) const;
  /// Takes other pairs.
  void press(std::vector<LayerPair> others);
  /// That of A with the edges at hand.
  const BlockStructure& structureNow();
};

/// All of a model; and per body its place in them.
struct Bendings {
  std::vector<BendingPart> parts;
  std::vector<int> partOf;    ///< per body: its part, or −1
  std::vector<int> pointOf;   ///< per body: its number in its part
  std::vector<Force> others;  ///< of the model that bend nothing

  /// What keeps its cloths apart, if anything; which of these are one part, for they met; and what
  /// was seen last: of each point of theirs the place and the way [m] in the step.
  std::shared_ptr<const Layers> layers;
  std::vector<std::pair<int, int>> met;
  std::vector<Vec3> places, ways;
  Layers::Look look;

  BendingPart& partWith(int body) { return parts[partOf[body]]; }
};
/// @param met  cloths, by numbers of `Layers`, whose points are one part
Bendings bendingsOf(const Model& model, const std::vector<std::pair<int, int>>& met = {});

/// K and c about the motion u, with D of the start. Projected, so that A is positive definite.
/// @return the energy [J] there
double linearise(BendingPart& part, const std::vector<int>& pointOf,
                 std::span<const RigidBody> bodies, double h);

/// K and c with the pairs that close now, where all else is as when it was linearised last.
void repress(BendingPart& part, double h);

/// Finds where its points are after h seconds at these velocities of bodies, less those by which
/// they fall, and moved out.
void reach(BendingPart& part, std::span<const RigidBody> bodies, std::span<const Vec6> after,
           std::span<const Vec3> falls, double h);
/// Finds the energy there.
void storeReached(BendingPart& part, const std::vector<int>& pointOf);

/// The right side of the step; and for star how points would move that nothing joined.
void setSide(BendingPart& part, std::span<const RigidBody> bodies, double h);

/// The velocities at the end of the step, were there no λ: star, by a factor of A.
/// @return false if A is not positive definite to rounding
bool freeMotion(BendingPart& part, std::span<const RigidBody> bodies);

}  // namespace tumble
