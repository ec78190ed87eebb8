// The rule: a measured line on the floor, clear of the bodies and of other writing.
#include <algorithm>
#include <cmath>

#include "render/overlay.h"

namespace tumble {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Where a rule may lie: parallel to one horizontal axis, on the onlooker's side of all bodies.
struct Rail {
  int axis, other;   ///< 0: x, 2: z
  double low, high;  ///< [m] along the axis
  double start,
      outward;  ///< [m] where the bodies end across it, and the sign that leads away from them
  double step;  ///< [m] between ticks
};

struct Tick {
  double value;
  Vector2d place, inward;  ///< on the image, and the unit direction back to the bodies
};
constexpr double kNumber = 32.0;   ///< [px] across that a number under a tick may take
constexpr std::size_t kLeast = 3;  ///< ticks: two in a corner, of four or more, measure nothing

using Ticks = std::vector<Tick>;
using Boxes = std::vector<Eigen::AlignedBox2d>;

/// 1, 2 or 5 times a power of ten that cuts `length` into four to ten parts.
double stepFor(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  const double leading = length / power;
  return (leading < 2.0 ? 0.2 : leading < 4.0 ? 0.5 : 1.0) * power;
}

/// The next of 1, 2 and 5 times powers of ten.
double coarser(double step) {
  const double leading = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
  return step * (leading > 1.5 && leading < 3.0 ? 2.5 : 2.0);
}

/// Bounds of the motion, or else of all bodies.
Eigen::AlignedBox3d measured(const Picture& picture) {
  Eigen::AlignedBox3d box = picture.floor.motion;
  if (box.isEmpty())
    for (const Instance& body : picture.instances)
      box.extend(boxAround(body.position, std::min(reachOf(body), picture.radius)));
  return box;
}

/// The part of that along an axis which lies within the part of the floor that shows.
std::pair<double, double> boundsOf(const Picture& picture, int axis) {
  const Eigen::AlignedBox3d box = measured(picture);
  return {std::max(box.min()[axis], picture.centre[axis] - 1.2 * picture.radius),
          std::min(box.max()[axis], picture.centre[axis] + 1.2 * picture.radius)};
}

/// Along the axis that lies most across the image; nothing if no body stands on the floor that
/// shows.
std::optional<Rail> railOf(const Picture& picture, const Projection& projection) {
  const int axis = std::abs(projection.right().x()) >= std::abs(projection.right().z()) ? 0 : 2;
  const int other = 2 - axis;
  auto [low, high] = boundsOf(picture, axis);
  const auto [back, front] = boundsOf(picture, other);
  if (!(high > low) || !(front > back)) return std::nullopt;
  if (high - low < 0.5 * picture.radius) {  // small bodies on a long way: measure the way
    low = picture.centre[axis] - 0.6 * picture.radius;
    high = picture.centre[axis] + 0.6 * picture.radius;
  }
  const double outward = projection.forward()[other] < 0.0 ? 1.0 : -1.0;
  return Rail{axis, other, low, high, outward > 0.0 ? front : back, outward, stepFor(high - low)};
}

/// Whole steps within the motion that land well inside the image, at a gap [m] from the bodies.
Ticks ticksAt(const Rail& rail, double gap, const Picture& picture, const Projection& projection,
              const Canvas& canvas) {
  const auto project = [&](double value, double away) {
    Vector3d point;
    point[rail.axis] = value;
    point[1] = picture.floor.height;
    point[rail.other] = rail.start + rail.outward * away;
    return projection.project(point);
  };
  Ticks ticks;
  for (double k = std::ceil(rail.low / rail.step - 1e-9);
       k * rail.step <= rail.high + 1e-9 * rail.step; k += 1.0) {
    const auto place = project(k * rail.step, gap),
               inward = project(k * rail.step, gap - 0.01 * picture.radius);
    if (!place || !inward) continue;
    const Vector2d p = place->head<2>();
    if (p.x() > 24.0 && p.x() < canvas.width() - 24.0 && p.y() < canvas.height() - 24.0)
      ticks.push_back({k * rail.step, p, (inward->head<2>() - p).normalized()});
  }
  return ticks;
}

/// Whether ticks measure nothing, or leave out more than an eighth of what is to be measured.
bool tooFew(const Ticks& ticks, const Rail& rail) {
  const double whole =
      std::floor(rail.high / rail.step + 1e-9) - std::ceil(rail.low / rail.step - 1e-9) + 1.0;
  return ticks.size() < kLeast || static_cast<double>(ticks.size()) < 0.875 * whole;
}

/// Where the labels of points stand, about.
void addLabelBoxes(const std::vector<Label>& labels, const Projection& projection, Canvas& canvas,
                   Boxes& boxes) {
  for (const Label& label : labels) {
    if (!label.anchor) continue;
    const auto place = projection.project(*label.anchor);
    if (!place) continue;
    const Face face = label.bold ? Face::Bold : label.italic ? Face::Italic : Face::Regular;
    const double width =
        canvas.textWidth(label.text, {label.size, face, label.align, label.colour});
    const double left = label.align == Align::Left     ? 0.0
                        : label.align == Align::Centre ? -0.5 * width
                                                       : -width;
    const Vector2d pen = place->head<2>() + label.offset + Vector2d(left, 0.0);
    boxes.emplace_back(pen - Vector2d(4.0, label.size + 4.0), pen + Vector2d(width + 4.0, 8.0));
  }
}

/// Where a colour bar stands, with its words.
Eigen::AlignedBox2d barBox(const Canvas& canvas) {
  const Vector2d corner(canvas.width(), canvas.height());
  return {corner - Vector2d(340.0, 64.0), corner};
}

/// Where else something is written on the image, or on any of its run: marks, labels, colour bar,
/// titles.
Boxes writtenBoxes(const Picture& picture, const Projection& projection, Canvas& canvas) {
  Boxes boxes;
  const bool run = !picture.floor.motion.isEmpty();
  addLabelBoxes(run ? picture.floor.labels : picture.labels, projection, canvas, boxes);
  for (const Mark& mark : run ? picture.floor.marks : picture.marks)
    if (const auto place = projection.project(mark.position))
      boxes.emplace_back(
          place->head<2>() - Vector2d(52.0, 8.0),
          place->head<2>() + Vector2d(52.0, 40.0 + 18.0 * static_cast<double>(mark.lines.size())));
  if (picture.bar) boxes.push_back(barBox(canvas));
  boxes.emplace_back(Vector2d(0.0, 0.0), Vector2d(canvas.width(), 90.0));
  return boxes;
}

/// Where bodies are seen in the course of the run, or now.
Boxes bodyBoxes(const Picture& picture, const Projection& projection) {
  std::vector<Eigen::AlignedBox3d> ways = picture.floor.ways;
  if (ways.empty())
    for (const Instance& body : picture.instances)
      ways.push_back(boxAround(body.position, std::min(reachOf(body), picture.radius)));
  Boxes boxes;
  for (const Eigen::AlignedBox3d& way : ways) {
    Eigen::AlignedBox2d& box = boxes.emplace_back();
    for (int corner = 0; corner < 8; ++corner)
      if (const auto place =
              projection.project(way.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner))))
        box.extend(Vector2d(place->head<2>()));
  }
  return boxes;
}

