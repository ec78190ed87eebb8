// Time stepping after Moreau: each step solves one contact problem for the velocities at its end,
//   M (v⁺ − v) = h F + Jᵀ λ,   u_n ≥ −separation/h,  λ_n ≥ 0, complementary, Coulomb's cone,
// moves the bodies with v⁺, and lifts what still overlaps without touching a velocity.
#pragma once

#include <span>
#include <vector>

#include "sim/method/method.h"
#include "sim/problem/problem.h"

namespace tumble {

void checkStepping(const Model& model, std::span<const RigidBody> bodies);
void advanceStepping(const Model& model, State& state, double t_end, Report& report);
void lookStepping(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
                  std::vector<Contact>& contacts, std::vector<JointForce>& joints);

class Stepping {
 public:
  Stepping(const Model& model, State& state, Report& report);

  /// One step of the grid, shorter only at the end of the run.
  void step();

 private:
  /// Pairs that touch, directly or through others, and the bodies among them that move.
  struct Island {
    std::span<const int> pairs;
    std::vector<int> bodies;
  };

  double lengthTo(double t1) const;
  void beginSegment(double t1);
  void endSegment(double t1);
  bool finite() const;
  void stop();

  // touching.cpp: which pairs are near, and where they touch.
  void findTouching(double h);
  void findNear(double h);
  double marginOf(std::size_t pair, double h) const;
  /// Brings the contact points of a pair up to date with the poses of its bodies.
  void look(std::size_t pair, double margin);

  // island.cpp: the contact problem of each island.
  void solveIslands(double h);
  void groupPairs();
  void solveIsland(std::span<const int> pairs, double h);
  void collectBodies(std::span<const int> pairs, double h);
  bool keeps(const IslandMemory& memory, std::span<const int> pairs) const;
  void build(std::span<const int> pairs, double h);
  void addTouch(Touch& touch, double h);
  void share(std::span<const int> pairs, IslandMemory& memory, double h);
  void shareTouch(Touch& touch, const Cone& cone, IslandBooks& books, double h);
  int localOf(int body);

  // stepping.cpp: the bodies.
  void applyTwists(double h);
  void moveBodies(double h);
  /// Free flight of one body through a step; `before` is its velocity [m/s] at the start.
  void coast(RigidBody& body, const Vec3& before, double h) const;

  // project.cpp
  void project();
  double deepestOverlap();
  void lift();

  // events.cpp
  void recordEvents(double t);
  void recordImpact(double t, const PairMemory& pair);
  void recordLasting(const std::vector<Contact>& before, double t);
  bool arrives(const Touch& touch) const;
  /// vrel [m/s] < 0 below which a touch is an impact: more than gravity gives in two steps.
  double landingSpeed() const;

  const Model& model_;
  State& state_;
  Report& report_;
  SteppingMemory& memory_;
  ContactTolerance tolerance_;
  const Solver& solver_;

  // Scratch of a step.
  std::vector<Aabb> boxes_;
  std::vector<std::pair<int, int>> near_;
  std::vector<PairMemory> passed_;
  std::vector<Contact> found_;
  std::vector<int> root_, order_, begin_;  ///< of islands: forest of bodies; pairs by island
  std::vector<int> local_, bodies_;        ///< of one island: numbers in its problem, and back
  std::vector<int> movers_;
  Problem problem_;
  Solution solution_;
  std::vector<Vec6> before_, star_, after_;  ///< per body: twists at both ends of the step, and
                                             ///< what they would be without contacts
  std::vector<char> touched_;                ///< per body: a contact pushed it in this step
  std::vector<Contact> lasting_;
  bool allKept_ = false;
};

}  // namespace tumble
