#include "tests/peers/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <sstream>

#include "app/report/bounded.h"

namespace tumble::peers {

namespace {

// CPU time [s] of this thread.
double threadSeconds() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

long stepsOf(const Scene& scene, double rate) {
  return std::lround(scene.world.duration * rate);
}

bool finite(const std::vector<BodySample>& bodies) {
  return std::all_of(bodies.begin(), bodies.end(), [](const BodySample& body) {
    return body.x.allFinite() && body.q.coeffs().allFinite();
  });
}

// Looks after every step, of many bodies 240 times a second.
Motion motionOf(const EngineSetup& setup, const Scene& scene, double rate) {
  constexpr double kLooks = 240.0;  // 1/s
  const bool crowd = scene.world.bodies.size() > 50;
  const long stride = crowd ? std::max(1L, std::lround(rate / kLooks)) : 1;
  const std::unique_ptr<Engine> engine = setup.make(scene, 1.0 / rate);
  Motion motion{static_cast<double>(stride) / rate, {}};
  motion.looks.emplace_back();
  engine->read(motion.looks.back());
  for (long k = 1; k <= stepsOf(scene, rate); ++k) {
    engine->step();
    if (k % stride != 0) continue;
    motion.looks.emplace_back();
    engine->read(motion.looks.back());
    if (!finite(motion.looks.back())) throw std::runtime_error("not a number");
  }
  return motion;
}

// The error, or why there is none.
struct Measured {
  std::optional<double> error;
  std::string why;
  bool last = false;  ///< finer steps would do no better
};
Measured measure(const Trial& trial, const EngineSetup& setup, const Scene& scene, double rate,
                 double most) {
  const Bounded run = runBounded(most, [&](const Send& send) {
    try {
      send(fmt::format("{:.17g}", trial.measure(scene, motionOf(setup, scene, rate))));
    } catch (const CannotExpress& error) {
      send(std::string("?cannot express ") + error.what());
    } catch (const std::exception& error) {
      send(std::string("!") + error.what());
    }
  });
  if (run.outOfTime) return {{}, fmt::format("takes more than {:g} CPU s", most), true};
  if (!run.whole || run.sent.empty()) return {{}, "ended the process"};
  if (run.sent.front() == '!') return {{}, run.sent.substr(1, run.sent.find('\n') - 1)};
  if (run.sent.front() == '?') return {{}, run.sent.substr(1), true};
  const double error = std::strtod(run.sent.c_str(), nullptr);
  if (!std::isfinite(error)) return {{}, "lost: " + trial.error};
  return {error, ""};
}

// CPU seconds for a simulated second of the bare steps; short runs are made several times, in
// worlds of their own.
double costOf(const EngineSetup& setup, const Scene& scene, double rate) {
  constexpr double kLeast = 2e-3;  // [s] that the clock should cover
  constexpr int kMost = 100;
  if (setup.askedOnce) rate = 1.0 / scene.world.duration;
  const long steps = stepsOf(scene, rate);
  double spent = 0.0;
  int runs = 0;
  while (runs == 0 || (spent < kLeast && runs < kMost)) {
    const std::unique_ptr<Engine> engine = setup.make(scene, 1.0 / rate);
    const double start = threadSeconds();
    for (long k = 0; k < steps; ++k) engine->step();
    spent += threadSeconds() - start;
    ++runs;
  }
  return spent / runs / scene.world.duration;
}

struct Job {
  const EngineSetup* setup;
  Point point;
};

// What has a clock of its own is asked so many times a second.
constexpr double kAsked = 60.0;

// Every setup from its coarsest step on, until one is too slow.
std::vector<Job> measureAll(const Trial& trial, const Scene& scene,
                            const std::vector<EngineSetup>& setups, const Plan& plan,
                            std::vector<Gap>& gaps, const std::function<void(double)>& progress) {
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    const EngineSetup& setup = setups[i];
    if (!meantFor(setup, scene.world)) continue;
    for (const double of : trial.rates) {
      const double rate = setup.stepless ? kAsked : of;
      const Measured measured = measure(trial, setup, scene, rate, plan.most);
      if (measured.error)
        jobs.push_back({&setup,
                        {trial.name,
                         setup.engine,
                         setup.name,
                         setup.asItComes,
                         false,
                         rate,
                         *measured.error,
                         {}}});
      else
        gaps.push_back(
            {trial.name, setup.engine, fmt::format("{}, {:g}/s", setup.name, rate), measured.why});
      if (measured.last || setup.stepless) break;
    }
    progress(0.5 * static_cast<double>(i + 1) / static_cast<double>(setups.size()));
  }
  return jobs;
}

}  // namespace

std::vector<Point> runTrial(const Trial& trial, const Scene& scene,
                            const std::vector<EngineSetup>& setups, const Plan& plan,
                            std::vector<Gap>& gaps, const std::function<void(double)>& progress) {
  if (trial.prepare) trial.prepare(scene);
  std::vector<Job> jobs = measureAll(trial, scene, setups, plan, gaps, progress);
  constexpr int kFewest = 3;
  for (int turn = 0; turn < plan.repeats; ++turn) {
    for (Job& job : jobs) {
      std::vector<double>& costs = job.point.costs;
      const double each = costs.empty() ? 0.0 : costs.front() * scene.world.duration;
      const int least = each > plan.patience ? 1 : kFewest;
      if (turn >= least && each * turn > plan.patience) continue;
      costs.push_back(costOf(*job.setup, scene, job.point.rate));
    }
    progress(0.5 + 0.5 * (turn + 1) / plan.repeats);
  }
  std::vector<Point> points;
  for (Job& job : jobs) points.push_back(std::move(job.point));
  return points;
}

}  // namespace tumble::peers
