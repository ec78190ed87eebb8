// How far ahead to look at once, and which pairs may come near each other in that time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/collide/sweep.h"
#include "sim/method/exact/exact.h"

namespace tumble {
namespace {

/// Pairs that any scene may have at once, pairs and comparisons a body, and how many times those of
/// the present instant a window may have: shorter windows than needed cost a sweep each, longer
/// ones a look at pairs that never meet. Between 4 and 16 pairs a body the time of a run hardly
/// changes.
constexpr long kAnyway = 2048, kPairsPerBody = 8, kComparisonsPerBody = 256, kTimesNow = 4;
/// [s] the longest window with tops in it, whose arcs must be kept for all of it.
constexpr double kArcs = 10.0;
/// What is added to swept boxes for rounding, relative to their coordinates.
constexpr double kRounding = 1e-14;

/// Range of  x + v t + ½ a t²  over [t0, t1].
void stretch(double x, double v, double a, double t0, double t1, double& lo, double& hi) {
  const auto at = [&](double t) { return x + t * (v + 0.5 * t * a); };
  lo = std::min(at(t0), at(t1));
  hi = std::max(at(t0), at(t1));
  const double turn = -v / a;
  if (!(turn > t0 && turn < t1)) return;
  lo = std::min(lo, at(turn));
  hi = std::max(hi, at(turn));
}

}  // namespace

void Exact::sweptBoxes(double t1, std::vector<Aabb>& boxes) const {
  const double t0 = state_.t;
  boxes.clear();
  for (const int i : finite_) {
    const RigidBody& start = state_.trail.back().start[i];
    const Parabola& path = state_.paths[i];
    const Vec3 v = path.v0 - drift_, a = path.g - model_.def.gravity;
    // A body that does not turn keeps its own box; any other stays within its ball.
    Vec3 reach = Vec3::Constant(boundingRadius(state_.hulls[i]));
    const std::optional<Vec3>& pivot_B = model_.def.bodies[i].pivot_B;
    if (pivot_B) {
      reach += Vec3::Constant(pivot_B->norm());
    } else if (start.omega.isZero(0.0)) {
      const Aabb own = boundingBox(state_.hulls[i], {Vec3::Zero(), start.q});
      reach = own.hi;
    }
    Aabb box;
    for (int k = 0; k < 3; ++k) stretch(path.x0[k], v[k], a[k], t0, t1, box.lo[k], box.hi[k]);
    reach += kRounding * (reach + box.lo.cwiseAbs() + box.hi.cwiseAbs());
    box.lo -= reach;
    box.hi += reach;
    boxes.push_back(box);
  }
}

void Exact::choosePairs() {
  finite_.clear();
  planes_.clear();
  drift_.setZero();
  int free = 0;
  for (const int i : model_.solid)
    (std::holds_alternative<HalfSpace>(model_.shapes[i]) ? planes_ : finite_).push_back(i);
  for (int i = 0; i < model_.count(); ++i) {
    if (model_.fixed(i)) continue;
    drift_ += state_.paths[i].v0;
    ++free;
  }
  if (free > 0) drift_ /= free;

  // However short the window, there are the pairs that are near now.
  constexpr long kMost = std::numeric_limits<long>::max();
  const double left = model_.def.duration - state_.t;
  const long n = static_cast<long>(finite_.size());
  std::vector<Aabb> boxes;
  SweepCount most{kAnyway, kAnyway};
  if (n * (n - 1) / 2 > kAnyway) {
    sweptBoxes(state_.t, boxes);
    const SweepCount now = *sweepPairs(boxes, {kMost, kMost}, pairs_);
    most.pairs = std::max(kPairsPerBody * n, kTimesNow * now.pairs);
    most.comparisons = std::max(kComparisonsPerBody * n, kTimesNow * now.comparisons);
  }
  // Twice the last window, and halved until its pairs are few.
  const double furthest = std::min(left, state_.tops.empty() ? left : kArcs);
  for (double window = std::min(furthest, 2.0 * state_.window);; window *= 0.5) {
    t1_ = window < left ? state_.t + window : model_.def.duration;
    state_.window = window;
    sweptBoxes(t1_, boxes);
    if (sweepPairs(boxes, most, pairs_) || t1_ <= state_.t) break;
  }
  for (auto& [b, a] : pairs_) {
    b = finite_[b];
    a = finite_[a];
  }
  std::erase_if(pairs_,
                [&](const Pair& p) { return model_.fixed(p.first) && model_.fixed(p.second); });
}

}  // namespace tumble
