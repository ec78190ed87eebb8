// Labels that lay themselves out.
#include "render/label_places.h"

#include <cmath>

#include "tests/catch.h"
#include "tests/render/studio.h"

using namespace tumble;
using Eigen::Vector2d;

namespace {

// So many labels of 90 px about one point.
std::vector<Eigen::AlignedBox2d> laidOut(int count, const Vector2d& anchor, int& leaders) {
  LabelPlaces places({1280.0, 720.0});
  std::vector<Eigen::AlignedBox2d> boxes;
  for (int i = 0; i < count; ++i) {
    Label label;
    label.offset = {8.0, 5.0};
    const LabelPlaces::Standing place =
        places.place(label, anchor + Vector2d(3.0 * (i % 7), 2.0 * (i % 5)), 90.0).value();
    leaders += place.leader.has_value();
    boxes.push_back(inkOf(place.pen, 90.0, label.size, label.align));
  }
  return boxes;
}

// Straight at the origin from 10 m, 720 px high; 100 px for a metre there.
const Projection kAhead({{0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, 2.0 * std::atan(0.36) * 180.0 / M_PI},
                        1280.0, 720.0);

Instance boxAt(const Eigen::Vector3d& position, const Eigen::Vector3d& half) {
  Instance box;
  box.position = position;
  box.scale = half;
  return box;
}

// The name of a body, right of it.
Label nameOf(const Instance& body) {
  Label label;
  label.anchor = body.position + Eigen::Vector3d(body.scale.x(), 0.0, 0.0);
  label.offset = {8.0, 5.0};
  label.apart = true;
  label.names = body.position;
  return label;
}

std::optional<Eigen::AlignedBox2d> inkBy(LabelPlaces& places, const Label& label, double width) {
  const Vector2d anchor = kAhead.project(*label.anchor)->head<2>();
  const std::optional<LabelPlaces::Standing> place = places.place(label, anchor, width);
  if (!place) return {};
  return inkOf(place->pen, width, label.size, label.align);
}

}  // namespace

TEST_CASE("44 names in one place all have room on the page, none on another") {
  for (const Vector2d& anchor : {Vector2d(640.0, 360.0), Vector2d(60.0, 700.0)}) {
    int leaders = 0;
    const auto boxes = laidOut(44, anchor, leaders);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      CAPTURE(i);
      CHECK(Eigen::AlignedBox2d(Vector2d(0.0, 0.0), Vector2d(1280.0, 720.0)).contains(boxes[i]));
      for (std::size_t k = 0; k < i; ++k) CHECK(!boxes[k].intersects(boxes[i]));
    }
    CHECK(leaders > 30);
  }
}

TEST_CASE("what is crossed by an arrow keeps off labels that stand apart, and no others") {
  LabelPlaces places({1280.0, 720.0});
  const Eigen::AlignedBox2d arrow(Vector2d(100.0, 80.0), Vector2d(300.0, 120.0));
  places.cross(arrow);
  Label label;
  label.offset = {8.0, 5.0};
  label.apart = true;
  const Vector2d pen = places.place(label, {100.0, 100.0}, 90.0)->pen;
  CHECK(!inkOf(pen, 90.0, label.size, label.align).intersects(arrow));
  label.apart = false;
  CHECK(places.place(label, {100.0, 100.0}, 90.0)->pen == Vector2d(108.0, 105.0));
}

TEST_CASE("what keeps off arrows alone stands on bodies") {
  LabelPlaces places({1280.0, 720.0});
  const Instance box = boxAt({0.0, 0.0, 0.0}, {0.8, 0.8, 0.2});
  places.cover(*silhouetteOf(box, kAhead));
  const Eigen::AlignedBox2d arrow(Vector2d(630.0, 300.0), Vector2d(650.0, 420.0));
  places.cross(arrow);
  Label label;
  label.offset = {0.0, 5.0};
  label.clear = true;
  const std::optional<LabelPlaces::Standing> place = places.place(label, {640.0, 360.0}, 40.0);
  const Eigen::AlignedBox2d ink = inkOf(place->pen, 40.0, label.size, label.align);
  CHECK(!ink.intersects(arrow));
  CHECK(silhouetteOf(box, kAhead)->contains(ink));
}

