#include "render/overlay.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/heading.h"
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

constexpr double kEdge = 6.0;  // [px] of the page, that no words come nearer to

bool isOn(const Vector2d& point, const Canvas& canvas) {
  return point.x() >= 0.0 && point.y() >= 0.0 && point.x() <= canvas.width() &&
         point.y() <= canvas.height();
}

/// How far what is cut by the edge of the page has to move so as not to be [px]; 0 if it is not.
Vector2d inwards(const Eigen::AlignedBox2d& ink, const Canvas& canvas) {
  const Vector2d page(canvas.width(), canvas.height());
  Vector2d way = Vector2d::Zero();
  for (const int axis : {0, 1}) {
    if (ink.max()[axis] > page[axis]) way[axis] = page[axis] - kEdge - ink.max()[axis];
    if (ink.min()[axis] + way[axis] < 0.0) way[axis] = kEdge - ink.min()[axis];
  }
  return way;
}

const Canvas::TextStyle kMarkWords{14.0, Face::Regular, Align::Centre, ink::text};

/// From a mark to the middle of the baseline of its i-th line [px].
Vector2d wordsOffset(std::size_t i) {
  return {0.0, 49.0 + 18.0 * static_cast<double>(i)};
}

/// How far the lines of a mark move to the side so as not to be cut [px].
double asideOf(const Mark& mark, const Vector2d& centre, Canvas& canvas) {
  double widest = 0.0;
  for (const std::string& line : mark.lines)
    widest = std::max(widest, canvas.textWidth(line, kMarkWords));
  if (!isOn(centre, canvas)) return 0.0;
  return inwards(inkOf(centre, widest, 0.0, Align::Centre), canvas).x();
}

/// What the lines of a mark cover, as many pixels further down than they would like to stand.
std::vector<Eigen::AlignedBox2d> wordsOf(const Mark& mark, const Vector2d& centre, double drop,
                                         Canvas& canvas) {
  const Vector2d way(asideOf(mark, centre, canvas), drop);
  std::vector<Eigen::AlignedBox2d> boxes;
  for (std::size_t i = 0; i < mark.lines.size(); ++i)
    boxes.push_back(inkOf(centre + wordsOffset(i) + way,
                          canvas.textWidth(mark.lines[i], kMarkWords), kMarkWords.size,
                          Align::Centre));
  return boxes;
}

