// Energy and momentum of the bodies that may have pushed each other in one part of a step; groups,
// what they are given and what is open share their books, and so long.
#include <algorithm>
#include <cmath>

#include "sim/audit/audit.h"
#include "sim/collide/collide.h"
#include "sim/math/rotation.h"

namespace tumble {
namespace {

/// What counts as spin at least, of momentum times size: less is rounding.
constexpr double kLever = 1e-3;
/// Held by nothing, not by the world either.
constexpr int kFree = -2;

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
  int& own = holder_[body];
  if (own != kFree && own != fixed && !(stays(own) && stays(fixed))) g.torn = true;
  own = fixed;
  g.held = true;
  g.fixed = fixed;
}

/// What each group of those that may have touched has gained, less what loads explain.
void Audit::balance() {
  group(nearness_.touched());
  unsureNow_ = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!moves(i)) continue;
    Group& g = groups_[rootOf(i)];
    ++g.count;
    g.mass += bodies_[i].M;
  }
  addLoads();
  if (turns_ && !many_) {
    addPressed();
    addBent();
  }
  addRubs();
  addStates();
  addTurns();
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
    if (const auto* layering = std::get_if<Layering>(&force)) joinLayers(*layering->layers);
  }

  groups_.assign(root_.size(), Group{});
  holder_.assign(root_.size(), kFree);
  for (int i = 0; i < model_.count(); ++i)
    if (moves(i) && !(turns_ && model_.bends(i))) groups_[rootOf(i)].torn = true;
  const bool springs = model_.runs == "course" && model_.def.course.contact == "penalty";
  feet_.clear();
  pushed_.assign(root_.size(), false);
  for (const auto& [b, a] : touched) {
    if (moves(a) != moves(b)) holdBy(moves(a) ? a : b, moves(a) ? b : a);
    pushed_[a] = pushed_[b] = true;
    if (rubs(a, b)) addFoot(a, b);
    if (rubs(b, a)) addFoot(b, a);
    groups_[rootOf(moves(a) ? a : b)].springy = springs;
  }
  for (const int i : model_.solid)
    if (coarse_ && !moves(i)) {
      for (std::size_t k = 0; k < bodies_.size(); ++k)
        if (moves(k)) holdBy(k, i);
    }
  for (const Force& force : model_.def.forces)
    if (const Bending* bending = std::get_if<Bending>(&force)) holdBent(bending->body->bodies);
  if (layers_) holdLayers();
  for (const Bond& bond : bonds_) {
    for (const int i : {bond.a, bond.b})
      if (i != kNoBody) pushed_[i] = true;
    if (free(bond.a) != free(bond.b))
      holdBy(free(bond.a) ? bond.a : bond.b, free(bond.a) ? bond.b : bond.a);
  }
}

/// Whether it counts where a body pushes a point of mass: what rubs its skin turns what rubs it,
/// and not the point.
bool Audit::rubs(int point, int body) const {
  if (!moves(point) || !bodies_[point].particle) return false;
  if (model_.bends(point)) return turns_;
  return model_.surface(point, body).friction > 0.0;
}

/// Of several pushes on a point nobody can tell which was how large, and of one in many parts not
/// where it was.
void Audit::addFoot(int point, int body) {
  const auto with = [&](const std::pair<int, int>& foot) { return foot.first == point; };
  if (!model_.bends(point) && (many_ || std::any_of(feet_.begin(), feet_.end(), with)))
    groups_[rootOf(point)].vague = true;
  feet_.push_back({point, body});
}

/// Spin that what rubbed a point of mass did not have from it, about where it pushed: the point
/// takes none.
void Audit::addRubs() {
  rubbed_.assign(bodies_.size(), Vec3::Zero());
  for (const auto& [point, body] : feet_) {
    const std::span<const Ways::Part> own = ways_.of(point), others = ways_.of(body);
    if (own.empty()) {
      addRub({point, t_ - h_, t_, last_[point], now_[point]}, last_[point].P,
             {body, t_ - h_, t_, last_[body], now_[body]});
    }
    for (std::size_t k = 0; k < own.size(); ++k) {
      Ways::Part other{body, own[k].t0, own[k].t1, last_[body], now_[body]};
      if (k < others.size()) other = others[k];
      addRub(own[k], k > 0 ? own[k - 1].end.P : last_[point].P, other);
    }
  }
}

