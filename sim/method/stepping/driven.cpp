// Springs and drag in a step. Driven groups that something touches, or that are too stiff to be
// followed, have their springs solved together with contacts, in parts of a step where they swing
// fast; drag decays on the way. What joints alone hold goes by RATTLE under all forces: half of
// what they give comes before the move, half after it,
//   M (v½ − v0) = ½ h F(x0, v0) + J0ᵀ λ0,  x1 = x0 + h v½,
//   M (v1 − v½) = ½ h F(x1, 2 v½ − v0) + J1ᵀ λ1,
// where 2 v½ − v0 differs from v1 by terms in h².
#include <algorithm>
#include <cmath>

#include "sim/body/force.h"
#include "sim/contact/rows.h"
#include "sim/math/frames.h"
#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

/// Tells which groups are stiff, and which chains nothing touches: until one of them is seen to
/// meet what is near it, it goes as joints and springs alone have it.
void Stepping::freeChains(double h) {
  constexpr double kStiff = 40.0;  // [rad] in a step: below, some thousand evaluations follow it
  constexpr double kSoft = 0.5;    // [rad] in a part: what is faster is followed by rows
  Drives& drives = *memory_.drives;
  if (drives.chains.empty()) return;
  for (Chain& chain : drives.chains) chain.soft = true;
  for (DrivenGroup& group : drives.groups) {
    group.fastest = fastestDrive(group, drives.drags, drives.dragOf, state_.bodies);
    group.stiff = group.fastest * model_.def.stepping.step > kStiff;
    if (group.fastest * h > kSoft) drives.chains[group.chain].soft = false;
  }
  for (Chain& chain : drives.chains) chain.free = chain.soft && !bends() && !isDrafted();
  for (const PairMemory& pair : memory_.pairs) {
    for (const Touch& touch : pair.touches) {
      if (!closed(touch)) continue;
      touchChain(touch.contact.a);
      touchChain(touch.contact.b);
    }
  }
  for (PairMemory& pair : memory_.pairs)
    for (Touch& touch : pair.touches)
      if (isFree(touch.contact.a) || isFree(touch.contact.b)) touch.impulse.setZero();
}

bool Stepping::swingsIntoBlow(double h) const {
  constexpr double kBlow = 0.1;  // [rad] of a swing, in a part of a step
  if (!tiesRun() || isDrafted()) return false;
  const std::vector<DrivenGroup>& groups = memory_.drives->groups;
  return std::any_of(groups.begin(), groups.end(), [&](const DrivenGroup& group) {
    return group.bound && !group.stiff && !group.halved && !group.springs.empty() &&
           group.fastest * h > kBlow &&
           std::any_of(group.bodies.begin(), group.bodies.end(), [&](int i) { return moves(i); });
  });
}

void Stepping::touchChain(int body) {
  if (const int chain = memory_.drives->chainOf[body]; chain >= 0)
    memory_.drives->chains[chain].free = false;
}

/// Tells what something holds, and on which chains forces act in halves.
void Stepping::findHolds(double h) {
  Drives& drives = *memory_.drives;
  for (Chain& chain : drives.chains) chain.halved = chain.soft && !chain.limited;
  work_.joined.assign(state_.bodies.size() + 1, 0);
  for (std::size_t k = 0; k < state_.near.size(); ++k) {
    const std::vector<Touch>& touches = memory_.pairs[k].touches;
    if (std::all_of(touches.begin(), touches.end(),
                    [&](const Touch& touch) { return flies(touch, h); }))
      continue;
    for (const int i : {state_.near[k].first, state_.near[k].second}) {
      work_.joined[i] = 1;
      if (const int chain = drives.chainOf[i]; chain >= 0) drives.chains[chain].halved = false;
    }
  }
  for (const Joint& joint : model_.joints) work_.joined[joint.a] = work_.joined[joint.b] = 1;
}

