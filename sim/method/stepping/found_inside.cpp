// Points of what bends that are found inside a solid, by the plans that do not foresee contacts.
#include <algorithm>

#include "sim/body/force.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

/// Calls act(body, out, depth) for every point that moves and is inside: the way out of the other
/// body, and how far [m] it is.
template <class Act>
void forInside(const Model& model, const PairMemory& pair, const Act& act) {
  for (const Touch& touch : pair.touches) {
    const Contact& c = touch.contact;
    const double depth = -c.point.separation;
    if (depth <= 0.0) continue;
    const bool movesA = model.bends(c.a) && !model.fixed(c.a);
    const bool movesB = model.bends(c.b) && !model.fixed(c.b);
    const double share = movesA && movesB ? 0.5 : 1.0;
    if (movesA) act(c.a, c.point.n, share * depth);
    if (movesB) act(c.b, Vec3(-c.point.n), share * depth);
  }
}

}  // namespace

void Stepping::leaveUnmet(const PairMemory& memory) {
  const auto pushed = [&](const ContactPoint& point) {
    return std::any_of(memory.touches.begin(), memory.touches.end(), [&](const Touch& touch) {
      return touch.contact.point.feature == point.feature && !touch.impulse.isZero(0.0);
    });
  };
  const auto last =
      std::remove_if(work_.found.begin(), work_.found.end(), [&](const ContactPoint& point) {
        return point.separation > tolerance_.touch && !pushed(point);
      });
  work_.found.resize(last - work_.found.begin());
}

/// The way out of all that a point is in is Baraff and Witkin's y (Large Steps in Cloth Simulation,
/// 1998, §6), here as the velocity y/h.
void Stepping::findWaysOut(double h) {
  for (BendingPart& part : memory_.bendings->parts)
    part.wayOut.assign(part.bodies.size(), Vec3::Zero());
  for (std::size_t k = 0; k < memory_.pairs.size(); ++k) {
    if (!findsInside(k)) continue;
    forInside(model_, memory_.pairs[k], [&](int body, const Vec3& out, double depth) {
      BendingPart& part = memory_.bendings->partWith(body);
      Vec3& way = part.wayOut[memory_.bendings->pointOf[body]];
      way += std::max(0.0, depth / h - out.dot(way)) * out;
    });
  }
}

/// Places change and no velocity does: what that gives, or takes from, what bends is booked as a
/// repair.
void Stepping::moveOut(double h) {
  if (points_.inStep) {
    for (const BendingPart& part : memory_.bendings->parts)
      for (const int p : part.moving) state_.bodies[part.bodies[p]].x += h * part.wayOut[p];
  } else if (points_.share > 0.0) {
    takeOut();
  }
  bookInside();
}

void Stepping::takeOut() {
  const auto potential = [&] {
    return potentialEnergy(model_.def.gravity, model_.def.forces, state_.bodies);
  };
  deepestOverlap();
  const auto visit = [&](const auto& act) {
    for (std::size_t k = 0; k < memory_.pairs.size(); ++k)
      if (findsInside(k)) forInside(model_, memory_.pairs[k], act);
  };
  bool any = false;
  visit([&](int, const Vec3&, double) { any = true; });
  if (!any) return;
  const double before = potential();
  visit([&](int body, const Vec3& out, double depth) {
    state_.bodies[body].x += points_.share * depth * out;
  });
  report_.certificate.energy_added_repair += potential() - before;
}

/// How deep points are now.
void Stepping::bookInside() {
  deepestOverlap();
  double& deepest = report_.certificate.max_penetration;
  for (std::size_t k = 0; k < memory_.pairs.size(); ++k)
    if (findsInside(k))
      for (const Touch& touch : memory_.pairs[k].touches)
        deepest = std::max(deepest, -touch.contact.point.separation);
}

}  // namespace tumble
