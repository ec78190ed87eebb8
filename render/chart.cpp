#include "render/chart.h"

#include <algorithm>
#include <cmath>

#include "render/canvas.h"
#include "render/heading.h"
#include "render/overlay.h"
#include "render/svg.h"

namespace tumble {
namespace {

using Eigen::Vector2d;

constexpr Colour kGrid = {0.886f, 0.894f, 0.910f}, kFaintGrid = {0.935f, 0.940f, 0.948f};
constexpr double kMargin = 32.0;      // to the right of everything [px]
constexpr double kLeft = 64.0;        // of the plot, or more [px]
constexpr double kEdge = 4.0;         // of the page, that no number comes nearer to [px]
constexpr double kTickGap = 10.0;     // from an upright axis to its numbers [px]
constexpr double kLegendGap = 28.0;   // from the axes to the middle of a key's stroke [px]
constexpr double kLegendText = 18.0;  // from there to its name [px]
constexpr double kLegendStep = 42.0, kMark = 4.2;
constexpr double kLegendMost = 0.38, kPlotLeast = 0.35;  // of the page, that each may take
constexpr double kLegendLeast = 40.0;                    // [px] of names, on a narrow page
constexpr double kLabelLine = 16.0;                      // from line to line of a name [px]
constexpr double kStroke = 2.0;                          // of a curve [px]
constexpr double kSeenGap = 2.0;   // between two strokes that are told apart [px]
constexpr double kCrowded = 10.0;  // guides nearer than that hide what they cross [px]

const Drawing::TextStyle kTick{13.0, Face::Regular, Align::Left, ink::secondary};
const Drawing::TextStyle kPower{9.5, Face::Regular, Align::Left, ink::secondary};
const Drawing::TextStyle kCaption{14.0, Face::Regular, Align::Left, ink::text};
const Drawing::TextStyle kLabel{14.0, Face::Bold, Align::Left, ink::text};
const Drawing::TextStyle kNote{12.5, Face::Regular, Align::Left, ink::secondary};

constexpr double kCaptionLine = 17.0;  // from line to line of a caption [px]

Drawing::TextStyle aligned(Drawing::TextStyle style, Align align) {
  style.align = align;
  return style;
}

/// A number of an axis; on a logarithmic one "10" with its exponent raised.
class TickText {
 public:
  TickText(const Tick& tick, const Scale& scale) {
    const double unit = std::pow(10.0, scale.power());
    if (!scale.logarithmic())
      base_ = formatTick(scale.told(tick) / unit, scale.step() / unit);
    else if (tick.value == 0.0 || tick.value == 1.0)
      base_ = tick.value == 0.0 ? "1" : "10";
    else {
      base_ = "10";
      exponent_ = formatTick(tick.value, 1.0);
    }
  }

  double width(Drawing& canvas) const {
    return canvas.textWidth(base_, kTick) +
           (exponent_.empty() ? 0.0 : 1.0 + canvas.textWidth(exponent_, kPower));
  }
  void draw(Vector2d pen, Drawing& canvas) const {
    canvas.text(pen, base_, kTick);
    if (exponent_.empty()) return;
    pen += Vector2d(canvas.textWidth(base_, kTick) + 1.0, -5.5);
    canvas.text(pen, exponent_, kPower);
  }

