#include "app/report/halving.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/report/cost.h"
#include "app/report/nudge.h"

namespace tumble {

namespace {

constexpr int kLevels = 4;           // h, h/2, h/4, h/8
constexpr double kSlice = 1.0 / 60;  // [s] of motion between two looks at the clock
constexpr double kQuick = 5e-3;      // [s] CPU of a run that is worth timing again
constexpr int kTimings = 3;          // of such a run

// The scene's setting of the step that a method takes, if it takes one.
double* stepOf(WorldDef& world) {
  if (world.method == "course") return &world.course.step;
  if (world.method == "stepping") return &world.stepping.step;
  return nullptr;
}

// Goes on to an instant; false if the run has ended before.
bool reach(World& world, double from, double to, double budgetEnd, HalvedRun& run) {
  const int slices = std::max(1, static_cast<int>(std::ceil((to - from) / kSlice)));
  for (int k = 1; k <= slices; ++k) {
    const double t = k == slices ? to : from + (to - from) * k / slices;
    world.advance(t);
    if (world.report().stopped) {
      run.ended = "stopped: " + world.report().reason;
      return false;
    }
    if (processSeconds() > budgetEnd) {
      run.ended = fmt::format("left at t = {:.4g} s, beyond its CPU time", t);
      return false;
    }
  }
  return true;
}

HalvedRun runOnce(const Scene& scene, const HalvingPlan& plan) {
  HalvedRun run;
  const double start = processSeconds();
  World world = makeWorld(scene);
  double from = 0.0;
  for (const double t : plan.instants) {
    if (!reach(world, from, t, start + plan.budget, run)) return run;
    run.bodies.push_back(world.sample(t).bodies);
    run.seconds.push_back(processSeconds() - start);
    from = t;
  }
  return run;
}

// Noise only adds to CPU times: of short runs the least of a few.
HalvedRun runTimed(const Scene& scene, const HalvingPlan& plan) {
  HalvedRun run = runOnce(scene, plan);
  for (int n = 1; n < kTimings && !run.seconds.empty() && run.seconds.back() < kQuick; ++n) {
    const HalvedRun again = runOnce(scene, plan);
    for (std::size_t k = 0; k < run.seconds.size(); ++k)
      run.seconds[k] = std::min(run.seconds[k], again.seconds[k]);
  }
  return run;
}

MethodRuns runMethod(Scene scene, const std::string& method, const HalvingPlan& plan) {
  MethodRuns all{method, "", {}, {}};
  scene.world.method = method;
  try {
    makeWorld(scene);
  } catch (const SceneError& error) {
    all.refusal = error.diagnostics().front().message;
    return all;
  }
  Scene moved = scene;
  Random random(scene.seed, "a unit in the last place");
  nudge(moved.world, random);

  double* const step = stepOf(scene.world);
  double likely = 0.0;  // [s] CPU of the next run
  for (int level = 0; level < (step ? kLevels : 1); ++level) {
    HalvedRun run;
    if (likely > plan.budget)
      run.ended = fmt::format("not begun, likely {:.2g} CPU s", likely);
    else
      run = runTimed(scene, plan);
    run.step = step ? *step : 0.0;
    const bool whole = run.bodies.size() == plan.instants.size();
    likely = whole ? 2.0 * run.seconds.back() : 2.0 * std::max(likely, plan.budget);
    all.runs.push_back(std::move(run));
    if (step) *step *= 0.5;
  }
  try {
    all.twin = runOnce(moved, plan);
  } catch (const SceneError&) {  // beyond what it takes, by that unit: then there is none
  }
  return all;
}

}  // namespace

std::vector<double> quarters(double T) {
  return {0.25 * T, 0.5 * T, 0.75 * T, T};
}

std::vector<MethodRuns> runHalved(const Scene& scene, const HalvingPlan& plan,
                                  const std::function<void()>& done) {
  std::vector<MethodRuns> all;
  for (const MethodName& method : methodNames()) {
    if (method.name == "auto") continue;
    all.push_back(runMethod(scene, std::string(method.name), plan));
    if (done) done();
  }
  return all;
}

std::vector<double> movingRadii(const Scene& scene) {
  const World world = makeWorld(scene);
  std::vector<double> radii;
  for (std::size_t i = 0; i < scene.world.bodies.size(); ++i)
    radii.push_back(moves(scene.world.bodies[i]) ? boundingRadius(world.model().shapes[i]) : -1.0);
  return radii;
}

double apart(const std::vector<double>& radii, const std::vector<BodySample>& one,
             const std::vector<BodySample>& other) {
  double most = 0.0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (radii[i] < 0.0) continue;
    const double turned = 2.0 * (one[i].q.conjugate() * other[i].q).vec().norm();
    most = std::max(most, (one[i].x - other[i].x).norm() + radii[i] * turned);
  }
  return most;
}

}  // namespace tumble
