#include "render/canvas.h"

#include <algorithm>
#include <cmath>

#include "render/page.h"

namespace tumble {
namespace {

using Eigen::Vector2d;

constexpr double kHaloWidth = 2.2, kHaloAlpha = 0.88;

double distanceToSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

/// Signed distance to the line through a and b, negative to the right of its direction (y down).
double beside(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = (b - a).normalized();
  return along.y() * (p.x() - a.x()) - along.x() * (p.y() - a.y());
}

}  // namespace

void Canvas::blend(int x, int y, const Colour& colour, double alpha) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
  const std::size_t place = static_cast<std::size_t>(y) * image_.width + x;
  std::uint8_t* pixel = image_.rgb.data() + 3 * place;
  if (!image_.alpha.empty()) {
    // Over a pixel that is itself see-through: Porter and Duff, "Compositing Digital Images", 1984.
    const double below = image_.alpha[place] / 255.0, sum = alpha + below * (1.0 - alpha);
    image_.alpha[place] = static_cast<std::uint8_t>(255.0 * sum + 0.5);
    alpha = sum > 0.0 ? alpha / sum : 0.0;
  }
  for (int c = 0; c < 3; ++c)
    pixel[c] = static_cast<std::uint8_t>(pixel[c] + alpha * (255.0 * colour[c] - pixel[c]) + 0.5);
}

template <class Distance>
void Canvas::paint(const Vector2d& low, const Vector2d& high, const Colour& colour, double alpha,
                   const Distance& distance) {
  const int x0 = std::max(0, static_cast<int>(std::floor(std::max(low.x() - 1.0, -1.0))));
  const int y0 = std::max(0, static_cast<int>(std::floor(std::max(low.y() - 1.0, -1.0))));
  const int x1 = static_cast<int>(std::ceil(std::min(high.x() + 1.0, double(image_.width))));
  const int y1 = static_cast<int>(std::ceil(std::min(high.y() + 1.0, double(image_.height))));
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const double coverage = std::clamp(0.5 - distance(Vector2d(x + 0.5, y + 0.5)), 0.0, 1.0);
      if (coverage > 0.0) blend(x, y, colour, alpha * coverage);
    }
  }
}

void Canvas::fill(const Vector2d& topLeft, const Vector2d& size, const Colour& colour) {
  const Vector2d middle = scale_ * (topLeft + 0.5 * size), half = 0.5 * scale_ * size;
  paint(middle - half, middle + half, colour, 1.0,
        [&](const Vector2d& p) { return ((p - middle).cwiseAbs() - half).maxCoeff(); });
}

void Canvas::disc(const Vector2d& centre, double radius, const Colour& colour, double alpha) {
  const Vector2d middle = scale_ * centre, reach = Vector2d::Constant(scale_ * radius);
  paint(middle - reach, middle + reach, colour, alpha,
        [&](const Vector2d& p) { return (p - middle).norm() - reach.x(); });
}

void Canvas::ring(const Vector2d& centre, double radius, double stroke, const Colour& colour) {
  const double r = scale_ * radius, half = std::max(0.5, 0.5 * scale_ * stroke);
  const Vector2d middle = scale_ * centre, reach = Vector2d::Constant(r + half);
  paint(middle - reach, middle + reach, colour, std::min(1.0, scale_ * stroke),
        [&](const Vector2d& p) { return std::abs((p - middle).norm() - r) - half; });
}

void Canvas::stroke(const Vector2d& from, const Vector2d& to, double width, const Colour& colour,
                    double alpha) {
  const Vector2d a = scale_ * from, b = scale_ * to;
  const double half = std::max(0.5, 0.5 * scale_ * width);
  const Vector2d reach = Vector2d::Constant(half);
  paint(a.cwiseMin(b) - reach, a.cwiseMax(b) + reach, colour, alpha * std::min(1.0, scale_ * width),
        [&](const Vector2d& p) { return distanceToSegment(p, a, b) - half; });
}

void Canvas::triangle(const Vector2d& a, const Vector2d& b, const Vector2d& c,
                      const Colour& colour) {
  const Vector2d p0 = scale_ * a;
  Vector2d p1 = scale_ * b, p2 = scale_ * c;
  if (beside(p2, p0, p1) > 0.0) std::swap(p1, p2);
  paint(p0.cwiseMin(p1).cwiseMin(p2), p0.cwiseMax(p1).cwiseMax(p2), colour, 1.0,
        [&](const Vector2d& p) {
          return std::max({beside(p, p0, p1), beside(p, p1, p2), beside(p, p2, p0)});
        });
}

void Canvas::frame(const Vector2d& topLeft, const Vector2d& size, double stroke,
                   const Colour& colour) {
  const Vector2d across(size.x(), 0.0), down(0.0, size.y());
  fill(topLeft, {size.x(), stroke}, colour);
  fill(topLeft + down - Vector2d(0.0, stroke), {size.x(), stroke}, colour);
  fill(topLeft, {stroke, size.y()}, colour);
  fill(topLeft + across - Vector2d(stroke, 0.0), {stroke, size.y()}, colour);
}

double Canvas::textWidth(std::string_view utf8, const TextStyle& style) {
  return fonts_.set(utf8, style.face, style.size * scale_, kHaloWidth * scale_).advance / scale_;
}

void Canvas::text(const Vector2d& pen, std::string_view utf8, const TextStyle& style) {
  const TextImage& line = fonts_.set(utf8, style.face, style.size * scale_, kHaloWidth * scale_);
  const double share = style.align == Align::Left ? 0.0 : style.align == Align::Centre ? 0.5 : 1.0;
  const int x0 = static_cast<int>(std::lround(pen.x() * scale_ - share * line.advance)) + line.left;
  const int y0 = static_cast<int>(std::lround(pen.y() * scale_)) + line.top;
  for (int y = 0; y < line.height; ++y) {
    const Colour paper = paper_.value_or(pageColour((y0 + y + 0.5) / image_.height));
    for (int x = 0; x < line.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * line.width + x;
      if (line.halo[i]) blend(x0 + x, y0 + y, paper, kHaloAlpha * line.halo[i] / 255.0);
      if (line.ink[i]) blend(x0 + x, y0 + y, style.colour, line.ink[i] / 255.0);
    }
  }
}

}  // namespace tumble
