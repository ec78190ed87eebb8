// The same scene in other numbers: turned, mirrored, shifted, in another order. It ends as it does,
// and no further off than twins whose start was moved by rounding.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "app/scene/scene.h"
#include "sim/world.h"
#include "tests/catch.h"
#include "tests/problem/problems.h"
#include "tests/stability/random_scene.h"
#include "tests/stability/seen.h"

using namespace tumble;

namespace {

constexpr double kMoved = 1e-14;  // [m] what twins start apart
constexpr int kTwins = 10;
/// [m] what rounding leaves of the numbers of 240 steps at 10 m.
constexpr double kRounding = 1e-12;

struct Way {
  const char* name;
  test::Seen seen;
};

std::vector<Way> waysOf(test::Draw& draw, int count) {
  const double w = draw(-1.0, 1.0), x = draw(-1.0, 1.0), y = draw(-1.0, 1.0), z = draw(-1.0, 1.0);
  const Mat3 turn = Quat(w, x, y, z).normalized().toRotationMatrix();
  std::vector<int> order;
  for (int i = 0; i < count; ++i) order.insert(order.begin() + draw.below(i + 1), i);
  const Mat3 mirror = Vec3(1.0, 1.0, -1.0).asDiagonal();
  return {{"turned", {.turn = turn}},
          {"mirrored", {.turn = mirror}},
          {"shifted", {.shift = {10.0, 10.0, 10.0}}},
          {"permuted", {.order = order}}};
}

/// How a scene ends.
struct End {
  bool stopped = false;
  std::vector<BodySample> bodies;  ///< in the order and the numbers of the scene
};

End endOf(const WorldDef& def, const test::Seen& seen = {}) {
  World world(test::seenFrom(seen, def));
  world.advance(def.duration);
  End end{.stopped = world.report().stopped, .bodies = {}};
  if (end.stopped) return end;
  const Sample last = world.sample(def.duration);
  end.bodies.resize(last.bodies.size());
  for (std::size_t i = 0; i < last.bodies.size(); ++i)
    end.bodies[static_cast<std::size_t>(seen.bodyAt(static_cast<int>(i)))] =
        test::asItIs(seen, last.bodies[i]);
  return end;
}

/// The farthest [m] that a body, or a point 0.1 m from its centre, is from where it is otherwise.
double apart(const WorldDef& def, const End& p, const End& q) {
  constexpr double kArm = 0.1;
  double most = 0.0;
  if (p.stopped || q.stopped) return p.stopped == q.stopped ? 0.0 : 1e9;
  for (std::size_t i = 0; i < p.bodies.size(); ++i) {
    if (def.bodies[i].fixed) continue;
    const double turn = p.bodies[i].q.angularDistance(q.bodies[i].q);
    most = std::max(most, (p.bodies[i].x - q.bodies[i].x).norm() + kArm * turn);
  }
  return most;
}

/// The farthest that twins are from each other.
double apartTwins(const WorldDef& def, const End& end, test::Draw& draw) {
  std::vector<End> ends = {end};
  for (int k = 0; k < kTwins; ++k) {
    WorldDef twin = def;
    for (BodyDef& body : twin.bodies) {
      if (body.fixed) continue;
      const double x = draw(-1.0, 1.0), y = draw(-1.0, 1.0), z = draw(-1.0, 1.0);
      body.position += kMoved * Vec3(x, y, z).normalized();
    }
    ends.push_back(endOf(twin));
  }
  double most = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) most = std::max(most, apart(def, ends[i], ends[k]));
  return most;
}

/// Scenes by how far apart they end, beside their twins: the k-th entry up to 10^k times as far.
struct Histogram {
  std::map<std::string, std::array<int, 7>> ways;
  std::vector<std::string> farthest;  ///< words on those beyond

  void add(const char* way, std::uint64_t seed, double off, double twins) {
    const double share = off / std::max(twins, kRounding);
    const int bin = std::clamp(static_cast<int>(std::ceil(std::log10(share + 1e-300))), 0, 6);
    ++ways[way][static_cast<std::size_t>(bin)];
    if (bin < 1) return;
    char words[160];
    std::snprintf(words, sizeof words, "seed %llu %s: %.1e m, twins %.1e m",
                  static_cast<unsigned long long>(seed), way, off, twins);
    farthest.push_back(words);
  }

