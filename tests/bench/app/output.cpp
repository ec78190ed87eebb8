// What `simulate` adds to a run: writing its numbers with 17 digits.
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>

#include "app/record/output.h"

namespace {

using namespace tumble;

constexpr int kBodies = 1000, kNumbersARow = 14;

Scene manyBodies() {
  Scene scene;
  for (int i = 0; i < kBodies; ++i) {
    BodyDef ball;
    ball.name = "ball." + std::to_string(i);
    scene.world.bodies.push_back(ball);
  }
  return scene;
}

Sample numbers(double t) {
  Sample sample;
  sample.t = t;
  for (int i = 0; i < kBodies; ++i) {
    const auto draw = [&](int k) { return 10.0 * std::sin(t + 1.7 * i + 0.3 * k); };
    sample.bodies.push_back({{draw(0), draw(1), draw(2)},
                             Quat(draw(3), draw(4), draw(5), draw(6)).normalized(),
                             {draw(7), draw(8), draw(9)},
                             {draw(10), draw(11), draw(12)}});
  }
  return sample;
}

/// Rows of trajectory.csv, written to a file.
void trajectory(benchmark::State& state) {
  const Scene scene = manyBodies();
  const Sample sample = numbers(1.0 / 3.0);
  const std::string folder = std::filesystem::temp_directory_path() / "tumble-output-bench";
  {
    OutputFiles files(folder, scene);
    for (auto _ : state) files.add(sample);
  }
  std::filesystem::remove_all(folder);
  state.counters["per number"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kBodies * kNumbersARow,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(trajectory)
    ->Name("output: 1000 rows of trajectory.csv")
    ->Iterations(200)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