// A board that takes 17 % of the page; right of it a wall of bricks leaves no room.
TEST_CASE("the name of a large body stands off it or on it, never across its outline") {
  const Instance board = boxAt({0.0, 0.0, 0.0}, {2.0, 1.0, 0.1});
  const Silhouette outline = *silhouetteOf(board, kAhead);
  const bool walled = GENERATE(false, true);
  LabelPlaces places({1280.0, 720.0});
  places.cover(outline);
  for (int row = -12; walled && row <= 12; ++row)
    places.cover(*silhouetteOf(boxAt({3.2, 0.3 * row, 0.0}, {1.15, 0.15, 0.1}), kAhead));
  Label label = nameOf(board);
  label.offset.x() = -10.0;  // where it wants to be is across
  const std::optional<Eigen::AlignedBox2d> ink = inkBy(places, label, 60.0);
  REQUIRE(ink);
  CHECK((!outline.meets(*ink) || outline.contains(*ink)));
  CHECK(outline.contains(*ink) == walled);
}

TEST_CASE("a label that stands alone stays where it wants to be, without a line to it") {
  LabelPlaces places({1280.0, 720.0});
  Label label;
  label.offset = {8.0, 5.0};
  const LabelPlaces::Standing place = places.place(label, {100.0, 100.0}, 90.0).value();
  CHECK(place.pen == Vector2d(108.0, 105.0));
  CHECK(!place.leader);
}

TEST_CASE("a text beside a body keeps off its neighbour where there is room") {
  LabelPlaces places({1280.0, 720.0});
  const Instance one = boxAt({0.0, 0.0, 0.0}, {0.2, 0.2, 0.2});
  const Silhouette neighbour = *silhouetteOf(boxAt({0.6, 0.0, 0.0}, {0.3, 0.3, 0.3}), kAhead);
  places.cover(*silhouetteOf(one, kAhead));
  places.cover(neighbour);
  Label label = nameOf(one);
  label.names.reset();
  const std::optional<Eigen::AlignedBox2d> ink = inkBy(places, label, 60.0);
  REQUIRE(ink);
  CHECK(!neighbour.meets(*ink));
  // What says where it wants to be stands there.
  label.apart = false;
  const std::optional<Eigen::AlignedBox2d> wanted = inkBy(places, label, 60.0);
  CHECK(neighbour.meets(*wanted));
}

// A wall of bricks, as wide as the page: nowhere near is free.
TEST_CASE("in a crowd a name stands on its body if that is large enough, else it does not stand") {
  LabelPlaces places({1280.0, 720.0});
  std::vector<Instance> wall;
  for (int row = -8; row <= 8; ++row)
    for (int column = -8; column <= 8; ++column)
      wall.push_back(boxAt({0.9 * column, 0.3 * row, 0.0}, {0.45, 0.15, 0.1}));
  const Instance hidden = boxAt({0.0, 0.0, -2.0}, {0.1, 0.1, 0.1});
  for (const Instance& brick : wall) places.cover(*silhouetteOf(brick, kAhead));
  places.cover(*silhouetteOf(hidden, kAhead));
  const Silhouette own = *silhouetteOf(wall[8 * 17 + 8], kAhead);
  const std::optional<Eigen::AlignedBox2d> ink = inkBy(places, nameOf(wall[8 * 17 + 8]), 60.0);
  REQUIRE(ink);
  CHECK(own.contains(*ink));
  CHECK(!inkBy(places, nameOf(wall[7 * 17 + 8]), 200.0));
  CHECK(!inkBy(places, nameOf(hidden), 20.0));
}

// The ring is in the middle of the page; two lines of words stand 49 and 67 px below it.
TEST_CASE("words of two marks near each other stand below one another") {
  const auto inkBelow = [](const std::vector<Mark>& marks, int y0, int y1) {
    Picture picture;
    picture.camera = straight(0.0);
    picture.floor.visible = false;
    picture.marks = marks;
    const Image image = studio().draw(picture, kFull);
    int ink = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = 560; x < 720; ++x) ink += brightness(image, x, y) < 120.0;
    return ink;
  };
  const Mark one{{0.0, 0.0, 0.0}, {"t = 0.10 s", "j = 1 N s"}};
  const Mark near{{0.05, 0.0, 0.0}, {"t = 0.20 s", "j = 2 N s"}}, far{{3.0, 0.0, 0.0}, near.lines};
  CHECK(inkBelow({one}, 396, 430) > 100);
  CHECK(inkBelow({one, far}, 434, 466) == 0);
  CHECK(inkBelow({one, near}, 434, 466) > 100);
  CHECK(inkBelow({one, near}, 396, 430) < inkBelow({one}, 396, 430) + 100);
}
