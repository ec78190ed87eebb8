#include "render/label_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tumble {

using Eigen::Vector2d;

Eigen::AlignedBox2d inkOf(const Vector2d& pen, double width, double size, Align align) {
  const double left = align == Align::Left ? 0.0 : align == Align::Centre ? -0.5 * width : -width;
  return {pen + Vector2d(left, -0.7 * size), pen + Vector2d(left + width, 0.1 * size)};
}

bool LabelPlaces::isFree(const Box& ink, bool apart) const {
  const auto meets = [&](const Box& other) { return other.intersects(ink); };
  return std::none_of(taken_.begin(), taken_.end(), meets) &&
         (!apart || std::none_of(crossed_.begin(), crossed_.end(), meets));
}

LabelPlaces::Standing LabelPlaces::place(const Label& label, const Vector2d& anchor, double width) {
  const Vector2d wanted = anchor + label.offset;
  const Box page(Vector2d::Zero(), page_);
  for (const double lines : {0.0, -1.0, 1.0, -2.0, 2.0}) {
    const Vector2d pen = wanted + Vector2d(0.0, lines * label.size);
    const Box ink = inkOf(pen, width, label.size, label.align);
    if (!isFree(ink, label.apart) || (lines != 0.0 && !page.contains(ink))) continue;
    take(ink);
    return {pen};
  }
  return onRings(label, anchor, width).value_or(Standing{wanted});
}

// To the right of the anchor first, then alternately above and below.
std::optional<LabelPlaces::Standing> LabelPlaces::onRings(const Label& label,
                                                          const Vector2d& anchor, double width) {
  constexpr int kRings = 16, kDirections = 32;
  constexpr double kEdge = 6.0, kRoom = 3.0;  // [px] of the page's edge, between labels
  const Vector2d edge = Vector2d::Constant(kEdge);
  const Box page(edge, Vector2d(page_ - edge));
  for (int ring = 1; ring <= kRings; ++ring) {
    for (int n = 0; n < kDirections; ++n) {
      const double angle =
          (n % 2 == 0 ? 1 : -1) * ((n + 1) / 2) * 2.0 * std::numbers::pi / kDirections;
      const Vector2d way(std::cos(angle), -std::sin(angle));
      const Vector2d side = anchor + 2.2 * ring * label.size * way;
      // The edge of the text that looks at the anchor.
      const double left = way.x() > 0.2 ? 0.0 : way.x() < -0.2 ? -width : -0.5 * width;
      const Vector2d pen = side + Vector2d(left, 0.35 * label.size);
      Box ink = inkOf(pen, width, label.size, Align::Left);
      if (!page.contains(ink)) continue;
      ink.min() -= Vector2d::Constant(kRoom), ink.max() += Vector2d::Constant(kRoom);
      if (!isFree(ink, label.apart)) continue;
      take(ink);
      const double shift = label.align == Align::Left     ? 0.0
                           : label.align == Align::Centre ? 0.5 * width
                                                          : width;
      const Vector2d end = anchor.cwiseMax(ink.min()).cwiseMin(ink.max());
      return Standing{pen + Vector2d(shift, 0.0), end};
    }
  }
  return {};
}

}  // namespace tumble
