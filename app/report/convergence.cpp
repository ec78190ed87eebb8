#include "app/report/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tumble {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kAbove = 10.0;      // times the noise: a difference that means something
constexpr double kLeastOrder = 0.5;  // below, differences do not shrink
constexpr double kChaos = 1e-8;      // of the size: rounding that has grown 1e8 times
constexpr double kApart = 1e-9;      // of the size: what tolerances of instants may leave
constexpr double kFar = 10.0;        // times the errors: a limit that is another one

// How far [m] the farthest point is from the origin: what coordinates are rounded against.
double sizeOf(const std::vector<double>& radii, const std::vector<BodySample>& bodies) {
  double size = 0.0;
  for (std::size_t i = 0; i < radii.size(); ++i)
    if (radii[i] >= 0.0) size = std::max(size, radii[i] + bodies[i].x.norm());
  return size;
}

bool came(const HalvedRun& run, std::size_t instant) {
  return instant < run.bodies.size();
}

// What the runs of one method say at an instant, the reference apart.
MethodAt lookAt(const std::vector<double>& radii, const MethodRuns& all, std::size_t instant,
                double t) {
  MethodAt at;
  at.missing = all.refusal.empty() ? "" : "refuses the scene: " + all.refusal;
  const std::vector<BodySample>* before = nullptr;
  for (const HalvedRun& run : all.runs) {
    if (!came(run, instant)) {
      at.missing =
          run.step > 0.0 ? fmt::format("step {:.4g} s: {}", run.step, run.ended) : run.ended;
      break;
    }
    const std::vector<BodySample>& bodies = run.bodies[instant];
    if (before) at.differences.push_back(apart(radii, *before, bodies));
    before = &bodies;
    at.steps.push_back(run.step);
    at.seconds.push_back(run.seconds[instant]);
  }
  if (!before) return at;
  // Of N steps rounding adds up as √N, as a walk of random steps does.
  const std::vector<BodySample>& first = all.runs.front().bodies[instant];
  const double rounding = std::numeric_limits<double>::epsilon() * sizeOf(radii, first);
  const double count = at.steps.back() > 0.0 ? t / at.steps.back() : 0.0;
  at.noise = (4.0 + std::sqrt(count)) * rounding;
  if (came(all.twin, instant))
    at.noise = std::max(at.noise, apart(radii, first, all.twin.bodies[instant]));
  at.richardson = extrapolate(at.differences, at.noise);
  if (at.richardson.halving == Halving::Rounding && at.noise > kChaos * sizeOf(radii, first)) {
    at.richardson.halving = Halving::Chaos;
    at.richardson.errors.assign(at.steps.size(), kInfinity);
  }
  // Without a step there is nothing to halve: rounding is all that is known.
  if (at.steps.front() == 0.0) at.richardson = {Halving::Rounding, 0.0, {at.noise}};
  return at;
}

// `exact` if it came so far, else the method with the least error.
int referenceOf(const ConvergenceAt& at, const std::vector<MethodRuns>& runs) {
  int best = -1;
  double least = kInfinity;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const MethodAt& method = at.methods[i];
    if (method.steps.empty()) continue;
    if (runs[i].method == "exact") return static_cast<int>(i);
    if (method.richardson.errors.back() < least) {
      least = method.richardson.errors.back();
      best = static_cast<int>(i);
    }
  }
  return best;
}

void holdToReference(const std::vector<double>& radii, const std::vector<MethodRuns>& runs,
                     std::size_t instant, ConvergenceAt& at) {
  at.reference = referenceOf(at, runs);
  if (at.reference < 0) return;
  const MethodAt& other = at.methods[static_cast<std::size_t>(at.reference)];
  const HalvedRun& finest =
      runs[static_cast<std::size_t>(at.reference)].runs[other.steps.size() - 1];
  for (std::size_t i = 0; i < runs.size(); ++i) {
    MethodAt& method = at.methods[i];
    for (std::size_t k = 0; k < method.steps.size(); ++k)
      method.offReference.push_back(
          apart(radii, runs[i].runs[k].bodies[instant], finest.bodies[instant]));
    const Halving halving = method.richardson.halving;
    if (method.steps.empty() || (halving != Halving::Converges && halving != Halving::Rounding))
      continue;
    const double size = sizeOf(radii, finest.bodies[instant]);
    method.elsewhere =
        method.offReference.back() >
        kApart * size + kFar * (method.richardson.errors.back() + other.richardson.errors.back());
  }
}

}  // namespace

