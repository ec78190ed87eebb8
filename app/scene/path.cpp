// Bodies along a path on level ground – a circle or a spiral – and balls racked in a triangle.
#include <cmath>
#include <numbers>

#include "app/scene/generator.h"
#include "sim/math/root.h"
#include "sim/math/rotation.h"

namespace tumble {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kFinest = 1e-300;  // [rad] the root is found to neighbouring numbers

// A place on the path in polar coordinates about its centre: angle from X towards −Z, the way
// about Y. [rad], [m]
struct Polar {
  double angle = 0.0, radius = 0.0;
};

// Moves the copy from the centre, where the template has it, to the place, and turns its X into the
// direction of the path there: so much outward, so much round.
void put(BodyDef& copy, const Polar& at, double climb, double way) {
  double s = 0.0, c = 0.0;
  sinCos(at.angle, s, c);
  const Vec3 outward(c, 0.0, -s), round(-s, 0.0, -c);
  const Vec3 along = (climb * outward + way * round).normalized();
  copy.position += at.radius * outward;
  copy.orientation = turnTo(along) * copy.orientation;
}

// The spiral of Archimedes, radius = inner + pitch·angle/2π, outwards; from copy to copy straight
// over a chord of one length.
struct Spiral {
  double inner = 0.0, pitch = 1.0, spacing = 1.0;
  Polar at;  // of the last copy

  // Square of the chord from `at` to the point further round by an angle, less that of the
  // spacing [m²]; it rises up to half a turn.
  //   (r' − r)² + 4 r r' sin²(δ/2) − d²
  double excess(double further) const {
    double s = 0.0, c = 0.0;
    sinCos(0.5 * further, s, c);
    const double climb = pitch * (further / kTurn);
    return climb * climb + 4.0 * at.radius * (at.radius + climb) * s * s - spacing * spacing;
  }

  // One chord on; false if it would reach round more than half a turn.
  bool advance() {
    const double far = excess(std::numbers::pi);
    if (!(far > 0.0)) return false;
    const Bracket step = findRoot([&](double further) { return excess(further); }, 0.0,
                                  std::numbers::pi, excess(0.0), far, kFinest);
    at.angle += step.lo;
    at.radius = inner + pitch * (at.angle / kTurn);
    return true;
  }

  std::string place(int i, BodyDef& copy) {
    if (std::get_if<HalfSpace>(&copy.shape)) return "a spiral is made of bodies, not of planes";
    if (i > 0 && !advance())
      return "copy " + std::to_string(i) +
             " would lie more than half a turn from the one before; give a smaller spacing, or a "
             "larger inner or pitch";
    // From the very centre the path leads outward.
    put(copy, at, pitch / kTurn, at.radius);
    return "";
  }
};

// Rows of 1, 2, 3, … balls across a direction, each nestling in the one before: a triangular
// lattice.
struct Rack {
  double gap = 0.0;
  Vec3 along = Vec3::UnitX();
  int row = 0, column = 0;       // of the next copy
  std::optional<double> radius;  // [m] of every ball

  std::string place(BodyDef& copy) {
    const Sphere* ball = std::get_if<Sphere>(&copy.shape);
    if (!ball) return "a rack is made of balls, shape = { sphere = … }";
    if (radius && *radius != ball->r) return "all balls of a rack have one size";
    radius = ball->r;
    const double d = 2.0 * ball->r + gap;
    const Vec3 across(along.z(), 0.0, -along.x());  // to its left, seen from above
    copy.position += along * (0.5 * std::sqrt(3.0) * d * row) + across * (d * (column - 0.5 * row));
    if (column++ == row) {
      column = 0;
      ++row;
    }
    return "";
  }
};

void require(Section& array, const char* key) {
  if (!array.find(key)) array.complain(key, "missing");
}

}  // namespace

Generator makeCircle(Section& array, Weather&) {
  const int count = readCount(array);
  double radius = 1.0;
  array.read("radius", radius, positive("m"));
  require(array, "radius");
  const auto place = [count, radius](int i, BodyDef& copy) -> std::string {
    if (std::get_if<HalfSpace>(&copy.shape)) return "a circle is made of bodies, not of planes";
    put(copy, {kTurn * i / count, radius}, 0.0, 1.0);
    return "";
  };
  return {count, place, {}};
}

Generator makeSpiral(Section& array, Weather&) {
  const int count = readCount(array);
  Spiral spiral;
  array.read("inner", spiral.inner, notNegative("m"));
  array.read("pitch", spiral.pitch, positive("m"));
  array.read("spacing", spiral.spacing, positive("m"));
  for (const char* key : {"pitch", "spacing"}) require(array, key);
  spiral.at.radius = spiral.inner;
  const auto place = [spiral](int i, BodyDef& copy) mutable { return spiral.place(i, copy); };
  return {count, place, {}};
}

Generator makeRack(Section& array, Weather&) {
  constexpr int kMostRows = 446;  // 446·447/2 balls are below kMostCopies
  int rows = 1;
  Rack rack;
  array.read("rows", rows, 1, kMostRows);
  require(array, "rows");
  array.read("gap", rack.gap, notNegative("m"));
  rack.along = readLevelDirection(array);
  const auto place = [rack](int, BodyDef& copy) mutable { return rack.place(copy); };
  return {rows * (rows + 1) / 2, place, {}};
}

}  // namespace tumble
