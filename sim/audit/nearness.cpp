#include "sim/audit/nearness.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

/// Nearer than this, of the size of the smaller body, two bodies may push each other.
constexpr double kTouch = 1e-6;
/// Pairs that went less far in a part than this, of that size, are not looked at in its midst.
constexpr double kMidst = 1e-4;
/// How far a body that rests may go, in its size, before all are looked at again.
constexpr double kRest = 1e-3;
/// Boxes are at least this much larger than their bodies, of the smallest, so that they hold long.
constexpr double kSpare = 0.1;
/// Rounding of a gap, of that size.
constexpr double kRounding = 1e-12;

Pose poseOf(const Recorded& r) {
  return {r.x, r.q};
}

}  // namespace

Nearness::Nearness(const Model& model, std::span<const RigidBody> bodies)
    : model_(model), bodies_(bodies.begin(), bodies.end()) {
  for (int i = 0; i < model.count(); ++i) {
    parts_.push_back(convexParts(model.shapes[i]));
    const double radius = boundingRadius(model.shapes[i]);
    radius_.push_back(std::isfinite(radius) ? radius : 0.0);
  }
  for (const double radius : radius_)
    if (radius > 0.0 && (least_ == 0.0 || radius < least_)) least_ = radius;
  moved_.assign(radius_.size(), 0.0);
  reach_ = fat_ = moved_;
  from_.assign(radius_.size(), Vec3::Zero());
}

double Nearness::smaller(const Known& pair) const {
  const double a = radius_[pair.a], b = radius_[pair.b];
  return a == 0.0 || (b > 0.0 && b < a) ? b : a;
}

void Nearness::list(const Part& part) {
  listed_ = moved_;
  boxes_.clear();
  for (const int i : model_.solid) {
    fat_[i] = kSpare * least_ + reach_[i];
    boxes_.push_back(boundingBox(model_.shapes[i], poseOf(part.end[i]), fat_[i]));
  }
  broadPhase_.update(boxes_, model_.solidBends);
  // What is known of pairs that stay is kept. Both lists are sorted.
  known_.swap(pairs_);
  pairs_.clear();
  if (const std::size_t count = broadPhase_.pairs().size(); touched_.capacity() < count) {
    for (std::vector<Known>* list : {&pairs_, &known_}) list->reserve(2 * count);
    touched_.reserve(2 * count);
  }
  auto old = known_.begin();
  for (const auto& [i, j] : broadPhase_.pairs()) {
    const int b = model_.solid[i], a = model_.solid[j];
    if (!model_.mayTouch(a, b)) continue;
    while (old != known_.end() && std::pair(old->b, old->a) < std::pair(b, a)) ++old;
    if (old != known_.end() && old->b == b && old->a == a)
      pairs_.push_back(*old);
    else
      look(pairs_.emplace_back(Known{.b = b, .a = a}), part);
  }
}

double Nearness::gapOf(Known& pair, const Pose& a, const Pose& b) {
  pair.poseA = a;
  pair.poseB = b;
  return pair.glanced = provenGap(parts_[pair.a], a, parts_[pair.b], b);
}

void Nearness::look(Known& pair, const Part& part) {
  pair.gap = gapOf(pair, poseOf(part.end[pair.a]), poseOf(part.end[pair.b]));
  pair.moved = moved_[pair.a] + moved_[pair.b];
  deepest_ = std::max(deepest_, -pair.gap);
}

/// In the midst of a part and, where bodies have parts of their own in it, at the ends of those.
void Nearness::lookOnTheWay(Known& pair, const Part& part) {
  between_ = std::max(between_, depthAt(part.t1 - 0.5 * part.h, pair, part));
  const std::span<const Ways::Part> ofA = part.ways.of(pair.a);
  for (const Ways::Part& own : ofA.empty() ? part.ways.of(pair.b) : ofA)
    if (own.t1 < part.t1) deepest_ = std::max(deepest_, depthAt(own.t1, pair, part));
}

/// How deep [m] two bodies overlap at t at least; 0 if nobody can tell.
double Nearness::depthAt(double t, Known& pair, const Part& part) {
  const std::optional<Seen> a = poseAt(t, pair.a, part), b = poseAt(t, pair.b, part);
  return a && b ? -gapOf(pair, a->pose, b->pose) - a->error - b->error : 0.0;
}

