// What loads give bodies along their ways, and an implicit step what bends.
#include <algorithm>
#include <cmath>

#include "sim/audit/audit.h"

namespace tumble {
namespace {

constexpr double kLoss = 0.1;  ///< h c/m of what is damped faster than its way tells

}  // namespace

/// Work [J] of the loads on a body that are the same all the way: winds and point forces.
double Audit::sameWorkOf(int i) const {
  double sum = 0.0;
  for (const Force& force : model_.def.forces) {
    const auto* wind = std::get_if<UniformWind>(&force);
    const auto* point = std::get_if<PointForce>(&force);
    if (wind && (wind->body == kNoBody || wind->body == i))
      sum += wind->force.dot(now_[i].x - last_[i].x);
    if (point && point->body == i)
      sum += point->force.dot(now_[i].x + now_[i].q * point->point_B - last_[i].x -
                              last_[i].q * point->point_B);
  }
  return sum;
}

/// The way between two ends is a cubic: of a spring that swings faster, or of a damper that stops
/// what it moves within it, neither impulse nor loss is known; but it gives a group none that both
/// its ends are of. Of drag that stops what it brakes the impulse is, by the way, and not the loss.
void Audit::findSwings() {
  constexpr double kSwing = 0.3;  // h² k/m
  const auto free = [&](int i) { return i != kNoBody && moves(i); };
  for (const Force& force : model_.def.forces) {
    if (const auto* drag = std::get_if<LinearDrag>(&force)) findStops(*drag);
    const auto* spring = std::get_if<Spring>(&force);
    if (!spring) continue;
    const bool within = free(spring->a) && free(spring->b);
    for (const int i : {spring->a, spring->b}) {
      if (!free(i)) continue;
      Group& g = groups_[rootOf(i)];
      const bool swings = h_ * h_ * spring->stiffness * bodies_[i].invM > kSwing,
                 stops = h_ * spring->damping * bodies_[i].invM > kLoss;
      g.unseen = g.unseen || (!within && (swings || stops));
      g.lost = g.lost || stops;
    }
  }
}

/// What drag brakes so fast that the loss is unknown.
void Audit::findStops(const LinearDrag& drag) {
  constexpr double kStops = 0.1;  // of what it moved with
  const auto stops = [](const Vec3& before, const Vec3& after) {
    return (after - before).norm() > kStops * before.norm();
  };
  for (int i = 0; i < model_.count(); ++i) {
    if (!moves(i) || (drag.body != kNoBody && drag.body != i)) continue;
    const RigidBody& body = bodies_[i];
    const double turning = body.particle ? 0.0 : body.IbodyInv.norm();
    Group& g = groups_[rootOf(i)];
    g.lost = g.lost || (h_ * drag.linear * body.invM > kLoss && stops(last_[i].P, now_[i].P)) ||
             (h_ * drag.angular * turning > kLoss &&
              stops(spinOf(body, last_[i]), spinOf(body, now_[i])));
  }
}

/// ∫F dt, ∫τ dt and work of the loads, by three Gauss nodes.
void Audit::addLoads() {
  constexpr double kNode = 0.1127016653792583, kEnds = 5.0 / 18.0, kMiddle = 8.0 / 18.0;
  const std::size_t n = bodies_.size();
  impulse_.assign(n, Vec3::Zero());
  moment_.assign(n, Vec3::Zero());
  inside_.assign(n, Vec3::Zero());
  work_.assign(n, 0.0);
  if (alone_.empty() || h_ == 0.0) return;  // what bends is a potential, as gravity is
  if (many_ && !winds_) {
    for (std::size_t i = 0; i < n; ++i)
      if (moves(i)) work_[i] = sameWorkOf(i);
    return;
  }
  findSwings();
  std::vector<BodyPath>& paths = paths_;
  paths.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const int body = static_cast<int>(i);
    paths.push_back(moves(body) ? BodyPath(bodies_[i], last_[i], now_[i], h_, struck_)
                                : BodyPath(fixedAt(body, t_ - h_), h_));
    if (!winds_ && moves(body) && paths.back().lost()) {
      Group& g = groups_[rootOf(body)];
      g.lost = g.unseen = true;
    }
  }
  points_.resize(n);
  for (const auto& [share, weight] :
       {std::pair(kNode, kEnds), {0.5, kMiddle}, {1.0 - kNode, kEnds}}) {
    for (std::size_t i = 0; i < n; ++i) points_[i] = paths[i].at(share);
    loads_.sum(model_.def.forces, bodies_, points_);
    // Torques count about the centre of mass of a group.
    centre_.assign(n, Vec3::Zero());
    for (std::size_t i = 0; i < n; ++i)
      if (moves(i)) centre_[rootOf(i)] += bodies_[i].M / groups_[rootOf(i)].mass * points_[i].x;
    for (std::size_t i = 0; i < n; ++i) {
      if (!moves(i)) continue;
      const Vec3 arm = points_[i].x - centre_[rootOf(i)];
      impulse_[i] += h_ * weight * loads_.force[i];
      if (!bodies_[i].particle) moment_[i] += h_ * weight * loads_.torque[i];
      if (groups_[rootOf(i)].count > 1)
        groups_[rootOf(i)].L -= h_ * weight * arm.cross(loads_.force[i]);
      work_[i] += h_ * weight * loads_.power[i];
    }
  }
}