 private:
  std::string base_, exponent_;
};

/// The caption, and what the numbers are told in: "contact force / N  (× 10⁻¹⁶)".
std::string captionOf(const ChartAxis& axis, const Scale& scale) {
  const std::string factor = factorText(scale.power(), scale.offset());
  return axis.caption + (factor.empty() ? "" : "  " + factor);
}

/// The value that a tick stands for.
double valueOf(const Tick& tick, const Scale& scale) {
  return scale.logarithmic() ? std::pow(10.0, tick.value) : tick.value;
}

void drawDashed(const Vector2d& from, const Vector2d& to, const Colour& colour, Drawing& canvas) {
  constexpr double kDash = 7.0, kPeriod = 12.0;
  const double length = (to - from).norm();
  for (double done = 0.0; done < length; done += kPeriod)
    canvas.stroke(from + done / length * (to - from),
                  from + std::min(done + kDash, length) / length * (to - from), 1.4, colour);
}

/// Shapes that stay apart where colours do not.
void drawMark(std::size_t shape, const Vector2d& at, const Colour& colour, Drawing& canvas) {
  const double r = kMark;
  const auto diamond = [&](const Vector2d& a, const Vector2d& b) {
    canvas.triangle(at + a, at + b, at - a, colour);
    canvas.triangle(at + a, at - b, at - a, colour);
  };
  canvas.disc(at, r + 1.6, ink::page);
  switch (shape % 6) {
    case 0:
      return canvas.disc(at, r, colour);
    case 1:
      return canvas.fill(at - Vector2d(r, r) * 0.86, Vector2d(r, r) * 1.72, colour);
    case 2:
      return diamond({0.0, 1.25 * r}, {1.25 * r, 0.0});
    case 3:
      return canvas.triangle(at + Vector2d(0.0, -1.2 * r), at + Vector2d(1.15 * r, 0.8 * r),
                             at + Vector2d(-1.15 * r, 0.8 * r), colour);
    case 4:
      return canvas.ring(at, 0.82 * r, 1.8, colour);
    default:
      return canvas.triangle(at + Vector2d(0.0, 1.2 * r), at + Vector2d(-1.15 * r, -0.8 * r),
                             at + Vector2d(1.15 * r, -0.8 * r), colour);
  }
}

/// Whether the points between two lie on the line from one to the other, to a tenth of a pixel.
bool straight(const std::vector<Vector2d>& points, std::size_t from, std::size_t to) {
  constexpr double kOff = 0.1;
  const Vector2d start = points[from], along = points[to] - start;
  const double length = along.norm();
  for (std::size_t i = from + 1; i < to; ++i) {
    const Vector2d way = points[i] - start;
    const double off = std::abs(along.x() * way.y() - along.y() * way.x());
    const double share = along.dot(way);
    if (off > kOff * length || share < 0.0 || share > length * length) return false;
  }
  return true;
}

/// What strokes or marks can show of many points [px]: the first, the last, and of those between
/// that follow each other in a column as wide as a stroke the lowest and the highest, in their
/// order. A curve that goes on to the right keeps at most one for each pixel across, and every
/// peak.
std::vector<Vector2d> thinned(const std::vector<Vector2d>& points) {
  const auto column = [&](std::size_t i) { return std::floor(points[i].x() / kStroke); };
  std::vector<Vector2d> kept = {points.front()};
  for (std::size_t i = 1; i + 1 < points.size();) {
    std::size_t low = i, high = i, next = i + 1;
    for (; next + 1 < points.size() && column(next) == column(i); ++next) {
      if (points[next].y() > points[low].y()) low = next;
      if (points[next].y() < points[high].y()) high = next;
    }
    kept.push_back(points[std::min(low, high)]);
    if (low != high) kept.push_back(points[std::max(low, high)]);
    i = next;
  }
  kept.push_back(points.back());
  return kept;
}

/// Where everything of one chart stands, and the canvas that it is drawn on.
class Plot {
 public:
  Plot(const Chart& chart, Drawing& canvas)
      : chart_(chart),
        canvas_(canvas),
        heading_(canvas, chart.title, chart.subtitle, canvas.width() - 2.0 * kMargin, headLines()),
        legend_(legendWidth()),
        right_(canvas.width() - kMargin -
               (legend_ > 0.0 ? kLegendGap + kLegendText + legend_ : 0.0)),
        head_(chart.title.empty() ? 48.0 : 120.0 + heading_.below()),
        foot_(canvas.height() - 58.0),
        xCaption_(xCaption(Scale(chart.x, valuesOf(0), kLeft, right_, 64.0), captionLines())),
        yCaption_(yCaption(Scale(chart.y, valuesOf(1), foot_, head_, 40.0), captionLines())),
        top_(head_ + yCaption_.below(kCaptionLine)),
        bottom_(foot_ - xCaption_.below(kCaptionLine)),
        y_(chart.y, valuesOf(1), bottom_, top_, 40.0),
        left_(leftOf(y_)),
        x_(chart.x, valuesOf(0), left_, right_, 64.0) {
    // On as many lines as there is room for, with the powers that the numbers now have.
    xCaption_ = xCaption(x_, xCaption_.lines.size());
    yCaption_ = yCaption(y_, yCaption_.lines.size());
  }