Richardson extrapolate(std::span<const double> differences, double noise) {
  Richardson result;
  result.errors.assign(differences.size() + 1, kInfinity);
  if (differences.empty()) return result;
  const auto small = [noise](double d) { return d <= kAbove * noise; };
  if (std::all_of(differences.begin(), differences.end(), small)) {
    result.halving = Halving::Rounding;
    result.errors.assign(differences.size() + 1, noise);
    for (std::size_t k = 0; k < differences.size(); ++k)
      result.errors[k] = std::max(noise, differences[k]);
    return result;
  }
  if (differences.size() < 2) return result;
  // Where rounding takes over there is no more to see: the halvings before, and the one into it.
  const std::size_t clear = static_cast<std::size_t>(
      std::find_if(differences.begin(), differences.end(), small) - differences.begin());
  const std::size_t last = std::clamp<std::size_t>(clear, 2, differences.size()) - 1;
  const double ratio = differences[0] / std::max(differences[last], noise);
  const double order = std::log2(ratio) / static_cast<double>(last);
  if (!(order >= kLeastOrder)) {
    result.halving = Halving::Diverges;
    return result;
  }
  result.halving = Halving::Converges;
  result.order = order;
  const double q = std::exp2(order);
  for (std::size_t k = 0; k < differences.size(); ++k)
    result.errors[k] = std::max(noise, differences[k] * q / (q - 1.0));
  result.errors.back() = std::max(noise, differences.back() / (q - 1.0));
  return result;
}

Convergence convergenceOf(const Scene& scene, const HalvingPlan& plan,
                          const std::vector<MethodRuns>& runs) {
  const std::vector<double> radii = movingRadii(scene);
  Convergence convergence{scene.title.empty() ? scene.name : scene.title, {}, {}};
  for (const MethodRuns& all : runs) convergence.methods.push_back(all.method);
  for (std::size_t k = 0; k < plan.instants.size(); ++k) {
    ConvergenceAt& at = convergence.instants.emplace_back();
    at.t = plan.instants[k];
    for (const MethodRuns& all : runs) at.methods.push_back(lookAt(radii, all, k, at.t));
    holdToReference(radii, runs, k, at);
  }
  return convergence;
}

std::string wordFor(const MethodAt& method) {
  if (method.steps.empty()) return "no run";
  const std::string where = method.elsewhere ? ", elsewhere" : "";
  if (method.steps.front() == 0.0) return "no step" + where;
  switch (method.richardson.halving) {
    case Halving::Converges:
      return fmt::format("order {:.1f}{}", method.richardson.order, where);
    case Halving::Rounding:
      return "rounding" + where;
    case Halving::Diverges:
      return "does not converge";
    case Halving::Chaos:
      return "does not converge: chaos";
    case Halving::Unknown:
      break;
  }
  return "too few runs";
}

Study speedOf(const Convergence& convergence) {
  Study study;
  study.scene = convergence.scene;
  study.chart.variant.title = convergence.scene + ": speed against error";
  study.chart.along.parameter = "step";
  const auto some = [](const ConvergenceAt& at) {
    return std::any_of(at.methods.begin(), at.methods.end(),
                       [](const MethodAt& method) { return !method.steps.empty(); });
  };
  const auto found = std::find_if(convergence.instants.rbegin(), convergence.instants.rend(), some);
  if (found == convergence.instants.rend()) return study;
  const ConvergenceAt& at = *found;
  study.chart.subtitle = fmt::format(
      "error [m] of the farthest point of a body at t = {:.4g} s, by Richardson from halved steps; "
      "dashed: what the last place of the start changes",
      at.t);
  for (std::size_t i = 0; i < at.methods.size(); ++i) {
    const MethodAt& method = at.methods[i];
    if (method.steps.empty()) continue;
    ChartSeries& series = study.series.emplace_back();
    series.parameter = "step";
    series.label = convergence.methods[i];
    study.orders.emplace_back();
    study.notes.push_back(wordFor(method));
    for (std::size_t k = 0; k < method.steps.size(); ++k)
      series.points.push_back({fmt::format("{:.17g}", method.steps[k]), method.richardson.errors[k],
                               0, method.seconds[k] / at.t});
    study.chart.floor = std::min(study.chart.floor.value_or(kInfinity), method.noise);
  }
  return study;
}

bool drawable(const Study& study) {
  for (const ChartSeries& series : study.series)
    for (const ChartPoint& point : series.points)
      if (point.error > 0.0 && std::isfinite(point.error) && point.cpuShare > 0.0) return true;
  return false;
}

}  // namespace tumble
