// Chapter 2, shape: what a tree of half-spaces tells is what all of them tell, one by one.
#include "sim/shape/plane_tree.h"

#include <algorithm>
#include <random>

#include "tests/catch.h"

using namespace tumble;

namespace {

/// Tangent planes of a ball, and of one of half its size beside it.
std::vector<HalfSpace> tangents(int count, std::mt19937& random) {
  std::normal_distribution<double> draw;
  std::vector<HalfSpace> planes;
  for (int k = 0; k < count; ++k) {
    const double x = draw(random), y = draw(random), z = draw(random);
    const Vec3 n = Vec3(x, y, z).normalized();
    planes.push_back(k % 3 == 0 ? HalfSpace{n, 0.5 + n.x()} : HalfSpace{n, 1.0});
  }
  return planes;
}

Vec3 somewhere(std::mt19937& random) {
  std::uniform_real_distribution<double> draw(-1.5, 1.5);
  const double x = draw(random), y = draw(random), z = draw(random);
  return {x, y, z};
}

}  // namespace

// Oracle: all planes, one after the other, to the bit.
TEST_CASE("a tree of planes tells what all of them do, and looks at few") {
  std::mt19937 random(5);
  for (const int count : {1, 4, 5, 300}) {
    const std::vector<HalfSpace> planes = tangents(count, random);
    const PlaneTree tree(planes);
    for (int k = 0; k < 300; ++k) {
      const Vec3 p = somewhere(random);
      std::vector<int> expected, found;
      bool over = false;
      for (int i = 0; i < count; ++i) {
        const HalfSpace& plane = planes[static_cast<std::size_t>(i)];
        const double height = plane.n.dot(p) - plane.d;
        if (height > -0.1) expected.push_back(i);
        over = over || height > 0.05 * plane.n.lpNorm<1>();
      }
      tree.above(p, -0.1, found);
      CHECK(found == expected);
      CHECK(tree.isOver(p, 0.05) == over);
    }
  }
  // Of the 10,000 tangents of a ball those over a point just outside. Measured 295 looks.
  std::vector<HalfSpace> planes = tangents(10'000, random);
  for (HalfSpace& plane : planes) plane.d = 1.0;
  const PlaneTree tree(planes);
  std::vector<int> found;
  tree.above(1.0001 * planes[0].n, 0.0, found);
  WARN("planes over a point: measured " << found.size() << ", with " << tree.looks() << " looks");
  CHECK(std::find(found.begin(), found.end(), 0) != found.end());
  CHECK(tree.looks() < 1000);
}
