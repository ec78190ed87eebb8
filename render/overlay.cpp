#include "render/overlay.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/label_places.h"
#include "render/lines.h"

namespace tumble {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDotSpacing = 13.0, kDotRadius = 2.1, kDotHalo = 3.3, kDotHaloAlpha = 0.9;

Vector2d flat(const Vector3d& point) {
  return point.head<2>();
}

bool isDotted(const Polyline& line) {
  return line.stroke == Stroke::Dotted;
}

/// How large the beads of so many curves are: more than a few would hide what they stand beside.
double beadSize(std::ptrdiff_t curves) {
  constexpr double kFew = 8.0, kLeast = 0.6;
  return std::clamp(std::sqrt(kFew / static_cast<double>(curves)), kLeast, 1.0);
}

/// Beads along a curve, evenly spaced on the image, in front of everything.
void drawDots(const Polyline& line, double size, const Projection& projection, Canvas& canvas) {
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
  const double grow = size * line.width / 1.8;
  for (const Vector2d& bead : beads) canvas.disc(bead, kDotHalo * grow, ink::paper, kDotHaloAlpha);
  for (const Vector2d& bead : beads) canvas.disc(bead, kDotRadius * grow, line.colour);
}

const Canvas::TextStyle kMarkWords{14.0, Face::Regular, Align::Centre, ink::text};

/// From a mark to the middle of the baseline of its i-th line [px].
Vector2d wordsOffset(std::size_t i) {
  return {0.0, 49.0 + 18.0 * static_cast<double>(i)};
}

/// What the lines of a mark cover, as many pixels further down than they would like to stand.
std::vector<Eigen::AlignedBox2d> wordsOf(const Mark& mark, const Vector2d& centre, double drop,
                                         Canvas& canvas) {
  std::vector<Eigen::AlignedBox2d> boxes;
  for (std::size_t i = 0; i < mark.lines.size(); ++i)
    boxes.push_back(inkOf(centre + wordsOffset(i) + Vector2d(0.0, drop),
                          canvas.textWidth(mark.lines[i], kMarkWords), kMarkWords.size,
                          Align::Centre));
  return boxes;
}

/// How far each mark's lines go down so as not to stand on those of others, if that is not far
/// [px].
std::vector<double> dropsOf(const std::vector<Mark>& marks, const Projection& projection,
                            Canvas& canvas) {
  std::vector<Eigen::AlignedBox2d> taken;
  std::vector<double> drops(marks.size(), 0.0);
  for (std::size_t n = 0; n < marks.size(); ++n) {
    const auto place = projection.project(marks[n].position);
    if (!place) continue;
    for (const double drop : {0.0, 18.0, 36.0, 54.0, 72.0}) {
      const auto words = wordsOf(marks[n], flat(*place), drop, canvas);
      const bool free = std::none_of(words.begin(), words.end(), [&](const auto& box) {
        return std::any_of(taken.begin(), taken.end(),
                           [&](const auto& other) { return other.intersects(box); });
      });
      if (free) drops[n] = drop;
      if (free) break;
    }
    for (const auto& box : wordsOf(marks[n], flat(*place), drops[n], canvas)) taken.push_back(box);
  }
  return drops;
}

void drawMark(const Mark& mark, double drop, const Projection& projection, Canvas& canvas) {
  const auto place = projection.project(mark.position);
  if (!place) return;
  const Vector2d centre = flat(*place), down(0.0, drop);
  if (!mark.lines.empty())
    canvas.stroke(centre + Vector2d(0.0, 6.0), centre + Vector2d(0.0, 34.0) + down, 1.0,
                  ink::secondary);
  canvas.ring(centre, 5.0, 1.6, mark.colour);
  for (std::size_t i = 0; i < mark.lines.size(); ++i) {
    Canvas::TextStyle style = kMarkWords;
    if (i > 0) style.colour = ink::secondary;
    canvas.text(centre + wordsOffset(i) + down, mark.lines[i], style);
  }
}

/// Tells where the arrows are, box by box along each.
void crossArrows(const std::vector<Arrow>& arrows, const Projection& projection,
                 LabelPlaces& places) {
  constexpr double kBox = 8.0;  // [px]
  for (const Arrow& arrow : arrows) {
    const auto base = projection.project(arrow.base), tip = projection.project(arrow.tip);
    if (!base || !tip) continue;
    const Vector2d way = flat(*tip) - flat(*base), half = Vector2d::Constant(arrow.radius + 3.0);
    const int count = static_cast<int>(std::min(way.norm() / kBox, 1000.0)) + 1;
    for (int k = 0; k <= count; ++k) {
      const Vector2d at = flat(*base) + static_cast<double>(k) / count * way;
      places.cross({at - half, at + half});
    }
  }
}

/// Labels, none on another or on the words of a mark.
/// @return how many bodies went without their names
int drawLabels(const Picture& picture, const std::vector<double>& drops,
               const Projection& projection, Canvas& canvas) {
  LabelPlaces places({canvas.width(), canvas.height()});
  if (std::any_of(picture.labels.begin(), picture.labels.end(),
                  [](const Label& label) { return label.apart || label.clear; })) {
    crossArrows(picture.arrows, projection, places);
    for (auto body = picture.instances.rbegin(); body != picture.instances.rend(); ++body)
      if (const std::optional<Silhouette> silhouette = silhouetteOf(*body, projection))
        places.cover(*silhouette);
  }
  int unnamed = 0;
  for (std::size_t n = 0; n < picture.marks.size(); ++n)
    if (const auto place = projection.project(picture.marks[n].position))
      for (const auto& box : wordsOf(picture.marks[n], flat(*place), drops[n], canvas))
        places.take(box);
  for (const Label& label : picture.labels) {
    const Face face = label.bold ? Face::Bold : label.italic ? Face::Italic : Face::Regular;
    const Canvas::TextStyle style{label.size, face, label.align, label.colour};
    Vector2d pen = label.offset;
    if (label.anchor) {
      const auto anchor = projection.project(*label.anchor);
      if (!anchor) continue;
      const std::optional<LabelPlaces::Standing> place =
          places.place(label, flat(*anchor), canvas.textWidth(label.text, style));
      unnamed += !place;
      if (!place) continue;
      if (place->leader) canvas.stroke(flat(*anchor), *place->leader, 1.0, ink::leader);
      pen = place->pen;
    }
    canvas.text(pen, label.text, style);
  }
  return unnamed;
}

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

// Title, subtitle and remarks, as large as the shorter side of the page asks, but never too small
// to be read, each in as many lines as it takes and below those before.
void drawTitle(const Picture& picture, const std::vector<Remark>& remarks, Canvas& canvas) {
  constexpr double kLeft = 32.0, kFirst = 46.0, kLegible = 10.0;  // [px] of 720
  const double small = std::min(1.0, canvas.width() / canvas.height());
  const double left = kLeft * small, width = canvas.width() - 2.0 * left;
  double baseline = kFirst * small;
  const auto draw = [&](const std::string& text, double size, double advance, Face face,
                        const Colour& colour) {
    const double share = std::max(small, std::min(1.0, kLegible / size));
    const Canvas::TextStyle style{size * share, face, Align::Left, colour};
    for (const std::string& line : canvas.lines(text, width, style)) {
      canvas.text({left, baseline}, line, style);
      baseline += advance * share;
    }
  };
  draw(picture.title, 22.0, 26.0, Face::Bold, ink::text);
  const bool titled = !picture.title.empty();
  if (titled) baseline = std::max(baseline - 2.0 * small, 70.0 * small);
  draw(picture.subtitle, 15.0, 19.0, Face::Regular, ink::secondary);
  baseline += 11.0 * small;
  if (titled) baseline = std::max(baseline, 100.0 * small);
  for (const Remark& remark : remarks) draw(remark.text, 13.0, 19.0, Face::Regular, remark.colour);
}

}  // namespace

