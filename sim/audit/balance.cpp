// Energy and momentum of the bodies that may have pushed each other in one part of a step.
#include <algorithm>
#include <cmath>

#include "sim/audit/audit.h"
#include "sim/collide/collide.h"
#include "sim/math/rotation.h"

namespace tumble {
namespace {

/// What counts as spin at least, of momentum times size: less is rounding.
constexpr double kLever = 1e-3;

/// Finds the root of a forest, and shortens the way to it.
int rootIn(std::vector<int>& forest, int i) {
  while (forest[i] != i) i = forest[i] = forest[forest[i]];
  return i;
}

}  // namespace

int Audit::rootOf(int body) {
  return rootIn(root_, body);
}

int Audit::familyOf(int body) {
  return rootIn(family_, body);
}

void Audit::join(int a, int b) {
  root_[std::max(rootOf(a), rootOf(b))] = std::min(rootOf(a), rootOf(b));
  meet(a, b);
}

/// Two families become one, with the gains of both.
void Audit::meet(int a, int b) {
  const int p = std::min(familyOf(a), familyOf(b)), q = std::max(familyOf(a), familyOf(b));
  if (p == q) return;
  family_[q] = p;
  families_[p].own += families_[q].own;
  families_[p].low += families_[q].low;
}

void Audit::holdBy(int body, int fixed) {
  Group& g = groups_[rootOf(body)];
  const auto stays = [&](int f) { return f == kNoBody || still(f); };
  if (g.held && g.fixed != fixed && !(stays(g.fixed) && stays(fixed))) g.unlike = true;
  g.held = true;
  g.fixed = fixed;
}

void Audit::group(const std::vector<Nearness::Pair>& touched) {
  for (std::size_t i = 0; i < root_.size(); ++i) root_[i] = static_cast<int>(i);
  for (const auto& [b, a] : touched)
    if (moves(a) && moves(b)) join(a, b);
  for (int i = 1; coarse_ && i < model_.count(); ++i)
    if (moves(i - 1) && moves(i)) join(i - 1, i);
  const auto free = [&](int body) { return body != kNoBody && moves(body); };
  for (const Bond& bond : bonds_)
    if (free(bond.a) && free(bond.b)) join(bond.a, bond.b);
  for (const Force& force : model_.def.forces) {
    if (const Spring* spring = std::get_if<Spring>(&force))
      if (free(spring->a) && free(spring->b)) join(spring->a, spring->b);
    if (const Bending* bending = std::get_if<Bending>(&force)) joinBent(bending->body->bodies);
  }

  groups_.assign(root_.size(), Group{});
  const bool springs = model_.runs == "course" && model_.def.course.contact == "penalty";
  toSolid_.assign(root_.size(), Vec3::Zero());
  pushed_.assign(root_.size(), false);
  for (const auto& [b, a] : touched) {
    if (moves(a) != moves(b)) holdBy(moves(a) ? a : b, moves(a) ? b : a);
    pushed_[a] = pushed_[b] = true;
    if (turns_ && model_.bends(a)) findFoot(a, b);
    if (turns_ && model_.bends(b)) findFoot(b, a);
    groups_[rootOf(moves(a) ? a : b)].springy = springs;
  }
  for (const int i : model_.solid)
    if (coarse_ && !moves(i)) {
      for (std::size_t k = 0; k < bodies_.size(); ++k)
        if (moves(k)) holdBy(k, i);
    }
  for (const Force& force : model_.def.forces)
    if (const Bending* bending = std::get_if<Bending>(&force)) holdBent(bending->body->bodies);
  for (const Bond& bond : bonds_) {
    for (const int i : {bond.a, bond.b})
      if (i != kNoBody) pushed_[i] = true;
    if (free(bond.a) != free(bond.b))
      holdBy(free(bond.a) ? bond.a : bond.b, free(bond.a) ? bond.b : bond.a);
  }
}

/// Where a solid pushes a point of what bends: on its skin.
void Audit::findFoot(int point, int solid) {
  const Pose at{last_[solid].x, last_[solid].q}, pointAt{last_[point].x, last_[point].q};
  const ContactPoint plane =
      separatingPlane(model_.shapes[point], pointAt, model_.shapes[solid], at);
  toSolid_[point] = -(nearness_.radius(point) + 0.5 * plane.separation) * plane.n;
}

/// The points of what bends that move are one group,
void Audit::joinBent(const std::vector<int>& points) {
  int first = -1;
  for (const int i : points) {
    if (!moves(i)) continue;
    if (first >= 0) join(first, i);
    first = i;
  }
}

/// held by those that do not; an implicit step turns it less than its forces would.
void Audit::holdBent(const std::vector<int>& points) {
  const auto moving = std::find_if(points.begin(), points.end(), [&](int i) { return moves(i); });
  if (moving == points.end()) return;
  groups_[rootOf(*moving)].bends = true;
  for (const int i : points)
    if (!moves(i)) holdBy(*moving, i);
}

RigidBody Audit::fixedAt(int body, double t) const {
  RigidBody fixed = bodies_[body];
  fixed.x += t * fixed.v;
  if (!fixed.omega.isZero(0.0)) fixed.q = rotated(fixed.q, t * fixed.omega);
  return fixed;
}

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
/// what it moves within it, neither impulse nor loss is known.
void Audit::findSwings() {
  constexpr double kSwing = 0.3, kLoss = 0.1;  // h² k/m and h c/m
  for (const Force& force : model_.def.forces) {
    const auto* spring = std::get_if<Spring>(&force);
    if (!spring) continue;
    for (const int i : {spring->a, spring->b}) {
      if (i == kNoBody || !moves(i)) continue;
      Group& g = groups_[rootOf(i)];
      g.swings = g.swings || h_ * h_ * spring->stiffness * bodies_[i].invM > kSwing;
      g.lost = g.lost || h_ * spring->damping * bodies_[i].invM > kLoss;
    }
  }
}

/// ∫F dt, ∫τ dt and work of the loads, by three Gauss nodes.
void Audit::addLoads() {
  constexpr double kNode = 0.1127016653792583, kEnds = 5.0 / 18.0, kMiddle = 8.0 / 18.0;
  const std::size_t n = bodies_.size();
  impulse_.assign(n, Vec3::Zero());
  moment_.assign(n, Vec3::Zero());
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
    if (!winds_ && moves(body) && paths.back().lost()) groups_[rootOf(body)].lost = true;
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

/// What an implicit step gives the points of what bends, where they were at its start: forces at
/// its end, linear about its start, or about its end, or between the two: what no solid and no
/// joint holds tells by how much.
void Audit::addBent() {
  std::vector<Vec3>&first = bentFirst_, &more = bentMore_;
  ElementTerms start, end;
  for (const Force& force : model_.def.forces) {
    const Bending* bending = std::get_if<Bending>(&force);
    if (!bending) continue;
    const std::vector<int>& points = bending->body->bodies;
    first.assign(bodies_.size(), Vec3::Zero());
    more.assign(bodies_.size(), Vec3::Zero());
    for (const Element& element : bending->body->elements) addElement(element, start, end);
    double both = 0.0, size = 0.0;
    for (const int i : points) {
      if (!moves(i) || pushed_[i]) continue;
      const Vec3 gained =
          now_[i].P - last_[i].P - h_ * bodies_[i].M * model_.def.gravity - impulse_[i];
      both += more[i].dot(gained - first[i]);
      size += more[i].squaredNorm();
    }
    const double share = both > 0.0 ? std::min(both / size, 1.0) : 0.0;
    for (const int i : points) impulse_[i] += first[i] + share * more[i];
  }
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

/// What bends is booked with the first of its points that moves, and asked of no other.
void Audit::findBearers() {
  bears_.assign(bodies_.size(), -1);
  for (std::size_t k = 0; k < model_.def.forces.size(); ++k) {
    const Bending* bending = std::get_if<Bending>(&model_.def.forces[k]);
    if (!bending) {
      alone_.push_back(static_cast<int>(k));
      continue;
    }
    const std::vector<int>& points = bending->body->bodies;
    const auto first = std::find_if(points.begin(), points.end(), [&](int i) { return moves(i); });
    if (first != points.end()) bears_[*first] = static_cast<int>(k);
  }
}

double Audit::potentialOf(int i, std::span<const Recorded> states) const {
  double sum = -bodies_[i].M * model_.def.gravity.dot(states[i].x);
  for (const int k : alone_) sum += storedIn(model_.def.forces[k], bodies_, states, i);
  if (const int k = bears_[i]; k >= 0) sum += storedIn(model_.def.forces[k], bodies_, states, i);
  return sum;
}

/// T + V of each body, and what the scene has at most.
void Audit::addMotions() {
  double kinetic = 0.0, momentum = 0.0, spin = 0.0;
  energyNow_.assign(bodies_.size(), 0.0);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!moves(i)) continue;
    const Recorded& r = now_[i];
    const double T = kineticOf(bodies_[i], r);
    energyNow_[i] = T + potentialOf(i, now_);
    const double P = r.P.norm();
    kinetic += T;
    momentum += P;
    spin += r.L.norm() + kLever * nearness_.radius(i) * P;
  }
  kineticMax_ = std::max(kineticMax_, kinetic);
  momentumMax_ = std::max(momentumMax_, momentum);
  spinMax_ = std::max(spinMax_, spin);
}

/// The largest kinetic energy lasts for a step or two: what a balance is relative to is asked for
/// of each.
void Audit::addKinetic(std::span<const RigidBody> bodies) {
  double kinetic = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (moves(i)) kinetic += kineticOf(bodies_[i], recordedOf(bodies[i]));
  kineticMax_ = std::max(kineticMax_, kinetic);
}

/// What changed between the two ends, less what loads explain.
void Audit::addStates() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!moves(i)) continue;
    Group& g = groups_[rootOf(i)];
    g.gain += energyNow_[i] - energyLast_[i] - work_[i];
    g.P += now_[i].P - last_[i].P - h_ * bodies_[i].M * model_.def.gravity - impulse_[i];
    g.L += now_[i].L - last_[i].L - moment_[i];
  }
}

