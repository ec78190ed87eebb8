#include "app/report/halving.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>

#include "app/record/bodies.h"
#include "app/report/bounded.h"
#include "app/report/nudge.h"
#include "app/report/swarm.h"

namespace tumble {

namespace {

constexpr int kLevels = 4;       // h, h/2, h/4, h/8
constexpr double kQuick = 5e-3;  // [s] CPU of a run that is worth timing again
constexpr int kTimings = 3;      // of such a run

// The scene's setting of the step that a method takes, if it takes one.
double* stepOf(WorldDef& world) {
  if (world.method == "course") return &world.course.step;
  if (world.method == "stepping") return &world.stepping.step;
  return nullptr;
}

// Numbers as bytes, and back.
template <class Value>
void put(const Value& value, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class Value>
Value take(std::string_view& bytes) {
  Value value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

// A body's place and attitude; velocities stay behind.
using Placed = std::array<double, 7>;

constexpr char kInstant = 'i', kStopped = 's';  // what begins a message

// Lets the world run and sends time and bodies at each instant, or why it stopped.
void runAndSend(World& world, const std::vector<double>& instants, const Send& send) {
  // Of the thread: the process's own clock goes in ticks where its time is bounded.
  const double start = cpuTime();
  for (const double t : instants) {
    world.advance(t);
    if (world.report().stopped) return send(kStopped + ("stopped: " + world.report().reason));
    std::string bytes(1, kInstant);
    const Sample sample = world.sample(t);
    put(cpuTime() - start, bytes);
    for (const BodySample& body : sample.bodies)
      put(Placed{body.x.x(), body.x.y(), body.x.z(), body.q.w(), body.q.x(), body.q.y(),
                 body.q.z()},
          bytes);
    send(bytes);
  }
}

HalvedRun runOnce(const Scene& scene, const HalvingPlan& plan) {
  World world = makeWorld(scene);
  const Bounded bounded =
      runBounded(plan.budget, [&](const Send& send) { runAndSend(world, plan.instants, send); });
  HalvedRun run;
  std::string_view bytes = bounded.sent;
  const std::size_t count = scene.world.bodies.size();
  while (bytes.starts_with(kInstant) && bytes.size() > sizeof(double) + count * sizeof(Placed)) {
    bytes.remove_prefix(1);
    run.seconds.push_back(take<double>(bytes));
    std::vector<BodySample>& bodies = run.bodies.emplace_back();
    for (std::size_t i = 0; i < count; ++i) {
      const Placed p = take<Placed>(bytes);
      bodies.push_back({.x = {p[0], p[1], p[2]}, .q = {p[3], p[4], p[5], p[6]}});
    }
  }
  if (bytes.starts_with(kStopped)) run.ended = bytes.substr(1);
  if (bounded.outOfTime)
    run.ended = fmt::format("ended after {:.0f} CPU s", std::ceil(plan.budget));
  if (!bounded.outOfTime && !bounded.whole) run.ended = "the program failed";
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
