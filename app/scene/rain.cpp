// Bodies at random places that do not touch each other.
#include "app/scene/generator.h"
#include "app/scene/random.h"

namespace tumble {

namespace {

constexpr int kMostDrops = 20'000;                // each new one is held against all before
constexpr long kMostComparisons = 1'000'000'000;  // of two balls, for one rain
constexpr int kMostTries = 2'000;                 // for one body

struct Rain {
  Vec3 lo = Vec3::Zero(), hi = Vec3::Zero();
  Random random;
  Weather* weather;
  long comparisons = 0;

  bool isFree(const Drop& drop) {
    for (const Drop& other : weather->drops) {
      ++comparisons;
      const double reach = drop.radius + other.radius;
      if ((drop.x - other.x).squaredNorm() < reach * reach) return false;
    }
    return true;
  }

  // Tries places until the ball around the body is clear of all balls before it.
  std::string place(int i, BodyDef& copy) {
    const double radius = boundingRadius(copy.shape);
    if (std::get_if<HalfSpace>(&copy.shape)) return "rain is made of bodies, not of planes";
    copy.orientation = random.orientation();
    for (int tries = 0; tries < kMostTries && comparisons < kMostComparisons; ++tries) {
      const Drop drop{random.inBox(lo, hi), radius};
      if (!isFree(drop)) continue;
      weather->drops.push_back(drop);
      copy.position = drop.x;
      return "";
    }
    return "no room for copy " + std::to_string(i) +
           " between lo and hi; ask for fewer or for more room";
  }
};

}  // namespace

Generator makeRain(Section& array, Weather& weather) {
  const int count = readCount(array, kMostDrops);
  std::string name;
  array.read("name", name);
  Rain rain{Vec3::Zero(), Vec3::Zero(), Random(weather.seed, name), &weather};
  for (const char* key : {"lo", "hi"})
    if (!array.find(key)) array.complain(key, "missing");
  array.read("lo", rain.lo, any("m"));
  array.read("hi", rain.hi, any("m"));
  if ((rain.lo.array() > rain.hi.array()).any())
    array.complain("hi", "expected no coordinate below that of lo");
  const auto place = [rain](int i, BodyDef& copy) mutable { return rain.place(i, copy); };
  return {count, place, {"position", "origin", "orientation"}};
}

}  // namespace tumble
