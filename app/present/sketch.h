// Boxes, arrows and text on a page.
#pragma once

#include <Eigen/Core>
#include <string>

#include "app/present/palette.h"
#include "render/picture.h"

namespace tumble {

/// Adds flat things to a picture, in pixels of its page, or in units of `scale` pixels.
class Sketch {
 public:
  explicit Sketch(Picture& picture, double scale = 1.0) : picture_(picture), scale_(scale) {}

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
            const Colour& colour);
  void fill(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour);
  void disc(const Eigen::Vector2d& centre, double diameter, const Colour& colour);
  /// A filled box with a frame.
  void box(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const Colour& paper,
           const Colour& frame);
  /// A line with a head.
  void arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Colour& colour);
  struct Style {
    double size = 14.0;  ///< [px]
    Align align = Align::Centre;
    Colour colour = colour::kInk;
    bool bold = false, italic = false;
  };
  void text(const Eigen::Vector2d& pen, const std::string& text, const Style& style);

 private:
  Picture& picture_;
  double scale_;
};

}  // namespace tumble