/// Angular momentum about the centre of mass of a group that the centres of its bodies have.
void Audit::addTurns() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Group& g = groups_[rootOf(i)];
    if (!moves(i) || g.count < 2 || g.held) continue;
    g.X0 += bodies_[i].M / g.mass * last_[i].x;
    g.X1 += bodies_[i].M / g.mass * now_[i].x;
    g.P0 += last_[i].P / g.mass;
    g.P1 += now_[i].P / g.mass;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Group& g = groups_[rootOf(i)];
    if (!moves(i) || g.count < 2 || g.held) continue;
    g.L += (now_[i].x - g.X1).cross(now_[i].P - bodies_[i].M * g.P1) -
           (last_[i].x - g.X0).cross(last_[i].P - bodies_[i].M * g.P0);
  }
}

/// What a fixed body that moves gives the group it touches: the momentum that nothing else gave, in
/// its frame.
double Audit::workOfFixed(int root) const {
  const Group& g = groups_[root];
  const RigidBody start = fixedAt(g.fixed, t_ - h_), middle = fixedAt(g.fixed, t_ - 0.5 * h_);
  const double work = g.P.dot(start.v);
  if (start.omega.isZero(0.0)) return work;
  Vec3 moment = Vec3::Zero();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    int r = static_cast<int>(i);
    while (root_[r] != r) r = root_[r];
    if (!moves(i) || r != root) continue;
    const RigidBody& body = bodies_[i];
    const Recorded &p = last_[i], &q = now_[i];
    const Vec3 loads = h_ * body.M * model_.def.gravity + impulse_[i];
    // They act along its way, or where it was at the start of an implicit step, whatever shift it
    // had besides.
    const bool bends = model_.bends(static_cast<int>(i));
    const Vec3 from = bends ? start.x : middle.x;
    const Vec3 at = bends ? p.x : Vec3(0.5 * (p.x + q.x) + h_ / 12.0 * body.invM * (p.P - q.P));
    moment += q.L - p.L - moment_[i] + ((bends ? p.x : q.x) - from).cross(q.P) -
              (p.x - from).cross(p.P) - (at - from).cross(loads);
    if (bends) moment += toSolid_[i].cross(q.P - p.P - loads);
  }
  return work + moment.dot(start.omega);
}

