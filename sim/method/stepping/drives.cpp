#include "sim/method/stepping/drives.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/body/principal_axes.h"
#include "sim/contact/rows.h"
#include "sim/math/rotation.h"
#include "sim/problem/problem.h"

namespace tumble {
namespace {

/// Calls act(i) for the one body of a force, or for each, fixed ones left out.
template <class Action>
void forEachMoving(const Model& model, int body, Action act) {
  for (int i = 0; i < model.count(); ++i)
    if ((body == kNoBody || body == i) && !model.fixed(i)) act(i);
}

/// Whether a force changes on the way of a body that nothing touches.
bool changes(const Force& force) {
  if (const PointForce* grip = std::get_if<PointForce>(&force)) return !grip->point_B.isZero(0.0);
  return std::holds_alternative<Spring>(force) || std::holds_alternative<CircularField>(force);
}

/// Joins to groups what springs join, and @return per body its root, or −1 where nothing drives it.
std::vector<int> rootsOf(const Model& model) {
  std::vector<int> root(model.count());
  std::iota(root.begin(), root.end(), 0);
  std::vector<char> driven(model.count(), 0), joined(model.count() + 1, 0);
  for (const Joint& joint : model.joints) joined[joint.a] = joined[joint.b] = 1;
  const auto drive = [&](int body) { driven[body] = 1; };
  for (const Force& force : model.def.forces) {
    if (const LinearDrag* drag = std::get_if<LinearDrag>(&force))
      forEachMoving(model, drag->body, [&](int i) {
        if (joined[i]) drive(i);
      });
    if (!changes(force)) continue;
    if (const Spring* spring = std::get_if<Spring>(&force)) {
      const bool free = spring->b != kNoBody && !model.fixed(spring->b);
      if (!model.fixed(spring->a)) drive(spring->a);
      if (free) drive(spring->b);
      if (!free || model.fixed(spring->a)) continue;
      const int a = islandRoot(root, spring->a), b = islandRoot(root, spring->b);
      root[std::max(a, b)] = std::min(a, b);
    } else if (const PointForce* grip = std::get_if<PointForce>(&force)) {
      forEachMoving(model, grip->body, drive);
    } else {
      forEachMoving(model, std::get<CircularField>(force).body, drive);
    }
  }
  for (int i = 0; i < model.count(); ++i) root[i] = driven[i] ? islandRoot(root, i) : -1;
  return root;
}

/// Finds what joints make one of groups.
void findChains(const Model& model, Drives& drives) {
  std::vector<int> root(model.count());
  std::iota(root.begin(), root.end(), 0);
  const auto moves = [&](int i) { return i < model.count() && !model.fixed(i); };
  const auto join = [&](int a, int b) {
    const int p = islandRoot(root, a), q = islandRoot(root, b);
    root[std::max(p, q)] = std::min(p, q);
  };
  for (const DrivenGroup& group : drives.groups)
    for (const int i : group.bodies)
      if (moves(i)) join(group.bodies.front(), i);
  for (const Joint& joint : model.joints)
    if (moves(joint.a) && moves(joint.b)) join(joint.a, joint.b);
  drives.chainOf.assign(model.count(), -1);
  const auto chainWith = [&](int body) {
    int& chain = drives.chainOf[islandRoot(root, body)];
    if (chain < 0) {
      chain = static_cast<int>(drives.chains.size());
      drives.chains.emplace_back();
    }
    return chain;
  };
  for (DrivenGroup& group : drives.groups) group.chain = chainWith(group.bodies.front());
  for (const Joint& joint : model.joints) {
    const bool limited = std::isfinite(joint.lo) || std::isfinite(joint.hi);
    for (const int i : {joint.a, joint.b})
      if (moves(i)) drives.chains[chainWith(i)].limited |= limited;
  }
  for (int i = 0; i < model.count(); ++i) drives.chainOf[i] = drives.chainOf[islandRoot(root, i)];
}

/// Adds a force to a group, for those of its bodies on which it acts.
class Share {
 public:
  Share(const Model& model, DrivenGroup& group) : model_(model), group_(group) {}