  /// Scenes that end more than 100 times as far apart as their twins, or another power of ten.
  int beyond(const std::string& way, int power = 2) const {
    const std::array<int, 7>& counts = ways.at(way);
    return std::accumulate(counts.begin() + power + 1, counts.end(), 0);
  }

  void print() const {
    std::printf("%-10s %7s %7s %7s %7s %7s %7s %7s\n", "times", "1", "10", "1e2", "1e3", "1e4",
                "1e5", "more");
    for (const auto& [way, counts] : ways) {
      std::printf("%-10s", way.c_str());
      for (const int count : counts) std::printf(" %7d", count);
      std::printf("\n");
    }
    for (const std::string& words : farthest) std::printf("  %s\n", words.c_str());
    std::fflush(stdout);
  }
};

std::vector<std::uint64_t> seedsFrom(std::uint64_t first, int count) {
  std::vector<std::uint64_t> seeds(static_cast<std::size_t>(count));
  std::iota(seeds.begin(), seeds.end(), first);
  return seeds;
}

Histogram lookFromElsewhere(const std::string& method, const std::vector<std::uint64_t>& seeds) {
  Histogram histogram;
  for (const std::uint64_t seed : seeds) {
    const WorldDef def = parseScene(test::randomScene(seed), "seed " + std::to_string(seed),
                                    {"world.method=" + method})
                             .world;
    test::Draw draw(seed);
    const End end = endOf(def);
    const double twins = apartTwins(def, end, draw);
    for (const Way& way : waysOf(draw, static_cast<int>(def.bodies.size())))
      histogram.add(way.name, seed, apart(def, end, endOf(def, way.seen)), twins);
  }
  histogram.print();
  return histogram;
}

void requireAlike(const Histogram& found) {
  for (const char* way : {"mirrored", "permuted", "shifted", "turned"}) {
    CAPTURE(way);
    CHECK(found.beyond(way) == 0);
  }
}

}  // namespace

// Oracle: the same scene. Mirrored, permuted and shifted it ends as far off as twins do, or as much
// as rounding leaves. Turned, boxes of other bodies meet: what is near a hit in one frame may not
// be so in another, and its step is then divided there alone, an error of first order that some
// scenes show.
TEST_CASE("random scenes end alike from wherever they are seen") {
  requireAlike(lookFromElsewhere("stepping", seedsFrom(1, 12)));
}

// A face level with a disk to 1e-6 (124), a chain beside what it does not touch (219, 664), a
// spring (673), a contact at rest by rounding, to which a blow runs on (761): each ended
// millimetres aside from one of the places that it was seen from. A face that lands with some of
// its corners in touch, whose gaps were closed in times of their own, so that rounding told which
// corner was left out (479, 712); the inner corner of two boxes side by side, which rounding took
// out of its face (28, 277, 800): 10 m aside they ended up to 5 mm elsewhere.
// Contacts that a plane hid by the place of its body (13, 643), gaps that rounded by the place of
// the scene at each of many hits that get slower and slower (461): up to 14 mm.
TEST_CASE("scenes whose end an order, a frame or rounding could choose end alike") {
  requireAlike(lookFromElsewhere("stepping",
                                 {13, 28, 124, 219, 277, 461, 479, 643, 664, 673, 712, 761, 800}));
}

// Measured: 1 permuted and 10 turned end more than 100 times as far apart.
TEST_CASE("a thousand random scenes end alike from wherever they are seen", "[long]") {
  constexpr int kScenes = 1000;
  const Histogram found = lookFromElsewhere("stepping", seedsFrom(1, kScenes));
  CHECK(found.beyond("permuted") <= kScenes / 200);
  CHECK(found.beyond("mirrored") == 0);
  CHECK(found.beyond("shifted") == 0);
  CHECK(found.beyond("turned") <= kScenes / 50);
}