/// Books what each group gained and what of its momentum is unexplained.
void Audit::settle() {
  bool told = true;
  quiet_ = true;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!moves(i)) continue;
    const int root = rootOf(i);
    const Group& g = groups_[root];
    const bool led = g.fixed != kNoBody && !still(g.fixed);
    bool known = !g.lost && !g.unlike && !g.springy;
    if (many_) known = known && stored_ && (winds_ || !led);
    quiet_ = quiet_ && g.held && !led && known;
    if (known) workDone_ += work_[i];
    if (static_cast<int>(i) == root) {
      told = told && known;
      if (known) book(root, led ? workOfFixed(root) : 0.0);
    }
    if (g.held || g.lost || g.swings || (many_ && !winds_)) continue;
    driftP_[i] += bodies_[i].M / g.mass * g.P;
    if (!g.bends) driftL_[i] += bodies_[i].M / g.mass * g.L;
  }
  if (!told) ++untold_;

  // Of a group as it is now, with what its bodies brought along.
  sumP_.assign(bodies_.size(), Vec3::Zero());
  sumL_.assign(bodies_.size(), Vec3::Zero());
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (moves(i)) sumP_[rootOf(i)] += driftP_[i], sumL_[rootOf(i)] += driftL_[i];
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    driftMaxP_ = std::max(driftMaxP_, sumP_[i].norm());
    driftMaxL_ = std::max(driftMaxL_, sumL_[i].norm());
  }
}

/// What a group gained beyond what a fixed body gave it.
void Audit::book(int root, double given) {
  Family& family = families_[familyOf(root)];
  family.own += groups_[root].gain - given;
  family.low = std::min(family.low, family.own);
  gain_ = std::max(gain_, family.own - family.low);
  workDone_ += given;
}

}  // namespace tumble
