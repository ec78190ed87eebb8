// What arrays share; rows and towers.
#include "app/scene/generator.h"

#include <cmath>

namespace tumble {

int readCount(Section& array, int most) {
  int count = 0;
  array.read("count", count, 1, most);
  if (!array.find("count")) array.complain("count", "missing");
  return count;
}

Vec3 readLevelDirection(Section& array) {
  Vec3 along = Vec3::UnitX();
  array.read("along", along, any({}));
  const double length = along.stableNorm();
  if (length < 1e-9 || along.y() != 0.0)
    array.complain("along", "expected a level direction, [x, 0, z], that is not zero");
  return along / length;
}

// Half angles by square roots, from the larger of sine and cosine.
Quat turnTo(const Vec3& along) {
  const double c = along.x(), s = -along.z();
  if (c >= 0.0) {
    const double w = std::sqrt(0.5 * (1.0 + c));
    return Quat(w, 0.0, 0.5 * s / w, 0.0);
  }
  const double y = std::sqrt(0.5 * (1.0 - c));
  return Quat(0.5 * s / y, 0.0, y, 0.0);
}

Generator makeRow(Section& array, Weather&) {
  const int count = readCount(array);
  Vec3 step = Vec3::Zero();
  array.read("step", step, any("m"));
  const auto place = [step](int i, BodyDef& copy) -> std::string {
    if (std::get_if<HalfSpace>(&copy.shape)) return "a row is made of bodies, not of planes";
    copy.position += step * static_cast<double>(i);
    return "";
  };
  return {count, place, {}};
}

Generator makeTower(Section& array, Weather&) {
  const int count = readCount(array);
  Vec3 base = Vec3::Zero();
  array.read("base", base, any("m"));
  double height = 0.0;
  const auto place = [base, height](int, BodyDef& copy) mutable -> std::string {
    if (std::get_if<HalfSpace>(&copy.shape)) return "a tower is made of bodies, not of planes";
    // All shapes are symmetric about their centres: the reach upward is the reach downward.
    const double reach = boundingBox(copy.shape, {Vec3::Zero(), copy.orientation}).hi.y();
    copy.position = base + Vec3(0.0, height + reach, 0.0);
    height += 2.0 * reach;
    return "";
  };
  return {count, place, {"position", "origin"}};
}

}  // namespace tumble
