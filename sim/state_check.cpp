#include "sim/state_check.h"

#include <algorithm>

#include "sim/collide/broad_phase.h"
#include "sim/collide/collide.h"
#include "sim/contact/rest.h"
#include "sim/joint/joint_bonds.h"
#include "sim/method/course/contact_model.h"
#include "sim/method/method.h"

namespace tumble {
namespace {

/// The worst contact of each pair, of those that `amountOf` gives less than −tolerance.
template <class Amount>
std::vector<StateFault> worstOfPairs(StateLayer layer, double tolerance,
                                     std::span<const Contact> contacts, Amount amountOf) {
  std::vector<StateFault> faults;
  for (const Contact& c : contacts) {
    const double amount = amountOf(c);
    if (!(amount < -tolerance)) continue;
    const auto known = std::find_if(faults.begin(), faults.end(),
                                    [&](const StateFault& f) { return f.a == c.a && f.b == c.b; });
    const StateFault fault{layer, c.a, c.b, c.point.p, c.point.n, amount};
    if (known == faults.end())
      faults.push_back(fault);
    else if (amount < known->amount)
      *known = fault;
  }
  return faults;
}

bool rests(const Model& model, std::span<const RigidBody> bodies, const Contact& c) {
  const double band = ContactTolerance::forSize(model.size).rest;
  return classify(approachVelocity(bodies[c.a], bodies[c.b], c.point), band) ==
         ContactClass::Resting;
}

/// Forces by the LCP of the notes, without the pull that a method adds against rounding.
void addConstraintForces(const Model& model, std::span<RigidBody> bodies,
                         std::vector<Contact>& contacts) {
  constexpr double kNoPull = 1e9;  // [s]
  const ContactTolerance tolerance = ContactTolerance::forSize(model.size);
  std::vector<Contact> resting;
  std::vector<std::size_t> index;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (!rests(model, bodies, contacts[i])) continue;
    Contact& c = resting.emplace_back(contacts[i]);
    index.push_back(i);
    c.lasting = true;
    c.anchor = anchorOf(bodies[c.a], bodies[c.b], c.point);
    const Vec3 slip = slipVelocity(bodies[c.a], bodies[c.b], c.point);
    c.sliding = c.friction > 0.0 && slip.norm() > tolerance.stick;
    if (c.sliding) c.slipDirection = slip.normalized();
  }
  // Each round of a problem with friction goes on from the last one.
  constexpr int kRounds = 200;
  RestForces forces;
  const std::vector<RigidBody> outer(bodies.begin(), bodies.end());
  Bonds bonds;
  restBonds(
      bodies, model.joints,
      restingLimits(bodies, model.joints, tolerance.touch, tolerance.rest, tolerance.rest, {}),
      kNoPull, bonds);
  for (int round = 0; round < kRounds; ++round) {
    std::copy(outer.begin(), outer.end(), bodies.begin());
    if (forces.apply(bodies, resting, &bonds).status == SolveStatus::Solved) break;
  }
  for (std::size_t k = 0; k < resting.size(); ++k) contacts[index[k]].force = resting[k].force;
}

}  // namespace

const char* layerName(StateLayer layer) {
  if (layer == StateLayer::Positions) return "positions";
  return layer == StateLayer::Velocities ? "velocities" : "accelerations";
}

std::vector<Contact> touchingContacts(const Model& model, std::span<const RigidBody> bodies) {
  const double touch = ContactTolerance::forSize(model.size).touch;
  std::vector<Aabb> boxes;
  for (const int i : model.solid)
    boxes.push_back(boundingBox(model.shapes[i], bodies[i].pose(), touch));
  BroadPhase near;
  near.update(boxes);
  std::vector<Contact> contacts;
  for (const auto& [i, j] : near.pairs()) {
    const int b = model.solid[i], a = model.solid[j];
    if (!model.mayTouch(a, b)) continue;
    if (!canCollide(model.shapes[a], model.shapes[b])) continue;
    findContacts(model, bodies, {b, a}, touch, contacts);
  }
  return contacts;
}

std::vector<StateFault> overlapping(const Model& model, std::span<const Contact> contacts) {
  return worstOfPairs(StateLayer::Positions, ContactTolerance::forSize(model.size).touch, contacts,
                      [](const Contact& c) { return c.point.separation; });
}

std::vector<StateFault> approaching(const Model& model, std::span<const RigidBody> bodies,
                                    std::span<const Contact> contacts) {
  return worstOfPairs(
      StateLayer::Velocities, ContactTolerance::forSize(model.size).rest, contacts,
      [&](const Contact& c) { return approachVelocity(bodies[c.a], bodies[c.b], c.point); });
}

std::vector<StateFault> sinking(const Model& model, std::span<const RigidBody> bodies,
                                std::span<const Contact> contacts) {
  constexpr double kRounding = 1e-9;  // of the largest acceleration
  double scale = model.def.gravity.norm();
  for (const RigidBody& body : bodies) scale = std::max(scale, body.invM * body.force.norm());
  constexpr double kCalm = 1e-3;  // [m/s²]
  return worstOfPairs(StateLayer::Accelerations, kRounding * std::max(scale, kCalm), contacts,
                      [&](const Contact& c) {
                        if (!rests(model, bodies, c)) return 0.0;
                        return normalAcceleration(bodies[c.a], bodies[c.b], c.point);
                      });
}

void addContactForces(const Model& model, std::span<RigidBody> bodies,
                      std::vector<Contact>& contacts) {
  const ContactModel* springs = findContactModel(model.def.course.contact);
  if (model.runs != "course" || springs->impulses)
    return addConstraintForces(model, bodies, contacts);
  const std::unique_ptr<ContactForces> forces = springs->make(model);
  forces->apply(bodies);
  for (Contact& c : contacts)
    for (const Contact& pushed : forces->contacts())
      if (pushed.a == c.a && pushed.b == c.b && pushed.point.p == c.point.p) c.force = pushed.force;
}

}  // namespace tumble