  void draw() {
    canvas_.fill({0.0, 0.0}, {canvas_.width(), canvas_.height()}, ink::page);
    drawGrid();
    drawGuides();
    for (const ChartCurve& curve : chart_.curves) drawLine(curve);
    for (std::size_t i = 0; i < chart_.curves.size(); ++i) drawMarks(i);
    drawLegend();
    heading_.draw(kMargin, canvas_);
  }

 private:
  std::vector<double> valuesOf(int axis) const {
    std::vector<double> values;
    for (const ChartCurve& curve : chart_.curves)
      for (const Vector2d& point : curve.points) values.push_back(point[axis]);
    for (const Guide& guide : chart_.guides)
      if (guide.upright == (axis == 0)) values.push_back(guide.at);
    return values;
  }

  // Of the title and of the subtitle, and of a caption: as the height of the page allows.
  std::size_t headLines() const {
    return canvas_.height() < 400.0 ? 1 : canvas_.height() < 600.0 ? 2 : 3;
  }
  std::size_t captionLines() const { return canvas_.height() < 300.0 ? 1 : 2; }

  // As wide as its widest words, but no wider than leaves the plot about half of the page.
  double legendWidth() {
    double width = 0.0;
    for (const ChartCurve& curve : chart_.curves)
      width = std::max(
          {width, canvas_.textWidth(curve.label, kLabel), canvas_.textWidth(curve.note, kNote)});
    const double beside = kLeft + kMargin + kLegendGap + kLegendText;
    const double plot = kPlotLeast * canvas_.width();
    return std::min({width, kLegendMost * canvas_.width(),
                     std::max(kLegendLeast, canvas_.width() - plot - beside)});
  }

  Drawing::Words xCaption(const Scale& scale, std::size_t most) {
    return canvas_.fitted(captionOf(chart_.x, scale), right_ - 2.0 * kEdge, most, kCaption,
                          kLegible);
  }

  Drawing::Words yCaption(const Scale& scale, std::size_t most) {
    return canvas_.fitted(captionOf(chart_.y, scale), canvas_.width() - kMargin - kLeft, most,
                          kCaption, kLegible);
  }

  // As far in as the widest number asks.
  double leftOf(const Scale& upright) {
    double left = kLeft;
    for (const Tick& tick : upright.ticks())
      if (tick.labelled)
        left = std::max(left, kEdge + TickText(tick, upright).width(canvas_) + kTickGap);
    return left;
  }