  void operator()(const Spring& spring) {
    const bool ofA = spring.a != kNoBody && has(spring.a) && !model_.fixed(spring.a);
    const bool ofB = spring.b != kNoBody && has(spring.b) && !model_.fixed(spring.b);
    if (!ofA && !ofB) return;
    group_.springs.push_back(spring);
    group_.stores.push_back(spring);
    Spring own = spring;
    own.a = place(spring.a);
    if (spring.b != kNoBody) own.b = place(spring.b);
    group_.forces.push_back(own);
  }
  void operator()(const PointForce& force) {
    if (!has(force.body) || model_.fixed(force.body)) return;
    PointForce own = force;
    own.body = place(force.body);
    group_.forces.push_back(own);
  }
  void operator()(const Bending&) {}  // moves no group: see bending.cpp
  void operator()(const Layering&) {}
  template <class Other>
  void operator()(const Other& force) {
    forEachMoving(model_, force.body, [&](int i) {
      if (!has(i)) return;
      Other own = force;
      own.body = place(i);
      group_.forces.push_back(own);
    });
  }

 private:
  bool has(int body) const {
    return std::find(group_.bodies.begin(), group_.bodies.end(), body) != group_.bodies.end();
  }
  int place(int body) {
    if (!has(body)) group_.bodies.push_back(body);  // a fixed one
    return static_cast<int>(std::find(group_.bodies.begin(), group_.bodies.end(), body) -
                            group_.bodies.begin());
  }

