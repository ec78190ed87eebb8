// Where events crowd, or no forces go with a motion: one step whose impulses obey the laws of
// contact at its end.
#pragma once

#include <span>
#include <vector>

#include "sim/flight/flight.h"
#include "sim/flight/top.h"
#include "sim/method/model.h"
#include "sim/method/state.h"
#include "sim/problem/problem.h"

namespace tumble {

/// One step of h [s] of all bodies. Those that touch get impulses λ at its start,
///   M (v⁺ − v) = h f + Jᵀλ,   u = J v⁺:   λn ≥ 0,  un ≥ −φ/h,  λn (un + φ/h) = 0,
///   |λt| ≤ mu λn,  and  λt = −mu λn ut/|ut|  of those that slip,
/// and then fly free with v⁺; φ [m] is the gap. All others fly in closed form, up to the first
/// touch. There always are such impulses, and they never give energy: with x⁺ = x + h v⁺
///   E⁺ − E = λ·u − ½ (v⁺ − v)·M (v⁺ − v) ≤ 0.
/// The error is of order h: hits of bodies that touch already, and rebounds that are over within
/// the step, are left out. Moreau, Unilateral Contact and Dry Friction in Finite Freedom Dynamics,
/// 1988; Stewart, Rigid-Body Dynamics with Friction and Impact, 2000, §5. World frame, SI.
class Crossing {
 public:
  /// Part of the size of the world that bodies may overlap at the end of a step.
  static constexpr double kOff = 1e-13;

  Crossing(const Model& model, const State& state);

  /// Takes the step, no longer than `most` [s], and shorter where others touch; none where bodies
  /// that touch are about to rebound.
  void take(double most);

  double h = 0.0;         ///< [s] its length
  bool touches = false;   ///< something touches at its end that did not at its start
  double residual = 0.0;  ///< of the contact problem
  double deepest = 0.0;   ///< [m] overlap at the end, before it is mended
  double left = 0.0;      ///< and what could not be mended
  Contact worst;          ///< where what is left is deepest; if nothing is, what was mended
  Segment segment;        ///< for the trail
  double lostImpact = 0.0, lostFriction = 0.0;  ///< [J]
  double work = 0.0;            ///< [J] of forces without a potential, and of moving fixed bodies
  double mended = 0.0;          ///< [J] given by moving bodies out of each other
  Vec3 impulse = Vec3::Zero();  ///< [N·s] of everything outside the bodies that move

 private:
  struct Pair {
    int b = 0, a = 0;
    bool touches = false;
  };
  void findPairs(double h);
  void findPoints(double h);
  void solve();
  void push(const Problem& problem, const Solution& solution, std::span<const std::size_t> owner);
  void drift();
  /// Marks contacts along whose start the bodies would run into each other. @return whether
  /// contacts are to be looked at as they are at the end.
  bool bendsIn();
  /// Adds points that are hit so slowly that the rebound is over at once. @return whether there
  /// were any; else `first` is the instant at which another is hit, if that is before h.
  bool absorb(double& first);
  double firstTouch() const;
  double overlap();
  void mend();
  void keepBooks();
  double pull(int body) const;

  const Model& model_;
  const State& state_;
  std::vector<RigidBody> start_, moved_, end_;  ///< moved: at the start, with v⁺
  std::vector<Pair> pairs_;
  std::vector<Contact> points_;  ///< of pairs that touch
  std::vector<char> active_;     ///< takes part in the problem, per point
  std::vector<char> late_;       ///< its rows are those of the end, per point
  double lostNormal_ = 0.0, lostSlip_ = 0.0, givenWork_ = 0.0;  ///< [J]
  std::vector<Vec3> given_;                                     ///< [N·s] impulse on a, per point
  std::vector<Contact> found_;  ///< of all that are near, at the end
  std::vector<char> kicked_;    ///< per body
};

/// Body i of a step h [s] after its start: with the momenta P [N·s] and L [N·m·s] if it was kicked,
/// else in closed form.
RigidBody across(const Model& model, const State& state, const RigidBody& start, int i,
                 const Vec3& P, const Vec3& L, bool kicked, double h);

/// The bodies at time t [s] inside such a step.
void lookAcross(const Model& model, const State& state, const Segment& segment, double t,
                std::vector<RigidBody>& bodies);

}  // namespace tumble