void Stepping::bindGroups(double h) {
  Drives& drives = *memory_.drives;
  if (work_.flown.empty() || (tiesRun() && !drives.groups.empty()))
    work_.flown.assign(state_.bodies.size(), 0);
  if (!tiesRun()) return;
  work_.drags.clear();
  for (const Drag& drag : drives.drags)
    work_.drags.push_back(dragStep(drag, state_.bodies[drag.body], h));
  if (drives.groups.empty()) return;
  findHolds(h);
  for (DrivenGroup& group : drives.groups) {
    const auto held = [&](int i) { return !model_.fixed(i) && work_.joined[i]; };
    group.bound = group.stiff || std::any_of(group.bodies.begin(), group.bodies.end(), held);
    group.halved = group.bound && drives.chains[group.chain].halved;
    for (std::size_t k = 0; k < group.bodies.size(); ++k) {
      if (model_.fixed(group.bodies[k])) continue;
      if (!group.bound) work_.flown[group.bodies[k]] = 1;
      group.moved[k] = state_.bodies[group.bodies[k]];
    }
    if (group.halved) group.power = powerOfForces(group.forces, group.moved);
    if (!group.bound || (group.springs.empty() && !group.steady)) continue;
    sumForces(model_.def.gravity, group.halved ? group.forces : group.others, group.moved);
    for (std::size_t k = 0; k < group.bodies.size(); ++k) {
      RigidBody& body = state_.bodies[group.bodies[k]];
      if (body.fixed()) continue;
      body.force = group.moved[k].force;
      body.torque = group.moved[k].torque;
    }
  }
}

double Stepping::storedInStiff() const {
  double sum = 0.0;
  for (const DrivenGroup& group : memory_.drives->groups)
    if (group.bound && group.stiff)
      sum += potentialEnergy(Vec3::Zero(), group.stores, state_.bodies);
  return sum;
}

void Stepping::addSprings(double h) {
  work_.springs.clear();
  if (!tiesRun()) return;
  for (const DrivenGroup& group : memory_.drives->groups) {
    if (!group.bound || group.halved) continue;
    for (const Spring& spring : group.springs) addSpring(spring, group.stiff, h);
    if (group.stiff && !group.springs.empty())
      report_.note(
          "springs or dampers that are too fast for a step were followed implicitly, which damps "
          "them; a smaller stepping.step follows them closer");
  }
  work_.stored = storedInStiff();
}

/// What the length of a spring gains per second squared while its ends go on as they do:
///   |ṗ⊥|²/l + n·(ω × (ω × r))  of one end against the other.
double Stepping::bend(const Spring& spring, const SpringEnds& at) const {
  struct Way {
    Vec3 v = Vec3::Zero(), turn = Vec3::Zero();
  };
  const auto wayOf = [&](int i, const Vec3& p) {
    if (i == kNoBody) return Way{};
    const RigidBody& body = state_.bodies[i];
    return Way{pointVelocity(body, p), body.omega.cross(body.omega.cross(p - body.x))};
  };
  const Way a = wayOf(spring.a, at.pa), b = wayOf(spring.b, at.pb);
  const Vec3 n = (at.pa - at.pb).normalized(), v = a.v - b.v;
  return (v - n.dot(v) * n).squaredNorm() / (at.pa - at.pb).norm() + n.dot(a.turn - b.turn);
}

Stepping::SpringEnds Stepping::endsOf(const Spring& spring, double ahead) const {
  const auto end = [&](int i, const Vec3& anchor_B, Vec3& x, Vec3& p) {
    p = anchor_B;
    if (i == kNoBody) return;
    const RigidBody& body = state_.bodies[i];
    Pose pose = body.pose();
    if (ahead > 0.0) {
      pose.x += ahead * body.v;
      pose.q = rotated(pose.q, ahead * body.omega).normalized();
    }
    x = pose.x;
    p = toWorld(pose, anchor_B);
  };
  SpringEnds at;
  end(spring.a, spring.anchorA_B, at.xa, at.pa);
  end(spring.b, spring.anchorB_B, at.xb, at.pb);
  return at;
}

Row Stepping::springRow(const Spring& spring, const SpringEnds& at, const Vec3& d) const {
  const int world = static_cast<int>(state_.bodies.size());
  Row row{.a = spring.a,
          .b = spring.b == kNoBody ? world : spring.b,
          .linear = d,
          .angularA = turnAbout(at.xa, at.pa, d)};
  if (row.b != world) row.angularB = -turnAbout(at.xb, at.pb, d);
  return row;
}

