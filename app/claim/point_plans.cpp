// The four plans for points of what bends that come into a solid, and how the slides rank them:
// gradual correction is bad, displacements are worse, those within the implicit step the solution.
#include "sim/method/stepping/point_plan.h"

#include <algorithm>
#include <cmath>

#include "app/claim/rows.h"
#include "sim/elastic/strain.h"

namespace tumble {

namespace {

// What a plan shows at the ends of steps.
struct Shown {
  double stretch = 0.0;  // [1] the largest strain
  double spike = 0.0;    // [J] the largest gain of energy in a step
  double sunk = 0.0;     // [m] the deepest point below a skin
  bool whole = true;     // the run came to its end
};

double largestStrain(const WorldDef& world, const Sample& sample) {
  double largest = 0.0;
  std::vector<Vec3> places;
  for (const Force& force : world.forces)
    if (const Bending* bending = std::get_if<Bending>(&force)) {
      places.clear();
      for (const int i : bending->body->bodies) places.push_back(sample.bodies[i].x);
      for (const double strain : strainsOf(*bending->body, places))
        largest = std::max(largest, strain);
    }
  return largest;
}

Shown shownBy(const PointPlan& plan, const Scene& scene) {
  Scene variant = scene;
  variant.world.method = "stepping";
  variant.world.stepping.points = plan.name;
  World world = makeWorld(variant);
  const double h = variant.world.stepping.step;
  const long steps = std::lround(variant.world.duration / h);
  Shown shown;
  double before = 0.0;
  for (long k = 0; k <= steps; ++k) {
    const double t = std::min(static_cast<double>(k) * h, variant.world.duration);
    world.advance(t);
    if (world.report().stopped) return {.whole = false};
    const Sample sample = world.sample(t);
    const double energy = sample.kinetic + sample.potential;
    if (k > 0) shown.spike = std::max(shown.spike, energy - before);
    before = energy;
    shown.stretch = std::max(shown.stretch, largestStrain(variant.world, sample));
  }
  shown.sunk = world.report().certificate.max_penetration;
  return shown;
}

ClaimRow atLeast(const std::string& label, double worse, double better) {
  return {.label = label,
          .measured = worse,
          .exact = better,
          .error = std::max(0.0, better - worse),
          .allowed = 0.0,
          .relation = Relation::AtLeast};
}

}  // namespace

std::vector<ClaimRow> pointPlanRows(const Scene& scene, const Recording&) {
  const bool bends =
      std::any_of(scene.world.forces.begin(), scene.world.forces.end(),
                  [](const Force& force) { return std::holds_alternative<Bending>(force); });
  constexpr double kSkin = 1e-9;  // [m] below a skin; measured 4e-14 by constraint
  if (!bends) return {emptyClaim("nothing bends")};
  const auto by = [&](const char* name) { return shownBy(*findPointPlan(name), scene); };
  const Shown gradual = by("gradual"), displace = by("displace"), implicit = by("implicit"),
              constraint = by("constraint");
  for (const Shown* each : {&gradual, &displace, &implicit, &constraint})
    if (!each->whole) return {emptyClaim("a run stopped before its end")};
  if (!(implicit.sunk > kSkin)) return {emptyClaim("no point comes into a solid")};
  return {atLeast("largest strain: gradual to implicit", gradual.stretch, implicit.stretch),
          atLeast("largest strain: displace to gradual", displace.stretch, gradual.stretch),
          atLeast("most energy that a step adds / J: displace to gradual", displace.spike,
                  gradual.spike),
          atLeast("the same: gradual to implicit", gradual.spike, implicit.spike),
          atLeast("the same: implicit to constraint", implicit.spike, constraint.spike),
          {"deepest point below the skin by constraint / m", constraint.sunk, 0.0, constraint.sunk,
           kSkin}};
}

}  // namespace tumble
