// What it costs to see how far two bodies are apart: full searches, remembered planes, manifolds,
// certified signs, an L in three decompositions, and rings in each other.
#include "sim/collide/collide.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <vector>

#include "sim/collide/certified.h"
#include "sim/collide/parts.h"
#include "sim/collide/witness.h"
#include "sim/shape/pieces.h"
#include "tests/collide/hulls.h"

namespace {

using namespace tumble;

enum class Solids { Boxes, Hulls, RoundHulls, BoxCapsule, BoxCylinder, Cylinders };

struct Pair {
  Shape a, b;
  Pose poseA, poseB;
};

Shape ballOf(int corners, Random& random) {  // a hull
  std::vector<Vec3> points;
  for (int k = 0; k < corners; ++k) points.push_back(0.5 * random.direction());
  return hullOf(points);
}

/// Pairs at a gap [m] along their widest plane.
std::vector<Pair> pairsAt(Solids solids, double gap) {
  Random random(91);
  std::vector<Pair> pairs;
  for (int k = 0; k < 256; ++k) {
    Pair pair;
    const Box box = random.box(0.3, 0.5), other = random.box(0.3, 0.5);
    pair.a = box;
    pair.b = other;
    if (solids == Solids::Hulls || solids == Solids::RoundHulls) {
      const int corners = solids == Solids::Hulls ? 20 : 300;
      pair.a = ballOf(corners, random);
      pair.b = ballOf(corners, random);
    }
    if (solids == Solids::BoxCapsule) pair.b = Capsule{0.2, 0.6};
    if (solids == Solids::BoxCylinder || solids == Solids::Cylinders) pair.b = Cylinder{0.4, 0.6};
    if (solids == Solids::Cylinders) pair.a = Cylinder{0.3, 0.8};
    pair.poseA = random.pose(0.8);
    pair.poseB = random.pose(0.2);
    for (int step = 0; step < 6; ++step) {
      const ContactPoint c = separatingPlane(pair.a, pair.poseA, pair.b, pair.poseB);
      pair.poseA.x -= (c.separation - gap) * c.n;
    }
    pairs.push_back(pair);
  }
  return pairs;
}

template <class Ask>
void askAll(benchmark::State& state, const std::vector<Pair>& pairs, Ask ask) {
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(ask(pairs[k]));
    k = (k + 1) % pairs.size();
  }
}

void fullSearch(benchmark::State& state, Solids solids, double gap) {
  askAll(state, pairsAt(solids, gap),
         [](const Pair& p) { return separatingPlane(p.a, p.poseA, p.b, p.poseB).separation; });
}
void manifold(benchmark::State& state, Solids solids, double gap) {
  Manifold out;
  askAll(state, pairsAt(solids, gap), [&](const Pair& p) {
    collide(p.a, p.poseA, p.b, p.poseB, 1e-4, out);
    return out.size();
  });
}
void certified(benchmark::State& state, Solids solids, double gap) {
  askAll(state, pairsAt(solids, gap),
         [](const Pair& p) { return certifiedSeparation(p.a, p.poseA, p.b, p.poseB).value; });
}
void remembered(benchmark::State& state, Solids solids) {
  const std::vector<Pair> pairs = pairsAt(solids, 0.01);
  std::vector<Witness> witnesses;
  for (const Pair& p : pairs)
    witnesses.push_back(witnessOf(separatingPlane(p.a, p.poseA, p.b, p.poseB), p.poseA, p.poseB));
  std::size_t k = 0;
  for (auto _ : state) {
    const Pair& p = pairs[k];
    benchmark::DoNotOptimize(showsApart(witnesses[k], p.a, p.poseA, p.b, p.poseB, 1e-4));
    k = (k + 1) % pairs.size();
  }
}

/// The L of three unit cubes: 1 hull, 2 boxes, 8 slivers.
void ell(benchmark::State& state) {
  const int slices = state.range(0) == 8 ? 4 : 1;
  Shape shape;
  if (state.range(0) == 1) {
    std::vector<Vec3> points;
    for (const double z : {0.0, 1.0})
      for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(2.0, 0.0), std::pair(2.0, 1.0),
                                 std::pair(1.0, 2.0), std::pair(0.0, 2.0)})
        points.push_back({x, y, z});
    shape = hullOf(points);
  } else {
    Compound parts;
    for (int k = 0; k < slices; ++k) {
      const double half = 0.5 / slices, z = half * (2 * k + 1);
      parts.parts.push_back({Box{{1.0, 0.5, half}}, {{1.0, 0.5, z}, Quat::Identity()}});
      parts.parts.push_back({Box{{0.5, 0.5, half}}, {{0.5, 1.5, z}, Quat::Identity()}});
    }
    shape = readyShape(parts);
  }
  Random random(92);
  std::vector<Pair> pairs;
  for (int k = 0; k < 256; ++k) {
    const Vec3 x = Vec3(1.0, 1.0, 0.5) + random.vector(-1.0, 1.0);
    pairs.push_back({Box{{0.1, 0.15, 0.2}}, shape, {x, random.rotation()}, Pose{}});
  }
  askAll(state, pairs, [](const Pair& p) { return separation(p.a, p.poseA, p.b, p.poseB); });
}

