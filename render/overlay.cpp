#include "render/overlay.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/lines.h"

namespace tumble {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDotSpacing = 13.0, kDotRadius = 2.1, kDotHalo = 3.3, kDotHaloAlpha = 0.9;

Vector2d flat(const Vector3d& point) {
  return point.head<2>();
}

/// Beads along a curve, evenly spaced on the image, in front of everything.
void drawDots(const Polyline& line, const Projection& projection, Canvas& canvas) {
  std::vector<Vector2d> beads;
  for (const std::vector<Vector3d>& piece : projectLine(line.points, projection)) {
    double next = 0.0, done = 0.0;
    for (std::size_t i = 0; i + 1 < piece.size(); ++i) {
      const Vector2d from = flat(piece[i]), along = flat(piece[i + 1]) - from;
      const double length = along.norm();
      for (; next <= done + length && length > 0.0; next += kDotSpacing)
        beads.push_back(from + (next - done) / length * along);
      done += length;
    }
  }
  // All rims before all dots, so that neighbours do not bite into each other.
  const double grow = line.width / 1.8;
  for (const Vector2d& bead : beads) canvas.disc(bead, kDotHalo * grow, ink::paper, kDotHaloAlpha);
  for (const Vector2d& bead : beads) canvas.disc(bead, kDotRadius * grow, line.colour);
}

void drawMark(const Mark& mark, const Projection& projection, Canvas& canvas) {
  const auto place = projection.project(mark.position);
  if (!place) return;
  const Vector2d centre = flat(*place);
  if (!mark.lines.empty())
    canvas.stroke(centre + Vector2d(0.0, 6.0), centre + Vector2d(0.0, 34.0), 1.0, ink::secondary);
  canvas.ring(centre, 5.0, 1.6, mark.colour);
  double baseline = 49.0;
  for (const std::string& line : mark.lines) {
    const Colour colour = baseline == 49.0 ? ink::text : ink::secondary;
    canvas.text(centre + Vector2d(0.0, baseline), line,
                {14.0, Face::Regular, Align::Centre, colour});
    baseline += 18.0;
  }
}

/// Draws labels side by side: one that would stand on another moves up or down by whole lines.
class LabelDrawer {
 public:
  LabelDrawer(const Projection& projection, Canvas& canvas)
      : projection_(projection), canvas_(canvas) {}

  void draw(const Label& label) {
    const Face face = label.bold ? Face::Bold : label.italic ? Face::Italic : Face::Regular;
    const Canvas::TextStyle style{label.size, face, label.align, label.colour};
    Vector2d pen = label.offset;
    if (label.anchor) {
      const auto place = projection_.project(*label.anchor);
      if (!place) return;
      pen = freePlace(label, pen + flat(*place), canvas_.textWidth(label.text, style));
    }
    canvas_.text(pen, label.text, style);
  }

 private:
  using Box = Eigen::AlignedBox2d;

  // Where the ink of a line of text is, about [px].
  static Box inkOf(const Label& label, const Vector2d& pen, double width) {
    const double left = label.align == Align::Left     ? 0.0
                        : label.align == Align::Centre ? -0.5 * width
                                                       : -width;
    return {pen + Vector2d(left, -0.7 * label.size),
            pen + Vector2d(left + width, 0.1 * label.size)};
  }

  Vector2d freePlace(const Label& label, const Vector2d& pen, double width) {
    for (const double lines : {0.0, -1.0, 1.0, -2.0, 2.0}) {
      const Vector2d moved = pen + Vector2d(0.0, lines * label.size);
      const Box ink = inkOf(label, moved, width);
      const auto covers = [&](const Box& other) { return other.intersects(ink); };
      if (std::any_of(taken_.begin(), taken_.end(), covers)) continue;
      taken_.push_back(ink);
      return moved;
    }
    return pen;
  }

  const Projection& projection_;
  Canvas& canvas_;
  std::vector<Box> taken_;
};

void drawBar(const PageBar& bar, const Projection& projection, Canvas& canvas) {
  constexpr double kThick = 8.0;  // [px]
  if (bar.leader)
    if (const auto place = projection.project(*bar.leader))
      canvas.stroke(flat(*place), bar.base - Vector2d(8.0, 0.0), 1.0, ink::leader);
  canvas.fill(bar.base - Vector2d(0.0, 0.5 * kThick), {bar.length, kThick}, bar.colour);
  canvas.text(bar.base + Vector2d(bar.length + 10.0, 5.0), bar.text,
              {14.0, Face::Regular, Align::Left, ink::text});
}

void drawPageShape(const PageShape& shape, Canvas& canvas) {
  switch (shape.form) {
    case Flat::Line:
      return canvas.stroke(shape.from, shape.to, shape.width, shape.colour);
    case Flat::Rectangle:
      return canvas.fill(shape.from, shape.to - shape.from, shape.colour);
    case Flat::Disc:
      return canvas.disc(shape.from, 0.5 * shape.width, shape.colour);
  }
}

// Title and subtitle, as large as the shorter side of the page asks, in as many lines as it takes.
void drawTitle(const Picture& picture, Canvas& canvas) {
  constexpr double kLeft = 32.0, kFirst = 46.0;
  const double small = std::min(1.0, canvas.width() / canvas.height());
  const double left = kLeft * small, width = canvas.width() - 2.0 * left;
  double baseline = kFirst * small;
  const auto draw = [&](const std::string& text, const Canvas::TextStyle& style, double advance) {
    for (const std::string& line : canvas.lines(text, width, style)) {
      canvas.text({left, baseline}, line, style);
      baseline += advance * small;
    }
  };
  draw(picture.title, {22.0 * small, Face::Bold, Align::Left, ink::text}, 26.0);
  baseline = std::max(baseline - 2.0 * small, 70.0 * small);
  draw(picture.subtitle, {15.0 * small, Face::Regular, Align::Left, ink::secondary}, 19.0);
}

}  // namespace

void drawOverlay(const Picture& picture, const Projection& projection, Canvas& canvas) {
  if (picture.floor.visible && picture.floor.rule) drawRule(picture, projection, canvas);
  for (const Polyline& line : picture.lines)
    if (line.stroke == Stroke::Dotted) drawDots(line, projection, canvas);
  for (const Mark& mark : picture.marks) drawMark(mark, projection, canvas);
  for (const PageShape& shape : picture.pageShapes) drawPageShape(shape, canvas);
  for (const PageBar& bar : picture.pageBars) drawBar(bar, projection, canvas);
  LabelDrawer labels(projection, canvas);
  for (const Label& label : picture.labels) labels.draw(label);
  if (picture.bar) drawColourBar(*picture.bar, canvas);
  drawTitle(picture, canvas);
}

}  // namespace tumble
