// Labels that lay themselves out.
#include "render/label_places.h"

#include "tests/catch.h"

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
        places.place(label, anchor + Vector2d(3.0 * (i % 7), 2.0 * (i % 5)), 90.0);
    leaders += place.leader.has_value();
    boxes.push_back(inkOf(place.pen, 90.0, label.size, label.align));
  }
  return boxes;
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
  const Vector2d pen = places.place(label, {100.0, 100.0}, 90.0).pen;
  CHECK(!inkOf(pen, 90.0, label.size, label.align).intersects(arrow));
  label.apart = false;
  CHECK(places.place(label, {100.0, 100.0}, 90.0).pen == Vector2d(108.0, 105.0));
}

TEST_CASE("a label that stands alone stays where it wants to be, without a line to it") {
  LabelPlaces places({1280.0, 720.0});
  Label label;
  label.offset = {8.0, 5.0};
  const LabelPlaces::Standing place = places.place(label, {100.0, 100.0}, 90.0);
  CHECK(place.pen == Vector2d(108.0, 105.0));
  CHECK(!place.leader);
}
