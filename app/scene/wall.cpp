// A wall of boxes in running bond.
#include "app/scene/generator.h"

namespace tumble {

namespace {

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
  wall.along = readLevelDirection(array);

  const long count = static_cast<long>(wall.rows) * wall.columns + wall.rows / 2;
  if (count > kMostCopies) array.complain("rows", "a wall of more than 100000 bricks");
  const auto place = [wall](int, BodyDef& copy) mutable { return wall.place(copy); };
  return {static_cast<int>(std::min<long>(count, kMostCopies)),
          place,
          {"position", "origin", "orientation", "inertia"}};
}

}  // namespace tumble
