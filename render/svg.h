// A drawing as an SVG document: lines and text that stay sharp at any size, for print.
#pragma once

#include "render/canvas.h"

namespace tumble {

class SvgDrawing : public Drawing {
 public:
  /// @param fonts  that widths of text are taken from; the document names Lato, with others to
  ///               fall back to
  SvgDrawing(double width, double height, Fonts& fonts);

  double width() const override { return width_; }
  double height() const override { return height_; }
  void fill(const Eigen::Vector2d& topLeft, const Eigen::Vector2d& size,
            const Colour& colour) override;
  void disc(const Eigen::Vector2d& centre, double radius, const Colour& colour,
            double alpha = 1.0) override;
  void ring(const Eigen::Vector2d& centre, double radius, double stroke,
            const Colour& colour) override;
  /// Strokes that follow each other and look alike become one path, unless they let something
  /// through.
  void stroke(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
              const Colour& colour, double alpha = 1.0) override;
  void triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Colour& colour) override;
  using Drawing::text;
  void text(const Eigen::Vector2d& pen, std::string_view utf8, const TextStyle& style) override;
  double textWidth(std::string_view utf8, const TextStyle& style) override;

  /// The whole document.
  std::string document();

 private:
  void endPath();

  double width_, height_;
  Fonts& fonts_;
  std::string body_, path_, look_;  ///< path_ is the path that is begun, look_ its attributes
  Eigen::Vector2d end_ = Eigen::Vector2d::Zero();
};

}  // namespace tumble
