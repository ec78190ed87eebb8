#include "render/label_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace tumble {

using Eigen::Vector2d;

Eigen::AlignedBox2d inkOf(const Vector2d& pen, const LabelPlaces::Extent& text, double size,
                          Align align) {
  const double width = text.width;
  const double left = align == Align::Left ? 0.0 : align == Align::Centre ? -0.5 * width : -width;
  return {pen + Vector2d(left, -0.7 * size), pen + Vector2d(left + width, 0.1 * size + text.below)};
}

void LabelPlaces::cover(const Silhouette& body) {
  constexpr double kGround = 0.12;  // of the page
  const Box shown = body.box.intersection(Box(Vector2d::Zero(), page_));
  if (shown.isEmpty()) return;
  (shown.volume() < kGround * page_.prod() ? bodies_ : grounds_).push_back(body);
}

bool LabelPlaces::isFree(const Box& ink, Off off) const {
  const auto meets = [&](const Box& other) { return other.intersects(ink); };
  if (std::any_of(taken_.begin(), taken_.end(), meets)) return false;
  if (off >= Off::Arrows && std::any_of(crossed_.begin(), crossed_.end(), meets)) return false;
  if (off >= Off::Bodies && std::any_of(bodies_.begin(), bodies_.end(),
                                        [&](const Silhouette& body) { return body.meets(ink); }))
    return false;
  return off < Off::Outlines ||
         std::none_of(grounds_.begin(), grounds_.end(), [&](const Silhouette& ground) {
           return ground.meets(ink) && !ground.contains(ink);
         });
}

// The body that a label names, as it was told first.
const Silhouette* LabelPlaces::own(const Label& label, const std::vector<Silhouette>& bodies) {
  const auto at = std::find_if(bodies.begin(), bodies.end(), [&](const Silhouette& body) {
    return label.names && body.centre == *label.names;
  });
  return at == bodies.end() ? nullptr : &*at;
}

bool LabelPlaces::isHidden(const Silhouette& body) const {
  const Vector2d middle = body.box.center();
  const Box spot(middle, middle);
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Silhouette& other) {
    return other.solid && other.depth < body.depth && other.contains(spot);
  });
}

std::optional<LabelPlaces::Standing> LabelPlaces::place(const Label& label, const Vector2d& anchor,
                                                        const Extent& text) {
  std::optional<Standing> standing;
  if (const Silhouette* body = own(label, bodies_); body && isHidden(*body)) return {};
  if (label.apart) standing = apart(label, anchor, text);
  if (standing || label.names) return standing;
  const Off off = label.apart || label.clear ? Off::Arrows : Off::Texts;
  standing = beside(label, anchor, text, off);
  if (!standing) standing = onRings(label, anchor, text, off);
  return standing.value_or(Standing{anchor + label.offset});
}

std::optional<LabelPlaces::Standing> LabelPlaces::apart(const Label& label, const Vector2d& anchor,
                                                        const Extent& text) {
  const Silhouette *body = own(label, bodies_), *ground = own(label, grounds_);
  std::optional<Standing> standing = beside(label, anchor, text, Off::Outlines);
  if (!standing && !ground) standing = beside(label, anchor, text, Off::Bodies);
  if (!standing && (body || ground)) standing = onBody(label, body ? *body : *ground, text);
  if (!standing) standing = onRings(label, anchor, text, Off::Outlines);
  if (!standing && !ground) standing = onRings(label, anchor, text, Off::Bodies);
  return standing;
}

std::optional<LabelPlaces::Standing> LabelPlaces::beside(const Label& label, const Vector2d& anchor,
                                                         const Extent& text, Off off) {
  const Box page(Vector2d::Zero(), page_);
  // Off bodies a little further out first, on the same line: there nobody takes it for another's.
  const double out = label.align == Align::Left ? 0.7 : label.align == Align::Right ? -0.7 : 0.0;
  std::vector<Vector2d> shifts = {{0.0, 0.0}};
  if (off >= Off::Bodies)
    for (int k = 1; k <= 4; ++k) shifts.emplace_back(k * out * label.size, 0.0);
  for (const double lines : {-1.0, 1.0, -2.0, 2.0}) shifts.emplace_back(0.0, lines * label.size);
  for (const Vector2d& shift : shifts) {
    const Vector2d pen = anchor + label.offset + shift;
    const Box ink = inkOf(pen, text, label.size, label.align);
    const bool anywhere = shift.isZero(0.0) && off < Off::Bodies;
    if (!isFree(ink, off) || (!anywhere && !page.contains(ink))) continue;
    take(ink);
    return Standing{pen};
  }
  return {};
}

// In the middle of the body, if it has room for it there and nothing stands before it.
std::optional<LabelPlaces::Standing> LabelPlaces::onBody(const Label& label, const Silhouette& body,
                                                         const Extent& text) {
  const Vector2d start =
      body.box.center() + Vector2d(-0.5 * text.width, 0.3 * label.size - 0.5 * text.below);
  const Box ink = inkOf(start, text, label.size, Align::Left);
  const bool covered = std::any_of(bodies_.begin(), bodies_.end(), [&](const Silhouette& other) {
    return other.solid && other.depth < body.depth && other.meets(ink);
  });
  if (covered || !body.contains(ink) || !isFree(ink, Off::Arrows)) return {};
  take(ink);
  const double shift = label.align == Align::Left     ? 0.0
                       : label.align == Align::Centre ? 0.5 * text.width
                                                      : text.width;
  return Standing{start + Vector2d(shift, 0.0)};
}

// To the right of the anchor first, then alternately above and below.
std::optional<LabelPlaces::Standing> LabelPlaces::onRings(const Label& label,
                                                          const Vector2d& anchor,
                                                          const Extent& text, Off off) {
  constexpr int kDirections = 32;
  const int rings = off >= Off::Bodies ? 3 : 16;  // further off a leader crosses too much
  constexpr double kEdge = 6.0, kRoom = 3.0;      // [px] of the page's edge, between labels
  const Vector2d edge = Vector2d::Constant(kEdge);
  const Box page(edge, Vector2d(page_ - edge));
  for (int ring = 1; ring <= rings; ++ring) {
    for (int n = 0; n < kDirections; ++n) {
      const double angle =
          (n % 2 == 0 ? 1 : -1) * ((n + 1) / 2) * 2.0 * std::numbers::pi / kDirections;
      const Vector2d way(std::cos(angle), -std::sin(angle));
      const Vector2d side = anchor + 2.2 * ring * label.size * way;
      // The edge of the text that looks at the anchor.
      const double left = way.x() > 0.2 ? 0.0 : way.x() < -0.2 ? -text.width : -0.5 * text.width;
      // Above the anchor further lines go up, below it down.
      const double up = 0.5 * (1.0 - way.y()) * text.below;
      const Vector2d pen = side + Vector2d(left, 0.35 * label.size - up);
      Box ink = inkOf(pen, text, label.size, Align::Left);
      if (!page.contains(ink)) continue;
      ink.min() -= Vector2d::Constant(kRoom), ink.max() += Vector2d::Constant(kRoom);
      if (!isFree(ink, off)) continue;
      take(ink);
      const double shift = label.align == Align::Left     ? 0.0
                           : label.align == Align::Centre ? 0.5 * text.width
                                                          : text.width;
      const Vector2d end = anchor.cwiseMax(ink.min()).cwiseMin(ink.max());
      return Standing{pen + Vector2d(shift, 0.0), end};
    }
  }
  return {};
}

}  // namespace tumble
