// Which pieces of cloths are seen to press on each other.
#include "sim/elastic/layers.h"

#include <cmath>
#include <functional>
#include <set>

#include "sim/elastic/cloth.h"
#include "tests/catch.h"

using namespace tumble;

namespace {

constexpr double kThick = 0.01;

std::shared_ptr<const ElasticBody> clothOf(const ClothDef& def, int first) {
  auto body = std::make_shared<ElasticBody>();
  const int count = def.columns * def.rows;
  for (int i = 0; i < count; ++i) body->bodies.push_back(first + i);
  body->sheet = clothSheet(def, kThick, first);
  return body;
}

using Key = std::pair<bool, std::array<int, 4>>;

Key keyOf(bool edges, std::array<int, 4> points) {
  if (!edges) {
    std::sort(points.begin() + 1, points.end());
    return {edges, points};
  }
  if (points[0] > points[1]) std::swap(points[0], points[1]);
  if (points[2] > points[3]) std::swap(points[2], points[3]);
  if (points[0] > points[2]) points = {points[2], points[3], points[0], points[1]};
  return {edges, points};
}

std::set<Key> seen(const Layers& layers, const std::vector<Vec3>& x, const std::vector<Vec3>& way) {
  Layers::Look look;
  layers.look(x, way, look);
  std::set<Key> keys;
  for (const LayerPair& pair : look.pairs) keys.insert(keyOf(pair.edges, pair.points));
  CHECK(keys.size() == look.pairs.size());  // none twice
  return keys;
}

/// Every pair of a point and a triangle, and of two edges, that is nearer than so much, edges nine
/// tenths of it, by looking at all of them; those of one cloth that are within two thicknesses of
/// each other along it not.
std::set<Key> all(const std::vector<std::shared_ptr<const ElasticBody>>& cloths,
                  const std::vector<Vec3>& x, double within) {
  std::vector<std::array<int, 3>> triangles;
  std::set<std::pair<int, int>> edges;
  std::vector<int> clothOf;
  std::vector<Vec3> flat;
  for (std::size_t c = 0; c < cloths.size(); ++c) {
    for (const auto& t : cloths[c]->sheet.triangles) {
      triangles.push_back(t);
      for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    }
    for (const auto& p : cloths[c]->sheet.flat) {
      flat.emplace_back(p.x(), p.y(), 0.0);
      clothOf.push_back(static_cast<int>(c));
    }
  }
  std::set<Key> keys;
  const auto see = [&](bool ofEdges, const std::array<int, 4>& p) {
    const auto distance = [&](const std::vector<Vec3>& at) {
      const std::array<Vec3, 4> corners = {at[p[0]], at[p[1]], at[p[2]], at[p[3]]};
      return (ofEdges ? nearestOfEdges(corners) : nearestOnTriangle(corners)).span.norm();
    };
    for (int i = 0; i < (ofEdges ? 2 : 1); ++i)
      for (int j = ofEdges ? 2 : 1; j < 4; ++j)
        if (p[i] == p[j]) return;
    if (distance(x) >= (ofEdges ? 0.9 * within : within)) return;
    if (clothOf[p[0]] == clothOf[p[3]] && distance(flat) < 2.0 * kThick) return;
    keys.insert(keyOf(ofEdges, p));
  };
  for (int p = 0; p < static_cast<int>(x.size()); ++p)
    for (const auto& t : triangles) see(false, {p, t[0], t[1], t[2]});
  for (auto e = edges.begin(); e != edges.end(); ++e)
    for (auto f = std::next(e); f != edges.end(); ++f)
      see(true, {e->first, e->second, f->first, f->second});
  return keys;
}

struct Case {
  const char* name;
  std::function<Vec3(double, double)> at;  ///< of u, v
};

}  // namespace

// Oracle: a search over all pairs. Flat, bent, rolled up, crumpled and laid on another one; with
// points as near as the cloth is thick and as far.
TEST_CASE("every pair of cloth that is nearer than its thickness is seen, and no other") {
  const ClothDef def{.columns = 13, .rows = 9, .length = 0.3, .width = 0.2};
  const ClothDef small{.columns = 5, .rows = 6, .length = 0.09, .width = 0.11};
  const std::vector<std::shared_ptr<const ElasticBody>> cloths = {clothOf(def, 0),
                                                                  clothOf(small, 13 * 9)};
  const Layers layers(cloths);
  const Case cases[] = {
      {"flat", [](double u, double v) { return Vec3(u, 0.0, v); }},
      {"on a tube",
       [](double u, double v) {
         return Vec3(0.05 * std::sin(u / 0.05), 0.05 * std::cos(u / 0.05), v);
       }},
      {"rolled up",
       [](double u, double v) {
         const double a = 25.0 * (u + 0.2), r = 0.004 + 0.0012 * a;
         return Vec3(r * std::cos(a), r * std::sin(a), v);
       }},
      {"folded",
       [](double u, double v) { return Vec3(std::abs(u), u < 0.0 ? 0.0 : 0.008 + 0.1 * v, v); }},
      {"crumpled", [](double u, double v) {
         return Vec3(0.03 * std::sin(40.0 * u + 3.0 * v), 0.03 * std::cos(70.0 * v + u),
                     0.03 * std::sin(31.0 * u + 50.0 * v));
       }}};
  for (const Case& shape : cases)
    for (const double above : {0.002, 0.0101, 1.0}) {
      std::vector<Vec3> x;
      for (const Vec3& p : clothPlaces(def)) x.push_back(shape.at(p.x(), p.z()));
      for (const Vec3& p : clothPlaces(small)) x.push_back(Vec3(0.011, above, 0.013) + p);
      CAPTURE(shape.name, above);
      const std::set<Key> expected = all(cloths, x, kThick);
      CHECK(seen(layers, x, {}) == expected);
      if (above == 1.0)
        CHECK(expected.empty() ==
              (shape.name == std::string("flat") || shape.name == std::string("on a tube")));
    }
}

