// A wall of boxes in running bond.
#include <cmath>

#include "app/scene/generator.h"

namespace tumble {

namespace {

// The rotation about Y that takes X to the unit vector `along` of the ground plane. Half angles by
// square roots, from the larger of sine and cosine.
Quat turnTo(const Vec3& along) {
  const double c = along.x(), s = -along.z();
  if (c >= 0.0) {
    const double w = std::sqrt(0.5 * (1.0 + c));
    return Quat(w, 0.0, 0.5 * s / w, 0.0);
  }
  const double y = std::sqrt(0.5 * (1.0 - c));
  return Quat(0.5 * s / y, 0.0, y, 0.0);
}

struct Wall {
  int rows = 1, columns = 1;
  Vec3 base = Vec3::Zero(), along = Vec3::UnitX();
  int row = 0, brick = 0;    // of the next copy
  std::optional<Vec3> half;  // [m] of every whole brick

  // Bricks of even rows stand in columns. Odd rows are shifted by half a brick and have half a
  // brick at each end, so that every brick rests on two.
  std::string place(BodyDef& copy) {
    Box* box = std::get_if<Box>(&copy.shape);
    if (!box) return "a wall is made of boxes";
    if (half && *half != box->half) return "all bricks of a wall have one size";
    half = box->half;
    const double length = 2.0 * box->half.x(), height = 2.0 * box->half.y();
    const bool odd = row % 2 == 1;
    const int last = odd ? columns : columns - 1;
    double middle = odd ? brick : brick + 0.5;  // in lengths, from the left end
    if (odd && (brick == 0 || brick == last)) {
      middle = brick == 0 ? 0.25 : columns - 0.25;
      box->half.x() *= 0.5;
      if (copy.mass) *copy.mass *= 0.5;
    }
    copy.orientation = turnTo(along);
    copy.position = base + along * ((middle - 0.5 * columns) * length);
    copy.position.y() += (row + 0.5) * height;
    if (brick++ == last) {
      brick = 0;
      ++row;
    }
    return "";
  }
};

}  // namespace

Generator makeWall(Section& array, Weather&) {
  Wall wall;
  array.read("rows", wall.rows, 1, kMostCopies);
  array.read("columns", wall.columns, 1, kMostCopies);
  for (const char* key : {"rows", "columns"})
    if (!array.find(key)) array.complain(key, "missing");
  array.read("base", wall.base, any("m"));
  array.read("along", wall.along, any({}));
  const double length = wall.along.stableNorm();
  if (length < 1e-9 || wall.along.y() != 0.0)
    array.complain("along", "expected a level direction, [x, 0, z], that is not zero");
  wall.along /= length;

  const long count = static_cast<long>(wall.rows) * wall.columns + wall.rows / 2;
  if (count > kMostCopies) array.complain("rows", "a wall of more than 100000 bricks");
  const auto place = [wall](int, BodyDef& copy) mutable { return wall.place(copy); };
  return {static_cast<int>(std::min<long>(count, kMostCopies)),
          place,
          {"position", "orientation", "inertia"}};
}

}  // namespace tumble
