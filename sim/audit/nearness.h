// Chapter 10, audit: which bodies may have touched in a part of a step, and how deep they overlap
// at its end and in its midst.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/audit/depth.h"
#include "sim/audit/recorded.h"
#include "sim/audit/ways.h"
#include "sim/collide/broad_phase.h"
#include "sim/method/model.h"

namespace tumble {

/// Gaps of pairs that were looked at, good for as long as the ways of both bodies since then cannot
/// have closed them: what rests or flies alone is not looked at again.
class Nearness {
 public:
  using Pair = std::pair<int, int>;
  /// How bodies went through one part, per body of the model.
  struct Part {
    double t1 = 0.0, h = 0.0;  ///< [s]
    bool many = false;         ///< it was many parts: nobody can tell its midst
    bool struck = false;       ///< impulses at its start are a part of it
    std::span<const Recorded> start, end;
    const Ways& ways;                  ///< of bodies with parts of their own in it
    std::span<const double> net, way;  ///< [m] between the ends, and on the way, of any point
    std::span<const double> reach;     ///< [m] how far they may go before all are looked at again
  };

  Nearness(const Model& model, std::span<const RigidBody> bodies);

  /// All bodies have moved.
  void see(const Part& part);

  /// Adds pairs that ways [m] of any of their points, per body, could have brought together in the
  /// part that was seen last. @return whether there are any
  bool seeFarther(const Part& part, std::span<const double> way);
  /// Pairs that may have touched on the way; b < a.
  const std::vector<Pair>& touched() const { return touched_; }

  /// The end of a part that is not looked at otherwise: of pairs that were near, how deep they are.
  /// @return false if a body went farther than could be expected, by then or by the end of a part
  /// of its own: then all have to be looked at
  bool glance(std::span<const RigidBody> end, std::span<const ClusterPart> pieces);

  double deepest() const { return deepest_; }  ///< [m] at the end of any part
  double between() const { return between_; }  ///< [m] in the midst of any part, for certain
  double least() const { return least_; }      ///< [m] radius of the smallest body
  double radius(int body) const { return radius_[body]; }

 private:
  struct Known {
    int b = 0, a = 0;
    double gap = 0.0;             ///< [m] when it was looked at,
    double moved = 0.0;           ///< [m] and how far both had moved until then
    bool fresh = true;            ///< not looked at before this part
    bool touched = false;         ///< may have in this part
    bool close = false;           ///< a few more parts like the last one may bring them together
    double glanced = 0.0;         ///< [m] gap when it was last measured, at
    Pose poseA = {}, poseB = {};  ///< these poses
  };
  void see(Known& pair, const Part& part);
  void touch(Known& pair);
  void list(const Part& part);
  void look(Known& pair, const Part& part);
  /// Measures the gap of a pair.
  double gapOf(Known& pair, const Pose& a, const Pose& b);
  void lookOnTheWay(Known& pair, const Part& part);
  double smaller(const Known& pair) const;
  /// Gap [m] at the end of the part at hand, or less.
  double gapNow(const Known& pair) const {
    return pair.gap - (moved_[pair.a] + moved_[pair.b] - pair.moved);
  }

  double depthAt(double t, Known& pair, const Part& part);
  /// A pose, and how far [m] points of the body may be from where it has them.
  struct Seen {
    Pose pose;
    double error = 0.0;
  };
  std::optional<Seen> poseAt(double t, int body, const Part& part) const;

  const Model& model_;
  std::vector<RigidBody> bodies_;  ///< what is constant of them
  std::vector<std::vector<PosedPart>> parts_;
  std::vector<double> radius_;  ///< [m] per body; 0 of a half-space
  std::vector<double> moved_;   ///< [m] per body, of any of its points, in all
  std::vector<double> reach_;   ///< [m] per body: how far it may go before all are looked at,
  std::vector<double> before_;  ///< [m] the same before the part at hand
  std::vector<Vec3> from_;      ///< [m] from here
  std::vector<double> listed_;  ///< [m] the same when pairs were listed
  std::vector<Aabb> boxes_;
  BroadPhase broadPhase_;
  std::vector<double> fat_;  ///< [m] per body: what its box was grown by
  double least_ = 0.0;
  std::vector<Known> pairs_, known_;  ///< and those of the list before
  std::vector<Pair> touched_;
  double deepest_ = 0.0, between_ = 0.0;
};

}  // namespace tumble
