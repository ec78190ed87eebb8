#include "sim/neighbours.h"

#include <algorithm>
#include <string>
#include <vector>

#include "sim/collide/broad_phase.h"
#include "sim/collide/collide.h"
#include "sim/contact/contact.h"

namespace tumble {
namespace {

std::string bodyPath(int body, const char* field) {
  return "bodies[" + std::to_string(body) + "]" + field;
}

/// The first body of each kind among those that can touch; two bodies are of one kind if every
/// other body meets them alike. With them, all pairs of kinds take O(n · kinds).
template <class SameKind>
std::vector<int> kindsOf(const Model& model, SameKind same) {
  std::vector<int> kinds;
  for (const int i : model.solid)
    if (std::none_of(kinds.begin(), kinds.end(), [&](int kind) { return same(kind, i); }))
      kinds.push_back(i);
  return kinds;
}

/// Refuses bodies that could meet without a contact rule.
void checkRule(const Model& model, int a, int b) {
  const Shape &shapeA = model.shapes[a], &shapeB = model.shapes[b];
  if (canCollide(shapeA, shapeB)) return;
  const bool plane = std::holds_alternative<HalfSpace>(shapeB);
  throw Refusal(bodyPath(a, ".shape"),
                "\"" + model.def.bodies[a].name + "\" (" + std::string(shapeName(shapeA)) +
                    ") could meet \"" + model.def.bodies[b].name + "\" (" +
                    std::string(shapeName(shapeB)) +
                    "), and there is no contact rule for these two shapes; leave one of them out" +
                    (plane ? "" : " or move them apart"));
}

/// Refuses bodies that overlap.
void checkOverlaps(const Model& model, std::span<const RigidBody> bodies) {
  const double touch = ContactTolerance::forSize(model.size).touch;
  std::vector<Aabb> boxes;
  for (const int i : model.solid)
    boxes.push_back(boundingBox(model.shapes[i], bodies[i].pose(), touch));
  BroadPhase near;
  near.update(boxes);
  for (const auto& [i, j] : near.pairs()) {
    const int b = model.solid[i], a = model.solid[j];
    if (!model.mayTouch(a, b)) continue;
    checkRule(model, a, b);
    const double gap =
        separation(model.shapes[a], bodies[a].pose(), model.shapes[b], bodies[b].pose());
    if (gap >= -touch) continue;
    throw Refusal(bodyPath(a, ".position"),
                  "\"" + model.def.bodies[a].name + "\" overlaps \"" + model.def.bodies[b].name +
                      "\" by " + shortNumber(-gap) + " m at the start; move them apart");
  }
}

}  // namespace

void checkNeighbours(const Model& model, std::span<const RigidBody> bodies) {
  checkOverlaps(model, bodies);
}

bool anyFriction(const Model& model) {
  const std::vector<int> surfaces = kindsOf(model, [&](int a, int b) {
    const BodyDef &p = model.def.bodies[a], &q = model.def.bodies[b];
    return p.material == q.material && p.friction == q.friction;
  });
  for (const int a : model.solid)
    for (const int b : surfaces)
      if (b < a && model.surface(a, b).friction > 0.0) return true;
  return false;
}

}  // namespace tumble
