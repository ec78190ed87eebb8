#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/axis.h"
#include "render/heading.h"
#include "render/overlay.h"

namespace tumble {

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

namespace {

/// Power of ten that the numbers below a bar are told in: 0 unless they would touch each other or
/// take too many digits.
int powerFor(const ColourBar& bar, double step, double width, const Canvas::TextStyle& style,
             Canvas& canvas) {
  constexpr double kApart = 6.0;  // [px]
  const double size = std::max(std::abs(bar.from), std::abs(bar.to));
  double widest = 0.0;
  for (const double value : bar.ticks)
    widest = std::max(widest, canvas.textWidth(formatTick(value, step), style));
  if (widest + kApart > width * step / std::abs(bar.to - bar.from)) return powerOf(size, 0.0);
  return powerOf(size, step);
}

}  // namespace

void drawColourBar(const ColourBar& bar, Canvas& canvas) {
  if (bar.stops.empty() || !(bar.to != bar.from)) return;
  const double width = std::min(220.0, canvas.width() - 64.0), height = 10.0,
               left = canvas.width() - 32.0 - width, top = canvas.height() - 46.0;
  const int columns = 110;
  for (int i = 0; i < columns; ++i) {
    const double u = (i + 0.5) / columns * static_cast<double>(bar.stops.size() - 1);
    const std::size_t stop =
        std::min(static_cast<std::size_t>(u), std::max<std::size_t>(bar.stops.size(), 2) - 2);
    const Colour &a = bar.stops[stop], &b = bar.stops[std::min(stop + 1, bar.stops.size() - 1)];
    const float t = static_cast<float>(u - static_cast<double>(stop));
    // Each to the end of the bar, so that no paper shines through between two.
    const double from = i * width / columns;
    canvas.fill({left + from, top}, {width - from, height},
                {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])});
  }
  const double step = bar.ticks.size() > 1 ? std::abs(bar.ticks[1] - bar.ticks[0]) : 1.0;
  const Canvas::TextStyle style{13.0, Face::Regular, Align::Centre, ink::secondary};
  const int power = powerFor(bar, step, width, style, canvas);
  const double unit = std::pow(10.0, power);
  for (const double value : bar.ticks) {
    const double x = left + width * (value - bar.from) / (bar.to - bar.from);
    canvas.stroke({x, top + height}, {x, top + height + 4.0}, 1.0, ink::secondary);
    canvas.text({x, top + height + 18.0}, formatTick(value / unit, step / unit), style);
  }
  // Left of the bar, or above it where the page is too narrow.
  const std::string factor = factorText(power, 0.0);
  const std::string caption = bar.caption + (factor.empty() ? "" : "  " + factor);
  const Canvas::TextStyle captionStyle{13.0, Face::Regular, Align::Right, ink::secondary};
  const bool beside = canvas.textWidth(caption, captionStyle) < left - 15.0;
  const Eigen::Vector2d pen = beside ? Eigen::Vector2d(left - 9.0, top + height - 1.0)
                                     : Eigen::Vector2d(left + width, top - 8.0);
  canvas.text(pen, canvas.fitted(caption, pen.x() - 6.0, 1, captionStyle, kLegible), 0.0,
              captionStyle);
}

}  // namespace tumble
