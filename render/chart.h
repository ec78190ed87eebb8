// Curves over two axes, linear or logarithmic, on a page of paper.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "render/axis.h"
#include "render/font.h"
#include "render/image.h"
#include "render/picture.h"

namespace tumble {

/// Points joined by a line, in this order. A point that has no place on the axes – not finite, or
/// not positive on a logarithmic axis – parts the line.
struct ChartCurve {
  std::string label;  ///< beside the plot
  std::string note;   ///< below the label, paler
  std::vector<Eigen::Vector2d> points;
  Colour colour = {0.23f, 0.44f, 0.66f};
  bool marked = true;  ///< a mark at each point, of a shape of the curve's own
};

/// A dashed line across the plot at one value of an axis.
struct Guide {
  bool upright = true;  ///< at a value of x, else of y
  double at = 0.0;
  std::string label;
};

struct Chart {
  std::string title, subtitle;
  ChartAxis x, y;
  std::vector<ChartCurve> curves;
  std::vector<Guide> guides;
};

/// Draws a chart that fills an image; the same pixels every time.
/// @param width, height  [px] of the image
/// @param scale  pixels of the image per pixel of text: 1 gives text of 14 px
Image drawChart(const Chart& chart, int width, int height, double scale, Fonts& fonts);

/// The same as an SVG document of that size [px], text of 14 px.
std::string svgOf(const Chart& chart, double width, double height, Fonts& fonts);

}  // namespace tumble