void drawOverlay(const Picture& picture, const Projection& projection, Canvas& canvas) {
  if (picture.floor.visible && picture.floor.rule) drawRule(picture, projection, canvas);
  const double beads =
      beadSize(std::count_if(picture.lines.begin(), picture.lines.end(), isDotted));
  for (const Polyline& line : picture.lines)
    if (isDotted(line)) drawDots(line, beads, projection, canvas);
  const std::vector<double> drops = dropsOf(picture.marks, projection, canvas);
  for (std::size_t n = 0; n < drops.size(); ++n)
    drawMark(picture.marks[n], drops[n], projection, canvas);
  for (const PageShape& shape : picture.pageShapes) drawPageShape(shape, canvas);
  for (const PageBar& bar : picture.pageBars) drawBar(bar, projection, canvas);
  const int unnamed = drawLabels(picture, drops, projection, canvas);
  if (picture.bar) drawColourBar(*picture.bar, canvas);
  std::vector<Remark> remarks = picture.remarks;
  if (unnamed > 0 && !picture.title.empty())
    remarks.push_back(
        {std::to_string(unnamed) +
             (unnamed == 1 ? " body is hidden, or stands" : " bodies are hidden, or stand") +
             " too close for a name",
         ink::secondary});
  drawTitle(picture, remarks, canvas);
}

}  // namespace tumble