  void drawGrid() {
    for (const Tick& tick : x_.ticks()) {
      const double x = x_.at(valueOf(tick, x_));
      canvas_.stroke({x, top_}, {x, bottom_}, 1.0, tick.labelled ? kGrid : kFaintGrid);
    }
    for (const Tick& tick : y_.ticks()) {
      const double y = y_.at(valueOf(tick, y_));
      canvas_.stroke({left_, y}, {right_, y}, 1.0, tick.labelled ? kGrid : kFaintGrid);
    }
    canvas_.stroke({left_, bottom_}, {right_, bottom_}, 1.4, ink::secondary);
    canvas_.stroke({left_, top_}, {left_, bottom_}, 1.4, ink::secondary);
    if (chart_.y.broken && y_.aboveZero()) drawBreak();
    for (const Tick& tick : x_.ticks()) {
      const double x = x_.at(valueOf(tick, x_));
      canvas_.stroke({x, bottom_}, {x, bottom_ + (tick.labelled ? 5.0 : 3.0)}, 1.2, ink::secondary);
      const TickText text(tick, x_);
      if (tick.labelled) text.draw({x - 0.5 * text.width(canvas_), bottom_ + 20.0}, canvas_);
    }
    for (const Tick& tick : y_.ticks()) {
      const double y = y_.at(valueOf(tick, y_));
      canvas_.stroke({left_ - (tick.labelled ? 5.0 : 3.0), y}, {left_, y}, 1.2, ink::secondary);
      const TickText text(tick, y_);
      if (tick.labelled) text.draw({left_ - kTickGap - text.width(canvas_), y + 4.5}, canvas_);
    }
    canvas_.text({left_ - 32.0, top_ - 16.0 - yCaption_.below(kCaptionLine)}, yCaption_,
                 kCaptionLine, kCaption);
    canvas_.text({right_, bottom_ + 42.0}, xCaption_, kCaptionLine,
                 aligned(kCaption, Align::Right));
  }

  // Two strokes across a gap in the upright axis, between its foot and the first tick above.
  void drawBreak() {
    const double middle = bottom_ - 13.0, gap = 3.0;
    canvas_.fill({left_ - 2.0, middle - gap}, {4.0, 2.0 * gap}, ink::page);
    for (const double y : {middle - gap, middle + gap})
      canvas_.stroke({left_ - 6.0, y + 2.5}, {left_ + 6.0, y - 2.5}, 1.4, ink::secondary);
  }

  // Upright ones without a name that would make a grey wall are told along the top alone, as one
  // bar wherever they leave no gap that is seen.
  void drawGuides() {
    std::vector<double> nameless;  // [px] from left to right
    for (const Guide& guide : chart_.guides)
      if (!guide.upright || !guide.label.empty())
        drawGuide(guide);
      else if (x_.holds(guide.at))
        nameless.push_back(x_.at(guide.at));
    std::sort(nameless.begin(), nameless.end());
    const auto first = nameless.begin(), last = nameless.end();
    for (auto from = first; from != last;) {
      const auto to =
          std::adjacent_find(from, last, [](double a, double b) { return b - a > kSeenGap; });
      const auto end = to == last ? last : to + 1;
      const bool free = (from == first || *from - from[-1] > kCrowded) &&
                        (end == last || *end - end[-1] > kCrowded);
      if (free && end[-1] - *from < kSeenGap)
        drawDashed({*from, bottom_}, {*from, top_}, ink::secondary, canvas_);
      else
        canvas_.fill({*from - 0.7, top_ - 8.0}, {end[-1] - *from + 1.4, 8.0}, ink::secondary);
      from = end;
    }
  }

  void drawGuide(const Guide& guide) {
    const Scale& scale = guide.upright ? x_ : y_;
    if (!scale.holds(guide.at)) return;
    const double at = scale.at(guide.at);
    if (guide.upright) {
      drawDashed({at, bottom_}, {at, top_}, ink::secondary, canvas_);
      const bool before =
          at + 7.0 + canvas_.textWidth(guide.label, kNote) > canvas_.width() - kEdge;
      const double room = before ? at - 7.0 - kEdge : canvas_.width();
      canvas_.text({before ? at - 7.0 : at + 7.0, bottom_ - 8.0},
                   canvas_.fitted(guide.label, room, 1, kNote, kLegible), 0.0,
                   aligned(kNote, before ? Align::Right : Align::Left));
    } else {
      drawDashed({left_, at}, {right_, at}, ink::secondary, canvas_);
      canvas_.text({right_ - 4.0, at - 6.0},
                   canvas_.fitted(guide.label, right_ - left_ - 8.0, 1, kNote, kLegible), 0.0,
                   aligned(kNote, Align::Right));
    }
  }

  bool holds(const Vector2d& point) const { return x_.holds(point.x()) && y_.holds(point.y()); }
  Vector2d at(const Vector2d& point) const { return {x_.at(point.x()), y_.at(point.y())}; }