/// Along the spring, and, where it pulls, across it: tension over length is what it resists there.
void Stepping::addSpring(const Spring& spring, bool stiff, double h) {
  const SpringEnds at = endsOf(spring, 0.0);
  const auto add = [&](const Vec3& d, const SpringLaw& law, int across) {
    const int bond = static_cast<int>(work_.bonds.rows.size());
    SpringRow made{.bond = bond, .spring = &spring, .across = across, .law = law, .stiff = stiff};
    Row row = springRow(spring, at, d);
    if (!setSpringRow(made, law, h, row)) return;
    work_.springs.push_back(made);
    work_.bonds.add(row, ConeKind::Equality, -1, 0);
  };
  const double length = (at.pa - at.pb).norm(), stretch = length - spring.rest;
  if (length == 0.0) {  // no direction: it pulls alike along all, or at nothing
    if (spring.rest == 0.0)
      for (int k = 0; k < 3; ++k) add(Vec3::Unit(k), {spring.stiffness, 0.0, 0.0}, 3);
    return;
  }
  const Vec3 along = (at.pa - at.pb) / length;
  add(along, {spring.stiffness, spring.damping, stretch, 0.5 * h * h * bend(spring, at)}, 0);
  const double across = spring.stiffness * stretch / length;
  if (across <= 0.0) return;
  const Vec3 t1 = along.unitOrthogonal(), t2 = along.cross(t1);
  add(t1, {across, 0.0, 0.0}, 1);
  add(t2, {across, 0.0, 0.0}, 2);
}

bool Stepping::setSpringRow(SpringRow& spring, const SpringLaw& law, double h, Row& row) const {
  const auto mobility = [&](int i, const Vec3& turn) {
    if (i == static_cast<int>(state_.bodies.size()) || model_.fixed(i)) return 0.0;
    return state_.bodies[i].invM + turn.dot(state_.bodies[i].Iinv * turn);
  };
  const double moves = mobility(row.a, row.angularA) + mobility(row.b, row.angularB);
  const auto share = [](double x) { return x * x / (16.0 + x * x); };
  const double swift = share(h * h * law.stiffness * moves),
               damped = share(h * law.damping * moves);
  spring.a = 0.25 + 0.75 * swift;
  spring.b = 0.25 - 0.25 * swift;
  spring.theta = 0.5 + 0.5 * damped;
  spring.before = rowSpeed(row, work_.before[row.a], work_.before[row.b]);
  const double yields = h * (h * law.stiffness * spring.a + law.damping * spring.theta);
  if (yields <= 0.0) return false;
  const double slow = h * law.stiffness * spring.b - law.damping * (1.0 - spring.theta);
  row.compliance = 1.0 / yields;
  const double stretch = law.stretch + swift * law.bend;
  row.bias = h * (law.stiffness * stretch - slow * spring.before) / yields;
  return true;
}

bool Stepping::isSprung(int body) const {
  const int group = memory_.drives->groupOf[body];
  if (group < 0) return false;
  const DrivenGroup& driven = memory_.drives->groups[group];
  return driven.plain && memory_.drives->chains[driven.chain].soft;
}

bool Stepping::isSprung(const Island& island) const {
  bool touches = false;
  for (const Link link : island.links) {
    touches = touches || isPair(link);
    if (isPair(link)) continue;
    const SpringRow* spring = springOf(link);
    if (!spring || spring->across > 2 || !isSprung(spring->spring->a)) return false;
  }
  return touches;
}

/// In a smooth step a spring is taken where its ends come to in its middle, as they go on; λ holds
/// what differs from that: h²/4 of what its ends gain in speed.
void Stepping::springAnew(Island& island, double h) {
  for (const Link link : island.links) {
    if (isPair(link)) continue;
    SpringRow& spring = *springOf(link);
    const SpringEnds at = endsOf(*spring.spring, island.smooth ? 0.5 * h : 0.0);
    const double length = (at.pa - at.pb).norm();
    if (length == 0.0) continue;  // it has no direction there: that of the start stays
    const Vec3 along = (at.pa - at.pb) / length, t1 = along.unitOrthogonal();
    SpringLaw law = spring.law;
    if (island.smooth && spring.across == 0) {
      law.stretch = length - spring.spring->rest;
      law.bend = 0.0;
    }
    const Vec3 d = spring.across == 0 ? along : spring.across == 1 ? t1 : along.cross(t1);
    Row& row = bondOf(link);
    row = springRow(*spring.spring, at, d);
    setSpringRow(spring, law, h, row);
  }
}

/// Of soft springs, what the damper takes and what the row damps; of stiff ones, all that goes.
void Stepping::bookSprings(double h) {
  if (!tiesRun()) return;
  double work = 0.0;
  for (const SpringRow& spring : work_.springs) {
    const Row& row = work_.bonds.rows[spring.bond];
    const double after = rowSpeed(row, work_.after[row.a], work_.after[row.b]);
    const double mean = 0.5 * (spring.before + after);
    const SpringLaw& law = spring.law;
    if (spring.stiff) {
      work += work_.bonds.lambda[spring.bond] * mean;
    } else {
      const double damper =
          law.damping * (spring.theta * after + (1.0 - spring.theta) * spring.before);
      work -= h * (damper + h * law.stiffness * (spring.a - spring.b) * after) * mean;
    }
  }
  report_.certificate.work_of_forces += work + storedInStiff() - work_.stored;
}