/// Where the lines of a mark go if below it the page ends: above it [px].
double aboveOf(const Mark& mark) {
  return -wordsOffset(mark.lines.size()).y() - 6.0;
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
    std::vector<double> wanted = {0.0, 18.0, 36.0, 54.0, 72.0};
    const double next = flat(*place).y() + wordsOffset(marks[n].lines.size()).y();
    if (!marks[n].lines.empty() && isOn(flat(*place), canvas) && next > canvas.height() + 18.0)
      wanted = {aboveOf(marks[n]), aboveOf(marks[n]) - 18.0, aboveOf(marks[n]) - 36.0};
    drops[n] = wanted.front();
    for (const double drop : wanted) {
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
  const Vector2d centre = flat(*place), down(asideOf(mark, centre, canvas), drop);
  const double to = drop < 0.0 ? wordsOffset(mark.lines.size() - 1).y() + drop + 4.0 : 34.0 + drop;
  if (!mark.lines.empty())
    canvas.stroke(centre + Vector2d(0.0, drop < 0.0 ? -6.0 : 6.0), centre + Vector2d(0.0, to), 1.0,
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

Canvas::TextStyle styleOf(const Label& label) {
  const Face face = label.bold ? Face::Bold : label.italic ? Face::Italic : Face::Regular;
  return {label.size, face, label.align, label.colour};
}

/// A label as it can be read: on as many lines as keep it on the page, and moved in from the edge
/// unless it looks for its place itself.
struct Written {
  Label label;
  Drawing::Words words;
  LabelPlaces::Extent extent;
  double step;  ///< [px] from line to line
};

Written writtenOf(Label label, const Vector2d& anchor, Canvas& canvas) {
  constexpr std::size_t kMost = 4;                                // lines
  constexpr double kShare = 0.45, kLeast = 0.3, kLeading = 1.25;  // of the page, of the size
  const Canvas::TextStyle style = styleOf(label);
  const Vector2d pen = anchor + label.offset;
  Written written{label, {{label.text}, label.size}, canvas.textWidth(label.text, style), 0.0};
  if (!isOn(label.anchor ? anchor : pen, canvas)) return written;
  Eigen::AlignedBox2d ink = inkOf(pen, written.extent, label.size, label.align);
  if (inwards(ink, canvas).isZero(0.0)) return written;

  // In lines as wide as there is room for where it begins, if this is not too little.
  const double page = canvas.width(), right = page - pen.x();
  const double free = label.align == Align::Left    ? right
                      : label.align == Align::Right ? pen.x()
                                                    : 2.0 * std::min(pen.x(), right);
  const double room =
      label.apart ? kShare * page : std::clamp(free - kEdge, kLeast * page, page - 2.0 * kEdge);
  if (written.extent.width > room) {
    written.words =
        canvas.fitted(label.text, room, kMost, style, std::min<double>(label.size, kLegible));
    written.label.size = static_cast<float>(written.words.size);
    written.step = kLeading * written.words.size;
    written.extent = {0.0, written.words.below(written.step)};
    for (const std::string& line : written.words.lines)
      written.extent.width =
          std::max(written.extent.width, canvas.textWidth(line, styleOf(written.label)));
    ink = inkOf(pen, written.extent, written.words.size, label.align);
  }
  if (!label.apart) written.label.offset += inwards(ink, canvas);
  return written;
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
  // What was to be one line of the page and takes more keeps others off.
  for (const Label& wanted : picture.labels) {
    if (wanted.anchor) continue;
    const Written written = writtenOf(wanted, Vector2d::Zero(), canvas);
    if (written.words.lines.size() > 1)
      places.take(inkOf(written.label.offset, written.extent, written.label.size, wanted.align));
  }
  for (const Label& wanted : picture.labels) {
    Vector2d anchor = Vector2d::Zero();
    if (wanted.anchor) {
      const auto place = projection.project(*wanted.anchor);
      if (!place) continue;
      anchor = flat(*place);
    }
    const auto [label, words, extent, step] = writtenOf(wanted, anchor, canvas);
    Vector2d pen = anchor + label.offset;
    if (label.anchor) {
      const std::optional<LabelPlaces::Standing> place = places.place(label, anchor, extent);
      unnamed += !place;
      if (!place) continue;
      if (place->leader) canvas.stroke(anchor, *place->leader, 1.0, ink::leader);
      pen = place->pen;
      if (isOn(anchor, canvas)) pen += inwards(inkOf(pen, extent, label.size, label.align), canvas);
    }
    canvas.text(pen, words, step, styleOf(label));
  }
  return unnamed;
}

void drawBar(const PageBar& bar, const Projection& projection, Canvas& canvas) {
  constexpr double kThick = 8.0;  // [px]
  if (bar.leader)
    if (const auto place = projection.project(*bar.leader))
      canvas.stroke(flat(*place), bar.base - Vector2d(8.0, 0.0), 1.0, ink::leader);
  canvas.fill(bar.base - Vector2d(0.0, 0.5 * kThick), {bar.length, kThick}, bar.colour);
  const Vector2d pen = bar.base + Vector2d(bar.length + 10.0, 5.0);
  const Canvas::TextStyle style{14.0, Face::Regular, Align::Left, ink::text};
  canvas.text(pen, canvas.fitted(bar.text, canvas.width() - kEdge - pen.x(), 1, style, kLegible),
              0.0, style);
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
  constexpr double kLeft = 32.0, kFirst = 46.0;  // [px] of 720
  constexpr std::size_t kMost = 1000;            // lines
  const double small = std::min(1.0, canvas.width() / canvas.height());
  const double left = kLeft * small, width = canvas.width() - 2.0 * left;
  double baseline = kFirst * small;
  const auto draw = [&](const std::string& text, double size, double advance, Face face,
                        const Colour& colour) {
    const double share = std::max(small, std::min(1.0, kLegible / size));
    const Canvas::TextStyle style{size * share, face, Align::Left, colour};
    const Drawing::Words words =
        canvas.fitted(text, width, kMost, style, std::min(style.size, kLegible));
    canvas.text({left, baseline}, words, advance * share, style);
    baseline += advance * share * static_cast<double>(words.lines.size());
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
