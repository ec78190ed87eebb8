// Which bodies are near, and where they touch: the front half of every method's step.
#include <algorithm>

#include "sim/collide/collide.h"
#include "sim/method/method.h"

namespace tumble {
namespace {

/// Planes of pairs that are near no longer are forgotten. Both lists are sorted.
void passWitnesses(std::span<const std::pair<int, int>> near, State& state) {
  std::vector<PairWitness> passed(near.size());
  std::size_t old = 0;
  for (std::size_t k = 0; k < near.size(); ++k) {
    while (old < state.witnesses.size() && state.near[old] < near[k]) ++old;
    if (old < state.witnesses.size() && state.near[old] == near[k])
      passed[k] = std::move(state.witnesses[old]);
  }
  state.witnesses.swap(passed);
}

void addContacts(const Model& model, std::pair<int, int> pair, const Manifold& points,
                 std::vector<Contact>& contacts) {
  if (points.empty()) return;
  const auto [b, a] = pair;
  const Surface surface = model.surface(a, b);
  const double scale = std::min(1.0, ContactTolerance::scaleOf(model.size));
  for (const ContactPoint& point : points) {
    Contact& c = contacts.emplace_back();
    c.a = a;
    c.b = b;
    c.point = point;
    c.restitution = surface.restitution;
    c.scale = scale;
    c.friction = surface.friction;
  }
}

}  // namespace

std::vector<std::pair<int, int>> nearPairs(const Model& model, State& state,
                                           std::span<const Aabb> boxes) {
  state.broadPhase.update(boxes, model.solidBends);
  std::vector<std::pair<int, int>> near;
  for (const auto& [i, j] : state.broadPhase.pairs()) {
    const int b = model.solid[i], a = model.solid[j];
    if (model.mayTouch(a, b)) near.emplace_back(b, a);
  }
  passWitnesses(near, state);
  return near;
}

bool stopAtUnknownPair(const Model& model, std::span<const std::pair<int, int>> near,
                       Report& report) {
  for (const auto& [b, a] : near) {
    if (canCollide(model.shapes[a], model.shapes[b])) continue;
    report.stopped = true;
    report.reason = "\"" + model.def.bodies[a].name + "\" comes near \"" +
                    model.def.bodies[b].name + "\", and there is no contact rule for " +
                    std::string(shapeName(model.shapes[a])) + " and " +
                    std::string(shapeName(model.shapes[b])) + "; keep them apart";
    return true;
  }
  return false;
}

Aabb sweptBox(const Model& model, int i, const RigidBody& body, const Vec3& v, const Vec3& omega,
              double h, double margin) {
  const double radius = model.radius[i];
  const double turn = std::isfinite(radius) ? omega.norm() * radius * h : 0.0;
  Aabb box = boundingBox(model.shapes[i], body.pose(), margin + turn);
  const Vec3 way = h * v;
  box.lo += way.cwiseMin(0.0);
  box.hi += way.cwiseMax(0.0);
  return box;
}

void sweptBoxes(const Model& model, std::span<const RigidBody> bodies, double h,
                double acceleration, double margin, std::vector<Aabb>& boxes) {
  boxes.clear();
  for (const int i : model.solid) {
    const RigidBody& body = bodies[i];
    const double fall = body.fixed() ? 0.0 : acceleration * h * h;
    boxes.push_back(sweptBox(model, i, body, body.v, body.omega, h, margin + fall));
  }
}

void findContacts(const Model& model, std::span<const RigidBody> bodies, std::pair<int, int> pair,
                  double margin, std::vector<Contact>& contacts) {
  const auto [b, a] = pair;
  thread_local Manifold manifold;  // keeps its storage from call to call
  collide(model.shapes[a], bodies[a].pose(), model.shapes[b], bodies[b].pose(), margin, manifold);
  addContacts(model, pair, manifold, contacts);
}

bool planeShowsApart(const Model& model, const State& state, std::span<const RigidBody> bodies,
                     std::size_t k, double margin, Report& report) {
  if (!model.def.rememberPlanes) return false;
  const auto [b, a] = state.near[k];
  ++report.certificate.plane_tests;
  const Witness& witness = state.witnesses[k].whole;
  const bool apart = showsApart(witness, model.shapes[a], bodies[a].pose(), model.radius[a],
                                model.shapes[b], bodies[b].pose(), model.radius[b], margin);
  if (apart) ++report.certificate.plane_hits;
  return apart;
}

void findNearPoints(const Model& model, State& state, std::size_t k, double margin,
                    Manifold& points, Report& report) {
  points.clear();
  if (planeShowsApart(model, state, state.bodies, k, margin, report)) return;
  const auto [b, a] = state.near[k];
  const Pose poseA = state.bodies[a].pose(), poseB = state.bodies[b].pose();
  if (!model.def.rememberPlanes)
    return collide(model.shapes[a], poseA, model.shapes[b], poseB, margin, points);
  PairWitness& known = state.witnesses[k];
  PartLooks looks;
  collide(model.shapes[a], poseA, model.shapes[b], poseB, margin, points, known.parts, looks);
  report.certificate.plane_tests += looks.tests;
  report.certificate.plane_hits += looks.hits;
  // Where parts are near, one of the bodies may reach around the other.
  if (!points.empty() || known.parts.empty())
    known.whole =
        witnessOf(points.empty() ? separatingPlane(model.shapes[a], poseA, model.shapes[b], poseB)
                                 : points.front(),
                  poseA, poseB);
}

void findNearContacts(const Model& model, State& state, std::size_t k, double margin,
                      std::vector<Contact>& contacts, Report& report) {
  thread_local Manifold manifold;  // keeps its storage from call to call
  findNearPoints(model, state, k, margin, manifold, report);
  addContacts(model, state.near[k], manifold, contacts);
}

}  // namespace tumble
