#include "app/report/scaling.h"

#include <fmt/format.h>

#include <limits>

#include "app/file/data.h"
#include "app/record/output.h"
#include "app/report/cost.h"
#include "app/report/swarm.h"
#include "sim/collide/collide.h"
#include "sim/collide/witness.h"
#include "sim/shape/convex_hull.h"

namespace tumble {

namespace {

void fitSlope(ScalingCurve& curve) {
  std::vector<double> sizes, times;
  for (const auto& [size, time] : curve.points) {
    sizes.push_back(size);
    times.push_back(time);
  }
  curve.slope = slopeOf(sizes, times);
}

/// Two hulls with their corners on balls of radius 0.5 m, 0.01 m to 0.1 m apart, and a plane
/// between them.
struct Pair {
  Hull a, b;
  Pose poseA;
  Witness witness;
};

Vec3 direction(std::mt19937_64& engine) {
  Vec3 v;
  do
    for (int k = 0; k < 3; ++k) v[k] = std::ldexp(static_cast<double>(engine() >> 11), -52) - 1.0;
  while (v.squaredNorm() > 1.0 || v.squaredNorm() < 0.01);
  return v.normalized();
}

Hull roundHull(int corners, std::mt19937_64& engine) {
  std::vector<Vec3> points;
  for (int k = 0; k < corners; ++k) points.push_back(0.5 * direction(engine));
  return Hull{std::make_shared<const Polyhedron>(convexHull(points)), -points.at(0)};
}

std::vector<Pair> pairsOf(int corners) {
  constexpr int kPairs = 32;
  std::mt19937_64 engine(7);
  std::vector<Pair> pairs;
  for (int k = 0; k < kPairs; ++k) {
    Pair& pair = pairs.emplace_back();
    pair.a = roundHull(corners, engine);
    pair.b = roundHull(corners, engine);
    pair.poseA.x = 1.02 * direction(engine);
    pair.witness = witnessOf(separatingPlane(pair.a, pair.poseA, pair.b, {}), pair.poseA, {});
  }
  return pairs;
}

/// CPU time [s] of one call, the least of five turns of two milliseconds each.
template <class Ask>
double timeOfCall(const std::vector<Pair>& pairs, Ask ask) {
  constexpr int kTurns = 5;
  constexpr double kTurn = 2e-3;  // [s]
  double least = std::numeric_limits<double>::infinity();
  volatile double sink = 0.0;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double start = cpuTime();
    double spent = 0.0;
    long calls = 0;
    while (spent < kTurn) {
      for (const Pair& pair : pairs) sink = sink + ask(pair);
      calls += static_cast<long>(pairs.size());
      spent = cpuTime() - start;
    }
    least = std::min(least, spent / static_cast<double>(calls));
  }
  return least;
}

}  // namespace

Scaling broadPhaseScaling(int most) {
  Scaling scaling{"broad-phase",
                  "A step of the broad phase against the number of bodies",
                  "boxes at constant density that move by 1 % of their edges a step",
                  "bodies",
                  "CPU seconds a step",
                  {}};
  const std::span<const BroadPhaseRow> rows = broadPhaseRows();
  static_assert(kMostBoxes.size() == 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ScalingCurve& curve = scaling.curves.emplace_back();
    curve.label = rows[i].name;
    for (const int n : {100, 300, 1000, 3000, 10000, 30000, 100000})
      if (n <= std::min(most, kMostBoxes.at(i)))
        curve.points.emplace_back(n, timeOfUpdate(BroadPhase(rows[i]), n));
    fitSlope(curve);
  }
  return scaling;
}

Scaling searchScaling() {
  Scaling scaling{"search",
                  "Is there a plane between two hulls? Sought, and remembered",
                  "hulls of random corners on balls of 0.5 m, at least 2 cm apart",
                  "corners of each hull",
                  "CPU seconds a question",
                  {{"full search", {}, 0.0}, {"remembered plane", {}, 0.0}}};
  for (const int corners : {8, 16, 32, 64, 128}) {
    const std::vector<Pair> pairs = pairsOf(corners);
    scaling.curves[0].points.emplace_back(
        corners, timeOfCall(pairs, [](const Pair& p) {
          return separatingPlane(p.a, p.poseA, p.b, {}).separation;
        }));
    scaling.curves[1].points.emplace_back(
        corners, timeOfCall(pairs, [](const Pair& p) {
          return showsApart(p.witness, p.a, p.poseA, p.b, {}, 0.0) ? 1.0 : 0.0;
        }));
  }
  for (ScalingCurve& curve : scaling.curves) fitSlope(curve);
  return scaling;
}

Scaling crowdScaling(int most) {
  constexpr double kRoom = 0.12;  // m² of the tray for each box
  Scaling scaling{"crowd-growth",
                  "Boxes that fall into a tray against how many they are",
                  "boxes of 0.3 × 0.2 × 0.2 m, e = 0.2, 0.12 m² of tray for each, the first 2 s",
                  "boxes",
                  "CPU seconds per simulated second",
                  {}};
  for (const char* preset : {"auto", "fast", "draft"}) {
    ScalingCurve& curve = scaling.curves.emplace_back();
    curve.label = preset;
    for (int count = 25; count <= most; count *= 2) {
      const double half = 0.5 * std::sqrt(kRoom * count), inside = half - 0.2;
      std::vector<std::string> set = {fmt::format("stepping.preset={}", preset),
                                      fmt::format("array.box.count={}", count),
                                      fmt::format("array.box.lo=[{0}, 0.3, {0}]", -inside),
                                      fmt::format("array.box.hi=[{0}, 3.0, {0}]", inside)};
      for (const auto& [wall, n] : {std::pair("west", "1.0, 0.0, 0.0"),
                                    {"east", "-1.0, 0.0, 0.0"},
                                    {"north", "0.0, 0.0, 1.0"},
                                    {"south", "0.0, 0.0, -1.0"}})
        set.push_back(fmt::format("body.{}.shape={{ plane = [{}, {}] }}", wall, n, -half));
      const Scene scene = readScene(dataFolder("report") + "/parts/tray.toml", set);
      curve.points.emplace_back(count, cpuShares({scene}, 0.0).front());
    }
    fitSlope(curve);
  }
  return scaling;
}

std::string scalingCsv(const Scaling& scaling) {
  std::string csv = "curve,size,cpu_seconds\n";
  for (const ScalingCurve& curve : scaling.curves)
    for (const auto& [size, time] : curve.points)
      csv += fmt::format("{},{},{:.4g}\n", csvQuoted(curve.label), size, time);
  return csv;
}

}  // namespace tumble