/// Of one part: what struck the point at its start, and what pushed it along its way. What bends is
/// pushed where an implicit step starts.
void Audit::addRub(const Ways::Part& part, const Vec3& P, const Ways::Part& other) {
  constexpr int kLooks = 4;
  const int i = part.body, j = other.body;
  const double h = part.t1 - part.t0;
  // Where it is pushed is on its skin.
  const auto foot = [&](const Pose& own, const Pose& at) {
    const ContactPoint plane = separatingPlane(model_.shapes[i], own, model_.shapes[j], at);
    return Vec3(-(nearness_.radius(i) + 0.5 * plane.separation) * plane.n);
  };
  const Vec3 loads =
      h * bodies_[i].M * model_.def.gravity + (h_ > 0.0 ? h / h_ : 1.0) * impulse_[i];
  const Vec3 start = foot({part.start.x, part.start.q}, {other.start.x, other.start.q});
  if (h == 0.0 || model_.bends(i)) {
    rubbed_[i] += start.cross(part.end.P - P - loads);
    return;
  }
  const BodyPath way(bodies_[i], part.start, part.end, h, struck_);
  const BodyPath otherWay = moves(j) ? BodyPath(bodies_[j], other.start, other.end, h, struck_)
                                     : BodyPath(fixedAt(j, part.t0), h);
  if (otherWay.lost() && !std::holds_alternative<Sphere>(model_.shapes[j]))
    groups_[rootOf(i)].vague = true;
  Vec3 before = bodies_[i].M * way.at(0.0).v;
  rubbed_[i] += start.cross(before - P);
  for (int k = 0; k < kLooks; ++k) {
    const PathPoint at = way.at((k + 0.5) / kLooks), its = otherWay.at((k + 0.5) / kLooks);
    const Vec3 after = bodies_[i].M * way.at((k + 1.0) / kLooks).v;
    rubbed_[i] += foot({at.x, at.q}, {its.x, its.q}).cross(after - before - loads / kLooks);
    before = after;
  }
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

/// Cloths that met in the step are one group, and so is what bears their energy.
void Audit::joinLayers(const Layers& layers) {
  if (layers.firsts().size() < 2) return;
  std::vector<Vec3> x, way;
  for (const int i : layers.points()) {
    x.push_back(last_[i].x);
    way.push_back(now_[i].x - last_[i].x);
  }
  layers.meet(x, way, layersLook_);
  for (const auto& [a, b] : layersLook_.met) {
    const int p = layerBearer_[layers.firsts()[a]], q = layerBearer_[layers.firsts()[b]];
    if (p != kNoBody && q != kNoBody) join(p, q);
  }
}

/// A cloth that stands holds those that met it.
void Audit::holdLayers() {
  const std::vector<int>&points = layers_->points(), &firsts = layers_->firsts();
  for (const auto& [a, b] : layersLook_.met) {
    const int p = layerBearer_[firsts[a]], q = layerBearer_[firsts[b]];
    if ((p == kNoBody) != (q == kNoBody))
      holdBy(p != kNoBody ? p : q, points[p != kNoBody ? firsts[b] : firsts[a]]);
  }
}

/// What presses is booked with the first point that moves of the cloth of its first point, or of
/// its last.
void Audit::findLayerBearers(const Layers& layers) {
  layers_ = &layers;
  const std::vector<int>&points = layers.points(), &firsts = layers.firsts();
  for (std::size_t c = 0; c < firsts.size(); ++c) {
    const auto begin = points.begin() + firsts[c],
               end = c + 1 < firsts.size() ? points.begin() + firsts[c + 1] : points.end();
    const auto first = std::find_if(begin, end, [&](int i) { return moves(i); });
    layerBearer_.insert(layerBearer_.end(), end - begin, first != end ? *first : kNoBody);
  }
}

void Audit::addLayers() {
  if (!layers_) return;
  std::vector<Vec3> x;
  for (const int i : layers_->points()) x.push_back(now_[i].x);
  layers_->look(x, {}, layersLook_);
  for (const LayerPair& pair : layersLook_.pairs) {
    const int p = layerBearer_[pair.points[0]], q = layerBearer_[pair.points[3]];
    if (p != kNoBody || q != kNoBody) energyNow_[p != kNoBody ? p : q] += pair.energy();
  }
}

/// held by those that do not.
void Audit::holdBent(const std::vector<int>& points) {
  const auto moving = std::find_if(points.begin(), points.end(), [&](int i) { return moves(i); });
  if (moving == points.end()) return;
  for (const int i : points)
    if (!moves(i)) holdBy(*moving, i);
}

RigidBody Audit::fixedAt(int body, double t) const {
  RigidBody fixed = bodies_[body];
  fixed.x += t * fixed.v;
  if (!fixed.omega.isZero(0.0)) fixed.q = rotated(fixed.q, t * fixed.omega);
  return fixed;
}

/// What bends is booked with the first of its points that moves, and asked of no other.
void Audit::findBearers() {
  bears_.assign(bodies_.size(), -1);
  for (std::size_t k = 0; k < model_.def.forces.size(); ++k) {
    if (const auto* layering = std::get_if<Layering>(&model_.def.forces[k])) {
      findLayerBearers(*layering->layers);
      continue;
    }
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

/// Angular momentum [N m s] of what bends about the centre of its points that move.
double Audit::turnOf(const ElasticBody& body) const {
  double mass = 0.0;
  Vec3 x = Vec3::Zero(), P = Vec3::Zero(), L = Vec3::Zero();
  for (const int i : body.bodies) {
    if (!moves(i)) continue;
    mass += bodies_[i].M;
    x += bodies_[i].M * now_[i].x;
    P += now_[i].P;
  }
  if (mass == 0.0) return 0.0;
  for (const int i : body.bodies)
    if (moves(i)) L += (now_[i].x - x / mass).cross(now_[i].P - bodies_[i].M / mass * P);
  return L.norm();
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
  addLayers();
  for (const Force& force : model_.def.forces)
    if (const Bending* bending = std::get_if<Bending>(&force)) spin += turnOf(*bending->body);
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
    if (!model_.bends(static_cast<int>(i))) g.L += rubbed_[i];
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
    const Vec3 before = (last_[i].x - g.X0).cross(last_[i].P - bodies_[i].M * g.P0);
    g.L += (now_[i].x - g.X1).cross(now_[i].P - bodies_[i].M * g.P1) - before;
    g.turn += before + last_[i].L;
  }
  double spin = 0.0;
  for (const Group& g : groups_) spin += g.turn.norm();
  spinMax_ = std::max(spinMax_, spin);
}

/// What a fixed body that moves gives the group it touches: the momentum that nothing else gave, in
/// its frame.
double Audit::workOfFixed(int root) const {
  const Group& g = groups_[root];
  const RigidBody start = fixedAt(g.fixed, t_ - h_), middle = fixedAt(g.fixed, t_ - 0.5 * h_);
  const double work = g.P.dot(start.v);
  if (start.omega.isZero(0.0)) return work;
  Vec3 moment = Vec3::Zero(), turn = Vec3::Zero();
  double momenta = 0.0, levers = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    int r = static_cast<int>(i);
    while (root_[r] != r) r = root_[r];
    if (!moves(i) || r != root) continue;
    const RigidBody& body = bodies_[i];
    const Recorded &p = last_[i], &q = now_[i];
    const Vec3 loads = h_ * body.M * model_.def.gravity + impulse_[i];
    const Vec3 way = 0.5 * (p.x + q.x) + h_ / 12.0 * body.invM * (p.P - q.P);
    // They act along its way, or where it was at the start of an implicit step, whatever shift it
    // had besides.
    const bool bends = model_.bends(static_cast<int>(i));
    const Vec3 from = bends ? start.x : middle.x;
    const Vec3 at = bends ? p.x : way;
    turn += q.L - p.L - moment_[i] + (q.x - middle.x).cross(q.P) - (p.x - middle.x).cross(p.P) -
            (way - middle.x).cross(loads - inside_[i]);
    momenta += p.P.norm();
    levers += (p.x - middle.x).norm() * p.P.norm() + p.L.norm();
    moment += q.L - p.L - moment_[i] + ((bends ? p.x : q.x) - from).cross(q.P) -
              (p.x - from).cross(p.P) - (at - from).cross(loads);
    moment += rubbed_[i];
  }
  // What gained neither momentum nor spin was pushed by nothing, whatever went on inside.
  constexpr double kNone = 1e-9;
  if (g.P.norm() <= kNone * momenta && turn.norm() <= kNone * levers) return 0.0;
  return work + moment.dot(start.omega);
}

/// What fixed bodies that move give points of what bends: each what it pushed, where it was at the
/// start of an implicit step.
double Audit::workOfSeveral(int root) const {
  double work = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    int r = static_cast<int>(i);
    while (root_[r] != r) r = root_[r];
    const int f = holder_[i];
    if (!moves(i) || r != root || f == kFree || f == kNoBody || still(f)) continue;
    const RigidBody start = fixedAt(f, t_ - h_);
    const Vec3 push = now_[i].P - last_[i].P - h_ * bodies_[i].M * model_.def.gravity - impulse_[i];
    work +=
        push.dot(start.v + start.omega.cross(last_[i].x - start.x)) + rubbed_[i].dot(start.omega);
  }
  return work;
}

/// Books what each group gained and what of its momentum is unexplained.
void Audit::settle() {
  bool told = true;
  quiet_ = true;
  unsure_ += unsureNow_;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!moves(i)) continue;
    const int root = rootOf(i);
    const Group& g = groups_[root];
    const bool led = isLed(g);
    bool known = !g.lost && !(g.unlike && g.torn) && !g.springy && !(led && g.vague);
    if (many_) known = known && stored_ && (winds_ || !led);
    quiet_ = quiet_ && g.held && !led && known;
    if (known) workDone_ += work_[i];
    if (static_cast<int>(i) == root) {
      told = told && known;
      if (known) book(root, g.unlike ? workOfSeveral(root) : led ? workOfFixed(root) : 0.0);
    }
    if (g.held || g.unseen || (many_ && !winds_)) continue;
    driftP_[i] += bodies_[i].M / g.mass * g.P;
    if (!g.vague) driftL_[i] += bodies_[i].M / g.mass * g.L;
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
