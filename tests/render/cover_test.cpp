// Faces that are not drawn, because nobody could see them.
#include "render/cover.h"

#include <map>

#include "tests/render/plates.h"
#include "tests/render/studio.h"

using namespace tumble;
using Eigen::Vector3d;

namespace {

struct Hit {
  std::size_t body = 0;
  int face = 0;
  double distance = 1e9;
};

/// The face of a box at which sight along `ray` from `eye` enters it.
void meet(const std::vector<Instance>& boxes, std::size_t index, const Vector3d& eye,
          const Vector3d& ray, Hit& nearest) {
  const Instance& box = boxes[index];
  const Vector3d from = box.orientation.conjugate() * (eye - box.position);
  const Vector3d along = box.orientation.conjugate() * ray;
  double enter = -1e9, leave = 1e9;
  int face = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double side = along[axis] > 0.0 ? -1.0 : 1.0, half = box.scale[axis];
    const double in = (side * half - from[axis]) / along[axis];
    if (in > enter) enter = in, face = 2 * axis + (side > 0.0);
    leave = std::min(leave, (-side * half - from[axis]) / along[axis]);
  }
  if (enter < leave && enter < nearest.distance) nearest = {index, face, enter};
}

std::vector<Instance> boxesOf(const Picture& picture) {
  std::vector<Instance> boxes;
  for (const Instance& body : picture.instances)
    if (body.form == Form::Box) boxes.push_back(body);
  return boxes;
}

}  // namespace

// Oracle: lines of sight through 4 by 4 points of each pixel; the face that one of them meets first
// is visible. Of the 960 faces of a heap they meet 308; 98 of the 167 others that face the
// eye are found.
TEST_CASE("no face that a line of sight meets first is taken for hidden") {
  Picture picture = plates::pile(200);
  picture.instances = boxesOf(picture);
  RenderOptions options;
  options.width = 320, options.height = 180;
  const Stage stage(picture, options);
  Cover cover(stage);
  for (const Instance& box : picture.instances) cover.add(box);

  const Projection& p = stage.projection;
  std::map<std::pair<std::size_t, int>, int> seen;
  for (int y = 0; y < 4 * stage.height; ++y) {
    for (int x = 0; x < 4 * stage.width; ++x) {
      const double right = (x + 0.5) / 4.0 - 0.5 * stage.width;
      const double up = 0.5 * stage.height - (y + 0.5) / 4.0;
      const Vector3d ray = p.forward() + p.pixelAtUnitDepth() * (right * p.right() + up * p.up());
      Hit hit;
      for (std::size_t i = 0; i < picture.instances.size(); ++i)
        meet(picture.instances, i, p.eye(), ray, hit);
      if (hit.distance < 1e9) ++seen[{hit.body, hit.face}];
    }
  }
  int facing = 0, found = 0;
  for (std::size_t i = 0; i < picture.instances.size(); ++i) {
    const Cover::Faces hidden = cover.hiddenFaces(picture.instances[i]);
    for (int face = 0; face < 6; ++face) {
      const Instance& box = picture.instances[i];
      Vector3d normal_B = Vector3d::Zero();
      normal_B[face / 2] = face % 2 == 0 ? -1.0 : 1.0;
      const Vector3d normal = box.orientation * normal_B;
      const Vector3d middle = box.position + box.orientation * box.scale.cwiseProduct(normal_B);
      const bool faces = normal.dot(p.eye() - middle) > 0.0, hides = (hidden >> face & 1) == 1;
      if (seen.count({i, face}) == 0) {
        facing += faces;
        found += faces && hides;
        continue;
      }
      INFO("box " << i << ", face " << face);
      CHECK_FALSE(hides);
    }
  }
  CAPTURE(facing, found, seen.size());
  CHECK(found > facing / 2);
}

// What stands behind a wall is hidden whole; the wall is not, nor what looks over it by a pixel.
TEST_CASE("a wall hides what stands behind it and not what looks over it") {
  Picture picture;
  picture.camera = straight(0.0);
  const Stage stage(picture, {});
  Cover cover(stage);
  Instance wall, behind;
  wall.scale = {1.0, 1.0, 0.1};
  behind.position = {0.0, 0.0, -1.0};
  behind.scale = {0.5, 0.5, 0.5};
  CHECK(cover.hiddenFaces(behind) != Cover::kAll);
  cover.add(wall);
  CHECK(cover.hiddenFaces(behind) == Cover::kAll);
  CHECK(cover.hiddenFaces(wall) == (Cover::kAll & ~(1u << 5)));  // all but the one at +z
  // Its upper edge at the front, 10.5 m from the eye, is seen over that of the wall, 9.9 m from it.
  behind.scale.y() = 10.5 / 9.9 + 0.02;
  CHECK(cover.hiddenFaces(behind) != Cover::kAll);
  // A body before the wall is in full view.
  behind.scale.y() = 0.5;
  behind.position.z() = 1.0;
  CHECK((cover.hiddenFaces(behind) >> 5 & 1) == 0);
}