  // Each stretch of points that have a place on the axes [px], without those that nobody could see.
  std::vector<std::vector<Vector2d>> stretchesOf(const ChartCurve& curve) const {
    std::vector<std::vector<Vector2d>> stretches(1);
    for (const Vector2d& point : curve.points)
      if (holds(point))
        stretches.back().push_back(at(point));
      else if (!stretches.back().empty())
        stretches.emplace_back();
    for (std::vector<Vector2d>& stretch : stretches)
      if (static_cast<double>(stretch.size()) > right_ - left_) stretch = thinned(stretch);
    return stretches;
  }

  // Where it is straight, one stroke: many would show their ends as beads.
  void drawLine(const ChartCurve& curve) {
    for (const std::vector<Vector2d>& points : stretchesOf(curve))
      for (std::size_t from = 0; from + 1 < points.size();) {
        std::size_t to = from + 1;
        while (to < points.size() && straight(points, from, to)) ++to;
        --to;
        canvas_.stroke(points[from], points[to], kStroke, curve.colour);
        from = to;
      }
  }

  void drawMarks(std::size_t index) {
    const ChartCurve& curve = chart_.curves[index];
    if (!curve.marked) return;
    for (const std::vector<Vector2d>& points : stretchesOf(curve))
      for (const Vector2d& point : points) drawMark(index, point, curve.colour, canvas_);
  }

  // What stands beside the keys.
  struct Entry {
    Drawing::Words label, note;
    double below() const { return label.below(kLabelLine) + note.below(kLabelLine); }
  };

  std::vector<Entry> entries(std::size_t most) {
    std::vector<Entry> all;
    for (const ChartCurve& curve : chart_.curves)
      all.push_back({canvas_.fitted(curve.label, legend_, most, kLabel, kLegible),
                     canvas_.fitted(curve.note, legend_, most, kNote, kLegible)});
    return all;
  }

  // On as many lines as leave room for all.
  void drawLegend() {
    const double x = right_ + kLegendGap, count = static_cast<double>(chart_.curves.size());
    double y = top_ + 10.0, step = 0.0;
    std::vector<Entry> all;
    for (std::size_t most = 4; most > 0 && step < kLabelLine; --most) {
      all = entries(most);
      double room = canvas_.height() - y - 12.0;
      for (const Entry& entry : all) room -= entry.below();
      step = std::min(kLegendStep, room / count);
    }
    for (std::size_t i = 0; i < all.size(); y += step + all[i].below(), ++i) {
      const ChartCurve& curve = chart_.curves[i];
      if (curve.label.empty()) continue;
      canvas_.stroke({x - 12.0, y}, {x + 10.0, y}, kStroke, curve.colour);
      if (curve.marked) drawMark(i, {x - 1.0, y}, curve.colour, canvas_);
      canvas_.text({x + kLegendText, y + 5.0}, all[i].label, kLabelLine, kLabel);
      const double below = all[i].label.below(kLabelLine) + std::min(22.0, 0.5 * step + 4.0);
      canvas_.text({x + kLegendText, y + below}, all[i].note, kLabelLine, kNote);
    }
  }

  const Chart& chart_;
  Drawing& canvas_;
  Heading heading_;
  double legend_, right_;
  double head_, foot_;  // of the plot, if each caption is one line [px]
  Drawing::Words xCaption_, yCaption_;
  double top_, bottom_;
  Scale y_;
  double left_;
  Scale x_;
};

}  // namespace

Image drawChart(const Chart& chart, int width, int height, double scale, Fonts& fonts) {
  Image image{width, height, {}};
  image.rgb.resize(3u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Canvas canvas(image, fonts, scale);
  canvas.setPaper(ink::page);
  Plot(chart, canvas).draw();
  return image;
}

std::string svgOf(const Chart& chart, double width, double height, Fonts& fonts) {
  SvgDrawing drawing(width, height, fonts);
  Plot(chart, drawing).draw();
  return drawing.document();
}

}  // namespace tumble
