// The kinds of arrays: each says how many copies there are and where they go.
#pragma once

#include <functional>

#include "app/scene/section.h"
#include "sim/method/model.h"

namespace tumble {

/// The ball around a body that fell with a rain; later rain keeps clear of it.
struct Drop {
  Vec3 x;
  double radius;
};

/// What the copies of an array share with other arrays of the scene.
struct Weather {
  std::uint64_t seed = 0;
  Vec3 gravity = Vec3::Zero();  ///< [m/s²]
  std::vector<Drop> drops;
};

struct Generator {
  int count = 0;
  /// Puts copy i, read from the template, in its place; called once per copy, in order. Returns
  /// what is wrong, or "".
  std::function<std::string(int i, BodyDef& copy)> place;
  /// Keys of the template that are this generator's own business.
  std::vector<std::string> reserved;
};

/// Keys of the array are read from the section.
Generator makeRow(Section& array, Weather& weather);
Generator makeTower(Section& array, Weather& weather);
Generator makeWall(Section& array, Weather& weather);
Generator makeRain(Section& array, Weather& weather);
Generator makeFountain(Section& array, Weather& weather);
Generator makeCircle(Section& array, Weather& weather);
Generator makeSpiral(Section& array, Weather& weather);
Generator makeRack(Section& array, Weather& weather);

inline constexpr int kMostCopies = 100'000;

/// The key `count`, which has to be there.
int readCount(Section& array, int most = kMostCopies);

/// The key `along`: a level direction, as a unit vector; X if it is not there.
Vec3 readLevelDirection(Section& array);

/// The rotation about Y that takes X to the unit vector `along` of the ground plane.
Quat turnTo(const Vec3& along);

}  // namespace tumble
