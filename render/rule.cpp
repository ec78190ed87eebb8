// The rule: a measured line on the floor, clear of the bodies and of other writing.
#include <algorithm>
#include <cmath>
#include <limits>

#include "render/overlay.h"

namespace tumble {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Bounds of all bodies along a horizontal axis (0: x, 2: z) [m].
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Span spanOf(const Picture& picture, int axis) {
  Span span;
  for (const Instance& body : picture.instances) {
    const double reach = std::min(reachOf(body), picture.radius);
    span.low = std::min(span.low, body.position[axis] - reach);
    span.high = std::max(span.high, body.position[axis] + reach);
  }
  // Nothing beyond the part of the floor that shows.
  span.low = std::max(span.low, picture.centre[axis] - 1.2 * picture.radius);
  span.high = std::min(span.high, picture.centre[axis] + 1.2 * picture.radius);
  return span;
}

/// 1, 2 or 5 times a power of ten that cuts `length` into four to ten parts.
double stepFor(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  const double leading = length / power;
  return (leading < 2.0 ? 0.2 : leading < 4.0 ? 0.5 : 1.0) * power;
}

/// The rule at one distance in front of the bodies: its ticks that land well inside the image.
struct Tick {
  double value;
  Vector2d place, inward;  ///< on the image, and the unit direction away from the onlooker
};
using Ticks = std::vector<Tick>;

/// Where else on the image something is written.
using Boxes = std::vector<Eigen::AlignedBox2d>;

Boxes writtenBoxes(const Picture& picture, const Projection& projection, const Canvas& canvas) {
  Boxes boxes;
  for (const Mark& mark : picture.marks)
    if (const auto place = projection.project(mark.position))
      boxes.emplace_back(
          place->head<2>() - Vector2d(52.0, 8.0),
          place->head<2>() + Vector2d(52.0, 40.0 + 18.0 * static_cast<double>(mark.lines.size())));
  if (picture.bar)
    boxes.emplace_back(Vector2d(canvas.width() - 340.0, canvas.height() - 64.0),
                       Vector2d(canvas.width(), canvas.height()));
  boxes.emplace_back(Vector2d(0.0, 0.0), Vector2d(canvas.width(), 90.0));
  return boxes;
}

bool collides(const Ticks& ticks, const Boxes& boxes) {
  const Vector2d from = ticks.front().place, along = ticks.back().place - from;
  for (const Eigen::AlignedBox2d& box : boxes) {
    for (int i = 0; i <= 100; ++i)
      if (box.contains(from + 0.01 * i * along)) return true;
    for (const Tick& tick : ticks)
      if (box.intersects({tick.place + Vector2d(-20.0, 8.0), tick.place + Vector2d(24.0, 24.0)}))
        return true;
  }
  return false;
}

void drawTicks(const Ticks& ticks, double step, Canvas& canvas) {
  canvas.stroke(ticks.front().place, ticks.back().place, 1.8, ink::secondary);
  const bool leftToRight = ticks.front().place.x() < ticks.back().place.x();
  const double unitAt = leftToRight ? ticks.back().value : ticks.front().value;
  for (const Tick& tick : ticks) {
    canvas.stroke(tick.place - 5.0 * tick.inward, tick.place + 5.0 * tick.inward, 1.8,
                  ink::secondary);
    const std::string text = formatTick(tick.value, step) + (tick.value == unitAt ? " m" : "");
    canvas.text(tick.place + Vector2d(2.0, 21.0), text,
                {13.0, Face::Regular, Align::Centre, ink::secondary});
  }
}

}  // namespace

void drawRule(const Picture& picture, const Projection& projection, Canvas& canvas) {
  if (picture.instances.empty()) return;
  // Along the horizontal axis that lies most across, on the side towards the onlooker.
  const int axis = std::abs(projection.right().x()) >= std::abs(projection.right().z()) ? 0 : 2;
  const int other = 2 - axis;
  const Span along = spanOf(picture, axis), side = spanOf(picture, other);
  if (!(along.high > along.low)) return;
  const double outward = projection.forward()[other] < 0.0 ? 1.0 : -1.0;
  const double start = outward > 0.0 ? side.high : side.low;
  const double step = stepFor(along.high - along.low);
  const auto project = [&](double value, double beside) {
    Vector3d point;
    point[axis] = value, point[1] = picture.floor.height, point[other] = beside;
    return projection.project(point);
  };
  const auto ticksAt = [&](double beside) {
    Ticks ticks;
    for (double k = std::ceil(along.low / step - 1e-9); k * step <= along.high + 1e-9 * step;
         k += 1.0) {
      const auto place = project(k * step, beside);
      const auto inward = project(k * step, beside - 0.01 * outward * picture.radius);
      if (!place || !inward) continue;
      const Vector2d p = place->head<2>();
      if (p.x() > 24.0 && p.x() < canvas.width() - 24.0 && p.y() < canvas.height() - 24.0)
        ticks.push_back({k * step, p, (inward->head<2>() - p).normalized()});
    }
    return ticks;
  };

  // As near to the bodies as other writing allows; where it never does, just in front of them.
  const Boxes boxes = writtenBoxes(picture, projection, canvas);
  Ticks chosen = ticksAt(start + 0.12 * outward * picture.radius);
  for (double gap = 0.12; gap < 1.0; gap += 0.04) {
    const Ticks ticks = ticksAt(start + gap * outward * picture.radius);
    if (ticks.size() < 2 || ticks.size() < chosen.size()) break;
    if (collides(ticks, boxes)) continue;
    chosen = ticks;
    break;
  }
  if (chosen.size() >= 2) drawTicks(chosen, step, canvas);
}

}  // namespace tumble
