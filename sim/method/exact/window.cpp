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

/// Range of  x + v t + ½ a t²  over [0, h].
void stretch(double x, double v, double a, double h, double& lo, double& hi) {
  const auto at = [&](double t) { return x + t * (v + 0.5 * t * a); };
  lo = std::min(x, at(h));
  hi = std::max(x, at(h));
  const double turn = -v / a;
  if (!(turn > 0.0 && turn < h)) return;
  lo = std::min(lo, at(turn));
  hi = std::max(hi, at(turn));
}

}  // namespace

Aabb Exact::sweptBox(int i, double t) const {
  const ExactMemory::Window& w = state_.exact.window;
  const Flight& flight = state_.exact.flights[i].back();
  const std::optional<Vec3>& pivot_B = model_.def.bodies[i].pivot_B;
  const double since = t - flight.start(), late = t - w.t0, h = w.t1 - t;
  Vec3 x = flight.path().position(since), v = flight.path().velocity(since), a = flight.path().g;
  double radius = boundingRadius(model_.shapes[i]);
  if (pivot_B) {  // the pivot stays, and the body within a ball about it
    const RigidBody& body = state_.bodies[i];
    x = body.x + body.q * *pivot_B;
    v = a = Vec3::Zero();
    radius += pivot_B->norm();
  }
  x -= late * (w.drift + 0.5 * late * w.fall);
  v -= w.drift + late * w.fall;
  a -= w.fall;
  // A body that does not turn keeps its own box; any other stays within its ball.
  Aabb own{Vec3::Constant(-radius), Vec3::Constant(radius)};
  if (flight.turning() == 0.0 && !pivot_B)
    own = boundingBox(model_.shapes[i], {Vec3::Zero(), flight.pose(t).q});
  Aabb box;
  for (int k = 0; k < 3; ++k) stretch(x[k], v[k], a[k], h, box.lo[k], box.hi[k]);
  box.lo += own.lo;
  box.hi += own.hi;
  const Vec3 more = Vec3::Constant(tolerance_.touch) +
                    kRounding * (box.lo.cwiseAbs() + box.hi.cwiseAbs() + x.cwiseAbs());
  return {box.lo - more, box.hi + more};
}

void Exact::chooseFrame() {
  // Bodies that all fly free are seen from a frame that falls and drifts with them.
  ExactMemory::Window& w = state_.exact.window;
  w.drift.setZero();
  w.fall.setZero();
  int count = 0;
  for (const int i : w.finite) {
    if (model_.fixed(i)) return w.drift.setZero(), void();
    const Flight& flight = state_.exact.flights[i].back();
    w.drift += flight.path().velocity(w.t0 - flight.start());
    ++count;
  }
  if (count == 0 || !w.planes.empty()) return w.drift.setZero(), void();
  w.drift /= count;
  w.fall = model_.def.gravity;
}

std::vector<Exact::Pair> Exact::choosePairs() {
  ExactMemory::Window& w = state_.exact.window;
  const double left = model_.def.duration - w.t0;
  const long n = static_cast<long>(w.finite.size());
  std::vector<Aabb> boxes;
  std::vector<Pair> pairs;
  const auto sweep = [&](double t1, const SweepCount& most) {
    w.t1 = t1;
    boxes.clear();
    for (const int i : w.finite) boxes.push_back(sweptBox(i, w.t0));
    return sweepPairs(boxes, most, pairs);
  };
  // However short the window, there are the pairs that are near now.
  constexpr long kMost = std::numeric_limits<long>::max();
  SweepCount most{kAnyway, kAnyway};
  if (n * (n - 1) / 2 > kAnyway) {
    const SweepCount now = *sweep(w.t0, {kMost, kMost});
    most.pairs = std::max(kPairsPerBody * n, kTimesNow * now.pairs);
    most.comparisons = std::max(kComparisonsPerBody * n, kTimesNow * now.comparisons);
  }
  // Twice the last window, and halved until its pairs are few.
  const double furthest = std::min(left, state_.exact.tops.empty() ? left : kArcs);
  for (double length = std::min(furthest, 2.0 * w.length);; length *= 0.5) {
    w.length = length;
    const double t1 = length < left ? w.t0 + length : model_.def.duration;
    if (sweep(t1, most) || t1 <= w.t0) break;
  }
  w.swept.resize(model_.shapes.size());
  for (std::size_t k = 0; k < w.finite.size(); ++k) w.swept[w.finite[k]] = boxes[k];
  for (auto& [b, a] : pairs) {
    b = w.finite[b];
    a = w.finite[a];
  }
  return pairs;
}

void Exact::openWindow() {
  ExactMemory::Window& w = state_.exact.window;
  w.t0 = state_.t;
  w.renewals = 0;
  w.finite.clear();
  w.planes.clear();
  for (const int i : model_.solid)
    (std::holds_alternative<HalfSpace>(model_.shapes[i]) ? w.planes : w.finite).push_back(i);
  for (const Pivot& pivot : model_.pivots) bringTo(w.t0, pivot.body);
  chooseFrame();
  const std::vector<Pair> pairs = choosePairs();
  spinTops();
  if (report_.stopped) return;
  state_.exact.queue.clear();
  for (const int plane : w.planes)
    for (const int body : w.finite) lookFor({plane, body}, w.t0);
  for (const Pair& pair : pairs) lookFor(pair, w.t0);
  lookForStops(w.t0);
}

void Exact::spinTops() {
  for (std::size_t k = 0; k < state_.exact.tops.size() && !report_.stopped; ++k)
    if (!state_.exact.tops[k].reach(state_.exact.window.t1))
      stop("\"" + nameOf(model_.pivots[k].body) +
           "\" leaves the range of numbers before t = " + digits(state_.exact.window.t1) + " s");
}

}  // namespace tumble