/// The second half of what forces give, where the bodies now are.
void Stepping::pushAgain(double h) {
  if (!tiesRun()) return;
  for (DrivenGroup& group : memory_.drives->groups) {
    if (!group.halved) continue;
    for (std::size_t k = 0; k < group.bodies.size(); ++k) {
      RigidBody& ahead = group.moved[k];
      ahead = state_.bodies[group.bodies[k]];
      if (ahead.fixed()) continue;
      const Push& push = memory_.pushes[group.bodies[k]];
      ahead.P = 2.0 * ahead.P - push.P0;
      ahead.L = 2.0 * ahead.L - push.L0;
      updateVelocities(ahead);
    }
    sumForces(model_.def.gravity, group.forces, group.moved);
    for (std::size_t k = 0; k < group.bodies.size(); ++k) {
      RigidBody& body = state_.bodies[group.bodies[k]];
      if (body.fixed()) continue;
      body.P += 0.5 * h * group.moved[k].force;
      body.L += 0.5 * h * group.moved[k].torque;
      state_.externalImpulse += 0.5 * h * group.moved[k].force;
      updateVelocities(body);
    }
  }
}

void Stepping::bookHalves(double h) {
  if (!tiesRun()) return;
  for (DrivenGroup& group : memory_.drives->groups) {
    if (!group.halved) continue;
    for (std::size_t k = 0; k < group.bodies.size(); ++k)
      group.moved[k] = state_.bodies[group.bodies[k]];
    report_.certificate.work_of_forces +=
        0.5 * h * (group.power + powerOfForces(group.forces, group.moved));
  }
}

/// Drag takes what neither contacts nor the other forces explain.
void Stepping::applyDragged(int i, double h) {
  RigidBody& body = state_.bodies[i];
  const Drag& drag = memory_.drives->drags[memory_.drives->dragOf[i]];
  const DragStep& step = work_.drags[memory_.drives->dragOf[i]];
  const Vec6 before = work_.before[i];
  const Vec6& after = work_.touched[i] ? work_.after[i] : work_.star[i];
  const Vec6 pushed = after - work_.star[i];
  const Vec3 contact = body.M / step.way.mean * pushed.head<3>();
  const Vec3 gain = body.M * (after - before).head<3>() - contact;
  const Vec3 force = body.force + drag.linear * before.head<3>();
  body.P = body.M * after.head<3>();
  state_.externalImpulse += gain;
  if (!body.particle) body.L = body.R * (body.Ibody * (body.R.transpose() * after.tail<3>()));
  if (work_.touched[i]) {
    const Vec6 mean = 0.5 * (before + after);
    double work = (gain - h * force).dot(mean.head<3>());
    if (!body.particle) {
      const Vec3 turned = body.R * (body.Ibody * (body.R.transpose() * (after - before).tail<3>()));
      const Vec3 torque = body.torque + drag.angular * before.tail<3>();
      work += (turned - step.I * pushed.tail<3>() - h * torque).dot(mean.tail<3>());
    }
    report_.certificate.work_of_forces += work;
  }
  updateVelocities(body);
}

/// Power [W] of wind and point forces on bodies that no driven group moves; of those that grip a
/// body, with the torque by which the step turns it.
double Stepping::steadyPower() const {
  double sum = 0.0;
  const auto counts = [&](int body) {
    return !work_.flown[body] && !isHalved(body) && isActive(body);
  };
  for (const Force& force : memory_.drives->steady) {
    const UniformWind* wind = std::get_if<UniformWind>(&force);
    const int body = wind ? wind->body : std::get<PointForce>(force).body;
    if (counts(body) && !isGripped(body)) sum += powerOfForces(std::span(&force, 1), state_.bodies);
  }
  for (const DrivenGroup& group : memory_.drives->groups) {
    if (!group.steady || !counts(group.bodies.front())) continue;
    const RigidBody& body = state_.bodies[group.bodies.front()];
    sum += (body.force - body.M * model_.def.gravity).dot(body.v) + body.torque.dot(body.omega);
  }
  return sum;
}

}  // namespace tumble