/// Pixels from tick to tick, on the mean.
double spacing(const Ticks& ticks) {
  return (ticks.back().place - ticks.front().place).norm() / static_cast<double>(ticks.size() - 1);
}

bool collides(const Ticks& ticks, const Boxes& boxes) {
  const Vector2d from = ticks.front().place, along = ticks.back().place - from;
  for (const Eigen::AlignedBox2d& box : boxes) {
    for (int i = 0; i <= 100; ++i)
      if (box.contains(from + 0.01 * i * along)) return true;
    for (const Tick& tick : ticks)
      if (box.intersects({tick.place + Vector2d(-20.0, 8.0), tick.place + Vector2d(24.0, 24.0)}))
        return true;
  }
  return false;
}

/// Without the ticks at its ends that stand in one of the boxes, as long as a rule is left.
Ticks trimmed(Ticks ticks, const Boxes& boxes) {
  const auto stands = [&](const Tick& tick) {
    const Eigen::AlignedBox2d room(tick.place + Vector2d(-20.0, -4.0),
                                   tick.place + Vector2d(24.0, 24.0));
    return std::any_of(boxes.begin(), boxes.end(),
                       [&](const Eigen::AlignedBox2d& box) { return box.intersects(room); });
  };
  while (ticks.size() > kLeast && stands(ticks.back())) ticks.pop_back();
  while (ticks.size() > kLeast && stands(ticks.front())) ticks.erase(ticks.begin());
  return ticks;
}

