// Bodies that never come near each other fly in closed form: no step, and no error that grows with
// the number of steps. Where two touch, the run stops and says when, and which.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "sim/method/method.h"

namespace tumble {

/// @throws Refusal for a force under which flight has no closed form, and for a top under more than
///   gravity.
void checkExact(const Model& model, std::span<const RigidBody> bodies);
void advanceExact(const Model& model, State& state, double t_end, Report& report);
/// Any instant: each body by its own flight. Allocates nothing once `bodies` has its size.
void lookExact(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
               std::vector<Contact>& contacts);

/// The method at work on one world.
class Exact {
 public:
  Exact(const Model& model, State& state, Report& report);

  /// Gives every body its flight from t = 0 on.
  void takeOff();
  /// One window of time: to its end, or to the first touch inside.
  void fly();
  /// Ends the run at the touch that was found.
  void stop();

 private:
  using Pair = std::pair<int, int>;

  /// Pairs whose swept boxes overlap during the next `window_` seconds; shortens the window until
  /// they are few. Half-spaces apart.
  void choosePairs();
  /// Boxes that hold the finite bodies from now to t1, in a frame that falls and drifts with them.
  void sweptBoxes(double t1, std::vector<Aabb>& boxes) const;
  /// Keeps the earliest touch before t1 in state_.touch.
  void lookFor(Pair pair, double& t1);
  /// Covers the window with the arcs of all tops.
  void spinTops();
  void moveTo(double t);
  void keepBooks(double t);

  const Model& model_;
  State& state_;
  Report& report_;
  std::vector<int> finite_, planes_;  ///< bodies that can touch something
  Vec3 drift_ = Vec3::Zero();         ///< [m/s] mean velocity of the bodies that are free
  double t1_ = 0.0;                   ///< [s] end of the window
  std::vector<Pair> pairs_;           ///< b < a
};

}  // namespace tumble