/// What cloth that presses on cloth gives its points: forces where they are at the end of a step.
void Audit::addPressed() {
  for (const LayerPair& pair : layersLook_.pairs)
    for (int k = 0; k < 4; ++k) {
      const int i = layers_->points()[pair.points[k]];
      const double push = h_ * pair.stiffness * (pair.thickness - pair.distance);
      impulse_[i] += push * pair.weight[k] * pair.n;
      inside_[i] += push * pair.weight[k] * pair.n;
    }
}

/// What an implicit step gives the points of what bends, where they were at its start: forces at
/// its end, linear about its start, or about its end, or between the two: what no solid and no
/// joint holds tells by how much. Where a solid may have pushed any of them, it pushed few: most
/// are near one of the two. Forces that a step made linear about other places stay unknown.
void Audit::addBent() {
  std::vector<Vec3>&first = bentFirst_, &more = bentMore_;
  ElementTerms start, end;
  const auto gainedBy = [&](int i) -> Vec3 {
    return now_[i].P - last_[i].P - h_ * bodies_[i].M * model_.def.gravity - impulse_[i];
  };
  for (const Force& force : model_.def.forces) {
    const Bending* bending = std::get_if<Bending>(&force);
    if (!bending) continue;
    const std::vector<int>& points = bending->body->bodies;
    first.assign(bodies_.size(), Vec3::Zero());
    more.assign(bodies_.size(), Vec3::Zero());
    for (const Element& element : bending->body->elements) addElement(element, start, end);
    double both = 0.0, size = 0.0, offFirst = 0.0, offEnd = 0.0;
    for (const int i : points) {
      if (!moves(i) || joined_[i]) continue;
      const Vec3 others = gainedBy(i) - first[i];
      offFirst += others.norm();
      offEnd += (others - more[i]).norm();
      if (pushed_[i]) continue;
      both += more[i].dot(others);
      size += more[i].squaredNorm();
    }
    double share = both > 0.0 ? std::min(both / size, 1.0) : 0.0;
    if (size == 0.0 && offEnd < offFirst) share = 1.0;
    double off = size == 0.0 ? std::min(offFirst, offEnd) : 0.0;
    for (const int i : points) {
      const Vec3 inside = first[i] + share * more[i];
      inside_[i] += inside;
      impulse_[i] += inside;
      if (moves(i) && !pushed_[i]) off += gainedBy(i).norm();
    }
    unsureNow_ += unsureOf(*bending->body, off);
  }
}

/// What impulses that are not known so far [N s] do at most [J] where points turn with who leads
/// them.
double Audit::unsureOf(const ElasticBody& body, double off) const {
  double fastest = 0.0;
  for (const int i : body.bodies) {
    int root = i;
    while (root_[root] != root) root = root_[root];
    const int fixed = groups_[root].fixed;
    if (!moves(i) || fixed == kNoBody) continue;
    const Vec3 arm = last_[i].x - fixedAt(fixed, t_ - h_).x;
    fastest = std::max(fastest, bodies_[fixed].omega.cross(arm).norm());
  }
  return fastest * off;
}

void Audit::addElement(const Element& element, ElementTerms& start, ElementTerms& end) {
  ElementPlaces from, to;
  from.fill(Vec3::Zero());
  to.fill(Vec3::Zero());
  ElementVector way = ElementVector::Zero();
  for (int k = 0; k < element.count; ++k) {
    const int i = element.points[k];
    from[k] = last_[i].x;
    to[k] = now_[i].x;
    way.segment<3>(3 * k) = to[k] - from[k];
  }
  differentiate(element.energy, from, ElementAsk::Projected, start);
  differentiate(element.energy, to, ElementAsk::Forces, end);
  const ElementVector linear = start.gradient + elementTimes(start.hessian, way, element.count),
                      damped = elementTimes(start.damping, way, element.count);
  for (int k = 0; k < element.count; ++k) {
    const auto at = [k](const ElementVector& v) { return v.segment<3>(3 * k); };
    bentFirst_[element.points[k]] -= h_ * at(linear) + at(damped);
    bentMore_[element.points[k]] -= h_ * (at(end.gradient) - at(linear));
  }
}

}  // namespace tumble
