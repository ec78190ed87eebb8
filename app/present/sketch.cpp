#include "app/present/sketch.h"

namespace tumble {

using Eigen::Vector2d;

void Sketch::line(const Vector2d& from, const Vector2d& to, double width, const Colour& colour) {
  picture_.pageShapes.push_back({Flat::Line, scale_ * from, scale_ * to, scale_ * width, colour});
}

void Sketch::fill(const Vector2d& from, const Vector2d& to, const Colour& colour) {
  picture_.pageShapes.push_back({Flat::Rectangle, scale_ * from, scale_ * to, 0.0, colour});
}

void Sketch::disc(const Vector2d& centre, double diameter, const Colour& colour) {
  picture_.pageShapes.push_back(
      {Flat::Disc, scale_ * centre, scale_ * centre, scale_ * diameter, colour});
}

void Sketch::box(const Vector2d& corner, const Vector2d& size, const Colour& paper,
                 const Colour& frame) {
  constexpr double kFrame = 1.5;
  fill(corner, corner + size, frame);
  fill(corner + Vector2d::Constant(kFrame), corner + size - Vector2d::Constant(kFrame), paper);
}

void Sketch::arrow(const Vector2d& from, const Vector2d& to, const Colour& colour) {
  constexpr double kHead = 7.0;
  const Vector2d along = (to - from).normalized(), across(-along.y(), along.x());
  line(from, to, 1.8, colour);
  for (const double side : {-0.55, 0.55})
    line(to, to - kHead * along + side * kHead * across, 1.8, colour);
}

void Sketch::text(const Vector2d& pen, const std::string& text, const Style& style) {
  Label label;
  label.offset = scale_ * pen;
  label.text = text;
  label.size = static_cast<float>(scale_ * style.size);
  label.align = style.align;
  label.colour = style.colour;
  label.bold = style.bold;
  label.italic = style.italic;
  picture_.labels.push_back(label);
}

}  // namespace tumble