struct Unit {
  double length;  ///< [m]
  const char* name;
};

/// The unit in which a step takes few digits.
Unit unitOf(double step) {
  if (step < 5e-9) return {1e-9, "nm"};
  if (step < 5e-6) return {1e-6, "\u00B5m"};
  if (step < 5e-3) return {1e-3, "mm"};
  return step < 1e3 ? Unit{1.0, "m"} : Unit{1e3, "km"};
}

const Canvas::TextStyle kNumberStyle{13.0, Face::Regular, Align::Centre, ink::secondary};

/// Pixels from tick to tick that the numbers need.
double roomOf(const Ticks& ticks, double step, Canvas& canvas) {
  constexpr double kApart = 8.0;  // [px]
  const Unit unit = unitOf(step);
  double room = kNumber;
  for (const Tick& tick : ticks)
    room = std::max(
        room, kApart + canvas.textWidth(formatTick(tick.value / unit.length, step / unit.length),
                                        kNumberStyle));
  return room;
}

void drawTicks(const Ticks& ticks, double step, Canvas& canvas) {
  const Unit unit = unitOf(step);
  canvas.stroke(ticks.front().place, ticks.back().place, 1.8, ink::secondary);
  const bool leftToRight = ticks.front().place.x() < ticks.back().place.x();
  const double unitAt = leftToRight ? ticks.back().value : ticks.front().value;
  for (const Tick& tick : ticks) {
    canvas.stroke(tick.place - 5.0 * tick.inward, tick.place + 5.0 * tick.inward, 1.8,
                  ink::secondary);
    const std::string text = formatTick(tick.value / unit.length, step / unit.length) +
                             (tick.value == unitAt ? std::string(" ") + unit.name : "");
    canvas.text(tick.place + Vector2d(2.0, 21.0), text, kNumberStyle);
  }
}

}  // namespace

void drawRule(const Picture& picture, const Projection& projection, Canvas& canvas) {
  std::optional<Rail> rail = railOf(picture, projection);
  if (!rail) return;
  // As near to the bodies as other writing allows; where it never does, just in front of them.
  const Boxes boxes = writtenBoxes(picture, projection, canvas);
  double nearest = 0.12 * picture.radius;
  Ticks chosen = ticksAt(*rail, nearest, picture, projection, canvas);
  while (chosen.size() > kLeast && spacing(chosen) <= roomOf(chosen, rail->step, canvas)) {
    rail->step = coarser(rail->step);
    chosen = ticksAt(*rail, nearest, picture, projection, canvas);
  }
  // What comes nearer than the image reaches leaves no room before it: then further back, up to
  // half way to the middle. Where room is lacking at one end alone, only if no body is in the way.
  const double depth = rail->outward * (rail->start - picture.centre[rail->other]);
  const Boxes bodies = tooFew(chosen, *rail) ? bodyBoxes(picture, projection) : Boxes();
  for (double gap = nearest; tooFew(chosen, *rail) && gap > -0.5 * depth;) {
    gap -= 0.04 * picture.radius;
    const Ticks ticks = ticksAt(*rail, gap, picture, projection, canvas);
    if (chosen.size() >= kLeast && (tooFew(ticks, *rail) || collides(ticks, bodies))) continue;
    chosen = ticks;
    nearest = gap;
  }
  for (double gap = nearest; gap < picture.radius; gap += 0.04 * picture.radius) {
    const Ticks ticks = ticksAt(*rail, gap, picture, projection, canvas);
    if (ticks.size() < kLeast || 5 * ticks.size() < 3 * chosen.size())
      break;  // too much of it is lost
    if (collides(ticks, boxes)) continue;
    chosen = ticks;
    break;
  }
  if (picture.bar) chosen = trimmed(chosen, {barBox(canvas)});
  if (chosen.size() >= kLeast && spacing(chosen) > roomOf(chosen, rail->step, canvas))
    drawTicks(chosen, rail->step, canvas);
}

}  // namespace tumble
