#include "render/cover.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

using Eigen::Vector3d;

/// Cells [px] are small enough for this many rows of them to fill the image.
constexpr int kRows = 240;

/// What hides is taken smaller and what is hidden larger by this much [px]: more than a corner is
/// moved by when it is rounded to 1/256 px, and depth to 24 bits.
constexpr double kSlack = 0.25;

}  // namespace

Cover::Cover(const Stage& stage)
    : stage_(stage),
      size_(std::max(1, stage.height / kRows)),
      columns_((stage.width + size_ - 1) / size_),
      rows_((stage.height + size_ - 1) / size_),
      nearness_(static_cast<std::size_t>(columns_) * rows_, 0.0) {}

/// The box around a body, larger by `grow` pixels; nothing if it reaches to the near plane.
std::optional<Cover::SeenBox> Cover::see(const Instance& body, double grow) const {
  const Projection& projection = stage_.projection;
  const Eigen::Quaterniond turn = body.orientation.normalized();
  const double depth = (body.position - projection.eye()).dot(projection.forward());
  const double pixel = projection.pixelAtUnitDepth() * std::max(depth, 0.0);
  const Vector3d half = body.scale.array() + grow * pixel;
  if (half.minCoeff() <= 0.0) return std::nullopt;

  // The cells between its outermost corners.
  Eigen::Array2d low = Eigen::Array2d::Constant(1e9), high = -low;
  for (int i = 0; i < 8; ++i) {
    const Vector3d side(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
    const auto corner = projection.project(body.position + turn * half.cwiseProduct(side));
    if (!corner) return std::nullopt;
    low = low.min(corner->head<2>().array());
    high = high.max(corner->head<2>().array());
  }
  const auto cell = [&](double place, int most) {
    return static_cast<int>(std::floor(std::clamp(place / size_, 0.0, double(most))));
  };
  SeenBox box;
  box.left = cell(low.x(), columns_), box.right = std::min(cell(high.x(), columns_) + 1, columns_);
  box.top = cell(low.y(), rows_), box.bottom = std::min(cell(high.y(), rows_) + 1, rows_);

  // Sight through (x, y) at depth z reaches eye + z (x, y, 1)·rays; in the frame of the body it
  // meets the plane ±axis at  z = (half ∓ eye) / ± (x, y, 1)·rays.
  Eigen::Matrix3d rays;
  rays.col(0) = projection.pixelAtUnitDepth() * projection.right();
  rays.col(1) = -projection.pixelAtUnitDepth() * projection.up();
  rays.col(2) =
      projection.forward() - 0.5 * stage_.width * rays.col(0) - 0.5 * stage_.height * rays.col(1);
  const Eigen::Matrix3d toBody = turn.conjugate().toRotationMatrix(), rays_B = toBody * rays;
  const Vector3d eye_B = toBody * (projection.eye() - body.position);
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double side = face % 2 == 0 ? -1.0 : 1.0, behind = half[axis] - side * eye_B[axis];
    if (behind == 0.0) return std::nullopt;
    box.planes[face] = side / behind * rays_B.row(axis);
    box.front[face] = behind < 0.0;
  }
  return box;
}

void Cover::add(const Instance& body) {
  const std::optional<SeenBox> seen = see(body, -kSlack);
  if (!seen) return;
  const SeenBox& box = *seen;

  // 1/depth where sight enters, at the corners of cells; 0 where it misses.
  const int width = box.right - box.left + 1;
  const auto entry = [&](int column, int row) {
    const Vector3d place(column * size_, row * size_, 1.0);
    double enter = 1e9, leave = 0.0;
    for (int face = 0; face < 6; ++face) {
      const double nearness = box.planes[face].dot(place);
      if (box.front[face])
        enter = std::min(enter, nearness);
      else
        leave = std::max(leave, nearness);
    }
    return enter > leave ? enter : 0.0;
  };
  // A box bulges towards the eye: between corners that it covers it covers all, no farther than
  // at the farthest of them.
  std::vector<double> above(width), below(width);
  for (int row = box.top; row <= box.bottom; ++row, above.swap(below)) {
    for (int i = 0; i < width; ++i) below[i] = entry(box.left + i, row);
    if (row == box.top) continue;
    for (int i = 0; i + 1 < width; ++i) {
      double& cell = nearness_[static_cast<std::size_t>(row - 1) * columns_ + box.left + i];
      cell = std::max(cell, std::min({above[i], above[i + 1], below[i], below[i + 1]}));
    }
  }
}

bool Cover::hides(const SeenBox& box, int face) const {
  // The largest value of a linear function within a cell.
  const auto most = [&](const Vector3d& function, const Vector3d& middle) {
    return function.dot(middle) + 0.5 * size_ * (std::abs(function.x()) + std::abs(function.y()));
  };
  for (int row = box.top; row < box.bottom; ++row) {
    for (int column = box.left; column < box.right; ++column) {
      const Vector3d middle((column + 0.5) * size_, (row + 0.5) * size_, 1.0);
      const Vector3d& plane = box.planes[face];
      if (most(plane, middle) < nearness_[static_cast<std::size_t>(row) * columns_ + column])
        continue;
      // Not hidden here; but is it here at all, between its neighbours?
      bool here = true;
      for (int other = 0; other < 6 && here; ++other) {
        const Vector3d before = box.planes[other] - plane;
        here = most(box.front[other] ? before : Vector3d(-before), middle) >= 0.0;
      }
      if (here) return false;
    }
  }
  return true;
}

Cover::Faces Cover::hiddenFaces(const Instance& body) const {
  const std::optional<SeenBox> box = see(body, kSlack);
  Faces hidden = 0;
  for (int face = 0; box && face < 6; ++face)
    if (!box->front[face] || hides(*box, face)) hidden |= 1u << face;
  return hidden;
}

}  // namespace tumble
