// Chapter 4, flight: a heavy top, by Taylor series from arc to arc.
#pragma once

#include <vector>

#include "sim/body/pivot.h"

namespace tumble {

/// The motion of one body about its pivot under gravity alone: the equations of Euler and Poisson,
/// which have no closed form for most bodies. Arcs of Taylor series (`BodyJet`), each as long as
/// its last terms stay below rounding, follow one another; where they begin does not depend on the
/// times that are asked for. An evaluation inside the arcs takes the same short time for every t
/// and allocates nothing. World frame, SI.
class HeavyTop {
 public:
  /// @param start    the body at t0, held by the pivot (`hold`), its derived quantities current
  /// @param gravity  [m/s²]
  /// @param t0       [s] the instant that `start` shows
  HeavyTop(const RigidBody& start, const Pivot& pivot, const Vec3& gravity, double t0);

  /// Adds arcs until t [s] is covered. False if the motion leaves the range of numbers before.
  bool reach(double t);
  /// Drops the arcs that end before t [s].
  void forget(double t);

  /// Sets state and derived quantities of the body to those at t [s], which is t0 or covered by
  /// arcs.
  void at(double t, RigidBody& body) const;
  /// Where the body frame stands at t [s].
  Pose pose(double t) const;

  /// A bound [m/s²] on the acceleration of every body point within r [m] of the centre of mass, for
  /// all time: (|c| + r)(ω² + |ω̇|) with the greatest ω that the energy allows,
  ///   ω² ≤ 2 (T + 2 M |g| |c|)/I_min,   |ω̇| ≤ (M |g| |c| + (I_max − I_min) ω²)/I_min.
  double accelBound(double r) const;

  /// How many arcs there are.
  std::size_t arcs() const { return arcs_.size(); }

 private:
  struct Arc {
    double t, h;            ///< [s] when it begins, how long it holds
    std::vector<Vec4> q;    ///< coefficients of the attitude, w first, and
    std::vector<Vec3> H_B;  ///< of the angular momentum about the pivot, body frame
  };
  bool addArc();
  const Arc& arcAt(double t) const;

  Pivot pivot_;
  Vec3 gravity_;
  double weight_;  ///< [N] M |g|
  RigidBody body_;
  Vec4 q_;        ///< attitude and
  Vec3 H_B_;      ///< angular momentum at the end of the last arc
  double t0_;     ///< [s] the instant that `body_` shows
  double end_;    ///< [s] the same instant
  double bound_;  ///< [1/s²] the most that ω² + |ω̇| can be
  double most_;   ///< [kg m²/s] the most that |H| can be
  std::vector<Arc> arcs_;
};

}  // namespace tumble