/// Two rings of 48 pieces in each other, 2 cm apart where they are nearest, one turning to and fro
/// by 0.1: a look with what the look before knew.
void interlocked(benchmark::State& state) {
  const int around = 48, across = 24;
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const double a = 2.0 * EIGEN_PI * i / around, b = 2.0 * EIGEN_PI * k / across;
      const double r = 1.0 + 0.3 * std::cos(b);
      points.emplace_back(r * std::cos(a), r * std::sin(a), 0.3 * std::sin(b));
      const int j = (i + 1) % around, l = (k + 1) % across;
      faces.push_back({i * across + k, j * across + k, j * across + l, i * across + l});
    }
  Mesh mesh{std::make_shared<const Polyhedron>(makePolyhedron(points, faces)), -points[0]};
  mesh.pieces = std::make_shared<const Pieces>(piecesOf(*mesh.solid, PieceKind::Good, 1.4e-6));
  const Shape ring = readyShape(contactShape(mesh));
  std::vector<PartWitness> known;
  PartLooks looks;
  Manifold out;
  long count = 0;
  for (auto _ : state) {
    const double angle = 1e-3 * std::abs(static_cast<double>(count++ % 400) - 200.0) - 0.1;
    const Pose other{{1.38, 0.0, 0.0},
                     Quat(Eigen::AngleAxisd(0.5 * EIGEN_PI + angle, Vec3::UnitX()))};
    collide(ring, Pose{}, ring, other, 0.01, out, known, looks);
  }
  state.counters["pairs_a_look"] = static_cast<double>(looks.tests) / static_cast<double>(count);
  state.counters["remembered"] =
      static_cast<double>(looks.hits) / static_cast<double>(std::max(1L, looks.tests));
}
BENCHMARK(interlocked)->Name("collide: ring in ring, 48 pieces each, coherent");

BENCHMARK_CAPTURE(fullSearch, boxes_apart, Solids::Boxes, 0.01);
BENCHMARK_CAPTURE(fullSearch, boxes_overlapping, Solids::Boxes, -0.01);
BENCHMARK_CAPTURE(fullSearch, hulls_of_20_corners_apart, Solids::Hulls, 0.01);
BENCHMARK_CAPTURE(fullSearch, hulls_of_20_corners_overlapping, Solids::Hulls, -0.01);
BENCHMARK_CAPTURE(fullSearch, hulls_of_300_corners_overlapping, Solids::RoundHulls, -0.001);
BENCHMARK_CAPTURE(fullSearch, box_capsule_touching, Solids::BoxCapsule, 0.0);
BENCHMARK_CAPTURE(fullSearch, box_cylinder_touching, Solids::BoxCylinder, 0.0);
BENCHMARK_CAPTURE(fullSearch, cylinders_touching, Solids::Cylinders, 0.0);
BENCHMARK_CAPTURE(remembered, boxes, Solids::Boxes);
BENCHMARK_CAPTURE(remembered, hulls_of_20_corners, Solids::Hulls);
BENCHMARK_CAPTURE(manifold, boxes_touching, Solids::Boxes, 0.0);
BENCHMARK_CAPTURE(manifold, hulls_of_20_corners_touching, Solids::Hulls, 0.0);
BENCHMARK_CAPTURE(certified, boxes_apart, Solids::Boxes, 0.01);
BENCHMARK_CAPTURE(certified, boxes_touching, Solids::Boxes, 0.0);
BENCHMARK_CAPTURE(certified, hulls_of_20_corners_apart, Solids::Hulls, 0.01);
BENCHMARK_CAPTURE(certified, hulls_of_20_corners_touching, Solids::Hulls, 0.0);
BENCHMARK(ell)->Name("separation: small box from an L of parts")->Arg(1)->Arg(2)->Arg(8);

}  // namespace