/// Nothing if nobody can tell how the body turned.
std::optional<Nearness::Seen> Nearness::poseAt(double t, int i, const Part& part) const {
  const double share = 1.0 - (part.t1 - t) / part.h;
  const Recorded &p = part.start[i], &q = part.end[i];
  if (bodies_[i].fixed()) return Seen{{p.x + share * (q.x - p.x), p.q.slerp(share, q.q)}};
  const auto on = [&](const Recorded& from, const Recorded& to, double h, double at) {
    const BodyPath path(bodies_[i], from, to, h, part.struck);
    const PathPoint point = path.at(at);
    return path.lost() ? std::nullopt
                       : std::optional(Seen{{point.x, point.q}, path.error(at, radius_[i])});
  };
  for (const Ways::Part& own : part.ways.of(i))
    if (t <= own.t1)
      return on(own.start, own.end, own.t1 - own.t0, (t - own.t0) / (own.t1 - own.t0));
  return on(p, q, part.h, share);
}

bool Nearness::glance(std::span<const RigidBody> end, std::span<const ClusterPart> pieces) {
  const auto strays = [&](int i, const Vec3& x) {
    return radius_[i] > 0.0 && (x - from_[i]).lpNorm<Eigen::Infinity>() > reach_[i];
  };
  for (const int i : model_.solid)
    if (strays(i, end[i].x)) return false;
  for (const ClusterPart& piece : pieces)
    for (std::size_t k = 0; k < piece.end.size(); ++k)
      if (strays(piece.bodies[k], piece.end[k].x)) return false;
  for (Known& pair : pairs_) {
    if (!pair.close) continue;
    const RigidBody &a = end[pair.a], &b = end[pair.b];
    const double way = wayBetween(pair.poseA.x, pair.poseA.q, a.x, a.q, radius_[pair.a]) +
                       wayBetween(pair.poseB.x, pair.poseB.q, b.x, b.q, radius_[pair.b]);
    if (pair.glanced - way >= -deepest_ - kRounding * smaller(pair)) continue;
    deepest_ = std::max(deepest_, -gapOf(pair, a.pose(), b.pose()));
  }
  return true;
}

void Nearness::see(const Part& part) {
  touched_.clear();
  before_ = reach_;
  bool listed = !listed_.empty();
  for (const int i : model_.solid) {
    moved_[i] += part.net[i];
    from_[i] = part.end[i].x;
    reach_[i] = radius_[i] > 0.0 ? part.reach[i] + kRest * radius_[i] : 0.0;
    listed = listed && moved_[i] - listed_[i] + reach_[i] < fat_[i];
  }
  for (Known& pair : pairs_) see(pair, part);
  if (listed) return;
  list(part);
  for (Known& pair : pairs_)
    if (pair.fresh) see(pair, part);
}

void Nearness::touch(Known& pair) {
  pair.touched = true;
  touched_.emplace_back(pair.b, pair.a);
}

bool Nearness::seeFarther(const Part& part, std::span<const double> way) {
  const std::size_t before = touched_.size();
  for (Known& pair : pairs_) {
    const double reach = way[pair.a] + way[pair.b] + part.net[pair.a] + part.net[pair.b];
    if (pair.touched || gapNow(pair) > reach) continue;
    look(pair, part);
    if (pair.gap <= reach) touch(pair);
  }
  return touched_.size() > before;
}

void Nearness::see(Known& pair, const Part& part) {
  const double now = gapNow(pair);
  const double net = part.net[pair.a] + part.net[pair.b], near = kTouch * smaller(pair);
  double way = part.way[pair.a] + part.way[pair.b];
  // In many parts bodies may have been anywhere that they were not to leave unseen.
  if (part.many) way = std::max(way, before_[pair.a] + before_[pair.b]);
  double start = pair.fresh ? now - net : now + net;  // or more
  pair.fresh = pair.touched = false;
  pair.close = now < reach_[pair.a] + reach_[pair.b];
  if (start > way + near && now > 0.0) return;  // apart all the way
  const double known = deepest_ + kRounding * smaller(pair);
  if (now < -known || pair.gap > near) {
    look(pair, part);
    start = std::max(start, pair.gap - net);
  }
  if (std::min(start, pair.gap) > way + near) return;
  touch(pair);
  if (!part.many && way > kMidst * smaller(pair)) lookOnTheWay(pair, part);
}

}  // namespace tumble
