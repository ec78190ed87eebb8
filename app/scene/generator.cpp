// Rows and towers.
#include "app/scene/generator.h"

namespace tumble {

int readCount(Section& array, int most) {
  int count = 0;
  array.read("count", count, 1, most);
  if (!array.find("count")) array.complain("count", "missing");
  return count;
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
  return {count, place, {"position"}};
}

}  // namespace tumble