// Oracle: what a search over all pairs finds at forty instants of straight ways. What only grazes
// may be missed by it. What is as near at the end is what is seen there.
TEST_CASE(
    "what comes as near as cloth is thick on its way is seen before, from the side it is on") {
  const ClothDef def{.columns = 7, .rows = 6, .length = 0.15, .width = 0.12};
  const std::vector<std::shared_ptr<const ElasticBody>> cloths = {clothOf(def, 0),
                                                                  clothOf(def, 42)};
  const Layers layers(cloths);
  const std::vector<Vec3> flat = clothPlaces(def);
  for (const double fall : {0.03, 0.06, 0.3}) {
    std::vector<Vec3> x = flat, way(84, Vec3::Zero());
    for (std::size_t k = 0; k < flat.size(); ++k) {
      x.push_back(flat[k] + Vec3(0.004, 0.05, 0.007));
      way[42 + k] = Vec3(0.01, -fall, 0.002 * static_cast<double>(k % 3));
    }
    std::set<Key> expected;
    for (int k = 0; k <= 40; ++k) {
      std::vector<Vec3> at = x;
      for (std::size_t p = 0; p < at.size(); ++p) at[p] += k / 40.0 * way[p];
      for (const Key& key : all(cloths, at, 0.998 * kThick)) expected.insert(key);
    }
    const std::set<Key> found = seen(layers, x, way);
    CAPTURE(fall, expected.size(), found.size());
    CHECK(expected.empty() == (fall == 0.03));
    for (const Key& key : expected) CHECK(found.count(key) == 1);
    Layers::Look look;
    layers.look(x, way, look);
    std::vector<Vec3> end = x;
    for (std::size_t p = 0; p < end.size(); ++p) end[p] += way[p];
    std::set<Key> ahead;
    for (const LayerPair& pair : look.ahead) ahead.insert(keyOf(pair.edges, pair.points));
    CHECK(ahead == seen(layers, end, {}));
    CHECK(ahead.empty() == (fall != 0.06));
    for (const LayerPair& pair : look.pairs) {
      CHECK(pair.gap > 0.0);  // nothing has passed yet
      CHECK(pair.closes);
      double ahead = pair.gap;
      for (int k = 0; k < 4; ++k) ahead += pair.weight[k] * pair.n.dot(way[pair.points[k]]);
      CHECK(ahead < pair.thickness);
    }
  }
}

// Oracle: a search over all pairs. What lies flat at one end of the way is not flat all along it.
TEST_CASE("cloth that folds on its way, or opens, is seen where it comes near itself") {
  const ClothDef def{.columns = 13, .rows = 9, .length = 0.3, .width = 0.2};
  const std::vector<std::shared_ptr<const ElasticBody>> cloths = {clothOf(def, 0)};
  const Layers layers(cloths);
  const std::vector<Vec3> flat = clothPlaces(def);
  std::vector<Vec3> folded, fold, open;
  for (const Vec3& p : flat) {
    folded.emplace_back(std::abs(p.x()), p.x() < 0.0 ? 0.0 : 0.008 + 0.1 * p.z(), p.z());
    fold.push_back(folded.back() - p);
    open.push_back(p - folded.back());
  }
  const std::set<Key> expected = all(cloths, folded, kThick);
  REQUIRE_FALSE(expected.empty());
  Layers::Look look;
  layers.look(flat, fold, look);
  std::set<Key> ahead;
  for (const LayerPair& pair : look.ahead) ahead.insert(keyOf(pair.edges, pair.points));
  CHECK(ahead == expected);
  const std::set<Key> found = seen(layers, folded, open);
  for (const Key& key : expected) CHECK(found.count(key) == 1);
}

// Oracle: mirror. What parts from where it almost touches is seen on both sides or on none,
// wherever the tree opens there.
TEST_CASE("of a cloth folded alike on both sides the same is seen on both") {
  constexpr int n = 9;
  for (const double cell : {1.1 * kThick, 1.5 * kThick}) {
    const ClothDef def{.columns = n, .rows = n, .length = (n - 1) * cell, .width = (n - 1) * cell};
    const std::vector<std::shared_ptr<const ElasticBody>> cloths = {clothOf(def, 0)};
    const Layers layers(cloths);
    std::vector<Vec3> x, way;
    for (const Vec3& p : clothPlaces(def)) {
      const double u = std::abs(p.x()), out = 0.5 * (1.0 + 2e-4) * kThick + 0.1 * (u - cell);
      x.emplace_back(std::copysign(std::min(u, out), p.x()), u, p.z() * (1.0 + 3.0 * u));
      way.emplace_back(0.02 * p.x(), 0.0, 0.02 * p.z());
    }
    const std::set<Key> found = seen(layers, x, way);
    const auto mirrored = [&](const std::function<int(int, int)>& to) {
      std::set<Key> keys;
      for (auto [edges, points] : found) {
        for (int& p : points) p = to(p % n, p / n);
        keys.insert(keyOf(edges, points));
      }
      return keys;
    };
    CHECK_FALSE(found.empty());
    CHECK((mirrored([](int i, int j) { return n * j + n - 1 - i; }) == found));
    CHECK((mirrored([](int i, int j) { return n * (n - 1 - j) + i; }) == found));
  }
}