  const Model& model_;
  DrivenGroup& group_;
};

void prepare(const Model& model, std::span<const RigidBody> bodies, DrivenGroup& group) {
  constexpr double kTolerance = 1e-13;
  for (const Force& force : model.def.forces) std::visit(Share(model, group), force);
  for (const Force& force : group.forces)
    if (!std::holds_alternative<Spring>(force)) group.others.push_back(force);
  group.steady = std::all_of(group.forces.begin(), group.forces.end(), [](const Force& force) {
    return std::holds_alternative<UniformWind>(force) || std::holds_alternative<PointForce>(force);
  });
  group.plain = !group.springs.empty() &&
                std::all_of(group.others.begin(), group.others.end(), [](const Force& force) {
                  return std::holds_alternative<UniformWind>(force) ||
                         std::holds_alternative<LinearDrag>(force);
                });
  for (const int i : group.bodies) group.moved.push_back(bodies[i]);
  group.system = std::make_shared<DrivenSystem>(model.def.gravity, group.forces, group.moved);
  group.stepper = findIntegrator("dopri5")->make(group.system->size(), {.tolerance = kTolerance});
  group.y.resize(group.system->size());
}

}  // namespace

DrivenSystem::DrivenSystem(const Vec3& gravity, const std::vector<Force>& forces,
                           std::span<const RigidBody> bodies)
    : bodies_(gravity, forces, {bodies.begin(), bodies.end()}),
      forces_(forces),
      work_(bodies.begin(), bodies.end()) {}

void DrivenSystem::derivative(double /*t*/, std::span<const double> y,
                              std::span<double> ydot) const {
  bodies_.fromArray(y.first(y.size() - kLedger), work_);
  bodies_.sumForces(work_);
  bodies_.rates(work_, ydot.first(ydot.size() - kLedger));
  Vec3 sum = Vec3::Zero();
  for (const RigidBody& body : work_) sum += body.force;
  double* ledger = &ydot[ydot.size() - kLedger];
  ledger[0] = powerOfForces(forces_, work_);
  for (int k = 0; k < 3; ++k) ledger[1 + k] = sum[k];
}

void DrivenSystem::normalise(std::span<double> y) const {
  bodies_.normalise(y.first(y.size() - kLedger));
}

void DrivenSystem::pack(std::span<const RigidBody> bodies, std::span<double> y) {
  work_.assign(bodies.begin(), bodies.end());
  bodies_.toArray(bodies, y.first(y.size() - kLedger));
  std::fill(y.end() - kLedger, y.end(), 0.0);
}

void DrivenSystem::unpack(std::span<const double> y, std::span<RigidBody> bodies) const {
  bodies_.fromArray(y.first(y.size() - kLedger), bodies);
}

Drives drivesOf(const Model& model, std::span<const RigidBody> bodies) {
  Drives drives;
  const std::vector<int> root = rootsOf(model);
  drives.groupOf.assign(model.count(), -1);
  drives.dragOf.assign(model.count(), -1);
  for (int i = 0; i < model.count(); ++i) {
    if (root[i] < 0) continue;
    if (root[i] == i) drives.groups.emplace_back();
    drives.groupOf[i] =
        root[i] == i ? static_cast<int>(drives.groups.size()) - 1 : drives.groupOf[root[i]];
    drives.groups[drives.groupOf[i]].bodies.push_back(i);
  }
  for (DrivenGroup& group : drives.groups) prepare(model, bodies, group);
  findChains(model, drives);
  for (const Force& force : model.def.forces) {
    if (!std::holds_alternative<Bending>(force) && !std::holds_alternative<Layering>(force))
      drives.outer.push_back(force);
    if (const LinearDrag* drag = std::get_if<LinearDrag>(&force)) {
      forEachMoving(model, drag->body, [&](int i) {
        int& number = drives.dragOf[i];
        if (number < 0) {
          number = static_cast<int>(drives.drags.size());
          const PrincipalAxes principal = principalAxes(bodies[i].IbodyInv);
          drives.drags.push_back({.body = i, .axes = principal.axes, .inverse = principal.moments});
        }
        drives.drags[number].linear += drag->linear;
        drives.drags[number].angular += drag->angular;
      });
    } else if (const UniformWind* wind = std::get_if<UniformWind>(&force)) {
      forEachMoving(model, wind->body, [&](int i) {
        drives.steady.push_back(UniformWind{.body = i, .force = wind->force});
      });
    } else if (const PointForce* grip = std::get_if<PointForce>(&force)) {
      if (!model.fixed(grip->body)) drives.steady.push_back(*grip);
    }
  }
  return drives;
}

DragStep dragStep(const Drag& drag, const RigidBody& body, double h) {
  DragStep step{.way = decay(h * drag.linear * body.invM)};
  if (body.particle) return step;
  const Mat3 axes = body.R * drag.axes;
  Vec3 left, half, inverse;
  for (int k = 0; k < 3; ++k) {
    const double rate = h * drag.angular * drag.inverse[k];
    const Decay turn = decay(rate);
    left[k] = turn.left;
    half[k] = decay(0.5 * rate).left;
    inverse[k] = turn.mean * drag.inverse[k];
  }
  const auto about = [&](const Vec3& moments) {
    return Mat3(axes * moments.asDiagonal() * axes.transpose());
  };
  step.left = about(left);
  step.halfLeft = about(half);
  step.Iinv = about(inverse);
  step.I = about(inverse.cwiseInverse());
  return step;
}

double fastestDrive(const DrivenGroup& group, std::span<const Drag> drags,
                    const std::vector<int>& dragOf, std::span<const RigidBody> bodies) {
  double fastest = 0.0;
  const auto reach = [&](int i, const Vec3& anchor_B) {
    const RigidBody& body = bodies[i];
    if (body.fixed()) return 0.0;
    const Mat3 lever = skew(anchor_B);
    return body.invM + (body.particle ? 0.0 : (lever.transpose() * body.IbodyInv * lever).norm());
  };
  for (const Spring& spring : group.springs) {
    double mobility = reach(spring.a, spring.anchorA_B);
    if (spring.b != kNoBody) mobility += reach(spring.b, spring.anchorB_B);
    fastest =
        std::max({fastest, std::sqrt(spring.stiffness * mobility), spring.damping * mobility});
  }
  for (const int i : group.bodies) {
    if (dragOf[i] < 0) continue;
    const Drag& drag = drags[dragOf[i]];
    fastest =
        std::max({fastest, drag.linear * bodies[i].invM, drag.angular * drag.inverse.maxCoeff()});
  }
  return fastest;
}

}  // namespace tumble
