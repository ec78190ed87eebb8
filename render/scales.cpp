// The two scales of an overlay: the rule on the floor and the colour bar.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "render/bodies.h"
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

}  // namespace

std::string formatTick(double value, double step) {
  const double size = std::abs(value) < 1e-9 * step ? 0.0 : std::abs(value);
  int digits = 0;
  for (double unit = step; digits < 6 && std::abs(unit - std::round(unit)) > 1e-6 * unit;
       unit *= 10.0)
    ++digits;
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, size);
  return (value < 0.0 && size > 0.0 ? "\u2212" : "") + std::string(text);
}

void drawRule(const Picture& picture, const Projection& projection, Canvas& canvas) {
  if (picture.instances.empty()) return;
  // Along the horizontal axis that lies most across, on the side towards the onlooker.
  const int axis = std::abs(projection.right().x()) >= std::abs(projection.right().z()) ? 0 : 2;
  const int other = 2 - axis;
  const Span along = spanOf(picture, axis), side = spanOf(picture, other);
  if (!(along.high > along.low)) return;
  const double gap = 0.12 * picture.radius;
  const double beside = projection.forward()[other] < 0.0 ? side.high + gap : side.low - gap;
  const double step = stepFor(along.high - along.low);

  // Whole steps within the motion that land well inside the image.
  struct Tick {
    double value;
    Vector2d place, inward;
  };
  const auto project = [&](double value, double across) {
    Vector3d point;
    point[axis] = value, point[1] = picture.floor.height, point[other] = across;
    return projection.project(point);
  };
  std::vector<Tick> ticks;
  for (double k = std::ceil(along.low / step - 1e-9); k * step <= along.high + 1e-9 * step;
       k += 1.0) {
    const auto place = project(k * step, beside), inward = project(k * step, beside + 0.1 * gap);
    if (!place || !inward) continue;
    const Vector2d p = place->head<2>();
    if (p.x() > 24.0 && p.x() < canvas.width() - 24.0 && p.y() > 90.0 &&
        p.y() < canvas.height() - 24.0)
      ticks.push_back({k * step, p, (inward->head<2>() - p).normalized()});
  }
  if (ticks.size() < 2) return;

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

void drawColourBar(const ColourBar& bar, Canvas& canvas) {
  if (bar.stops.empty() || !(bar.to != bar.from)) return;
  const double width = 220.0, height = 10.0, left = canvas.width() - 32.0 - width,
               top = canvas.height() - 46.0;
  const int columns = 110;
  for (int i = 0; i < columns; ++i) {
    const double u = (i + 0.5) / columns * static_cast<double>(bar.stops.size() - 1);
    const std::size_t stop =
        std::min(static_cast<std::size_t>(u), std::max<std::size_t>(bar.stops.size(), 2) - 2);
    const Colour &a = bar.stops[stop], &b = bar.stops[std::min(stop + 1, bar.stops.size() - 1)];
    const float t = static_cast<float>(u - static_cast<double>(stop));
    canvas.fill({left + i * width / columns, top}, {width / columns, height},
                {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
  }
  const double step = bar.ticks.size() > 1 ? std::abs(bar.ticks[1] - bar.ticks[0]) : 1.0;
  for (const double value : bar.ticks) {
    const double x = left + width * (value - bar.from) / (bar.to - bar.from);
    canvas.stroke({x, top + height}, {x, top + height + 4.0}, 1.0, ink::secondary);
    canvas.text({x, top + height + 18.0}, formatTick(value, step),
                {13.0, Face::Regular, Align::Centre, ink::secondary});
  }
  canvas.text({left - 9.0, top + height - 1.0}, bar.caption,
              {13.0, Face::Regular, Align::Right, ink::secondary});
}

}  // namespace tumble
