// Cloth that passes through cloth, and how often.
#include "sim/world.h"
#include "tests/catch.h"
#include "tests/world/bent_bodies.h"

using namespace tumble;

namespace {

/// A strip of so many rows, bent along u as a ribbon that comes back and goes down through itself,
/// each column 0.1 further along its rows.
WorldDef ribbon(int rows, const Quat& turned) {
  const ClothDef strip{.columns = 5, .rows = rows, .stretch = 0.0, .shear = 0.0, .bend = 1e-9};
  const double x[5] = {0.0, 2.0, 2.0, 1.0, 1.0}, y[5] = {0.0, 0.0, 1.0, 1.0, -1.0};
  WorldDef def;
  def.gravity.setZero();
  def.duration = 1e-3;
  def.stepping.step = 1e-3;
  const int first = addCloth(def, strip, Vec3::Zero(), 0.0);
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < 5; ++k)
      def.bodies[first + clothPoint(strip, k, row)].position =
          turned * Vec3(x[k], y[k], row + 0.1 * k);
  return def;
}

long crossingsOf(const WorldDef& def) {
  World world(def);
  world.advance(def.duration);
  REQUIRE_FALSE(world.report().stopped);
  return world.report().certificate.cloth_crossings;
}

}  // namespace

// Oracle: counted by hand. The last column's pieces go through the first's at the middles of both,
// 0.3 further on: of each, every row but one and every diagonal passes through the other, four for
// each cell between rows, however it is turned.
TEST_CASE("edges of a cloth that pass through it are counted to the last") {
  for (const int rows : {2, 3, 8})
    for (const Quat& turned : {Quat::Identity(), Quat(0.3, -0.5, 0.7, 0.2).normalized()})
      CHECK(crossingsOf(ribbon(rows, turned)) == 4 * (rows - 1));
}

// Oracle: counted by hand. Of two squares that part each other along a line an edge at its end and
// a diagonal of each go through the other; where both lie in one plane nothing does.
TEST_CASE("cloths pass through each other, or only touch") {
  const ClothDef cloth{.columns = 2, .rows = 3, .length = 2.0, .width = 2.0};
  const auto pair = [&](const Quat& turned, const Vec3& at) {
    WorldDef def;
    def.gravity.setZero();
    def.duration = 1e-3;
    def.stepping.step = 1e-3;
    addCloth(def, cloth, Vec3::Zero(), 0.0);
    const int second = addCloth(def, cloth, Vec3::Zero(), 0.0);
    for (std::size_t i = second; i < def.bodies.size(); ++i)
      def.bodies[i].position = at + turned * def.bodies[i].position;
    return def;
  };
  const Quat upright(Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitX()));
  CHECK(crossingsOf(pair(Quat::Identity(), {0.3, 0.0, 0.2})) == 0);
  CHECK(crossingsOf(pair(Quat::Identity(), {0.3, 0.1, 0.2})) == 0);
  CHECK(crossingsOf(pair(upright, {0.3, 0.45, 0.2})) == 4);
}
