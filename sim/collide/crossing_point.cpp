#include "sim/collide/crossing_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tumble {
namespace {

// [1] The largest turn of a crossing along a rim at once.
constexpr double kTurn = 0.5;
constexpr int kMostMoves = 32;

// Moves a point by `way` [m] along its edge, or round its rim by no more than that turn.
void goAlong(Vec3& p, Vec3& out, const Vec3& along, double way, double rim, const Vec3& centre) {
  if (rim == 0.0) {
    p += way * along;
    return;
  }
  out = (out + std::clamp(way / rim, -kTurn, kTurn) * along).normalized();
  p = centre + rim * out;
}

Vec3 bendOf(double rim, const Vec3& out) {
  return rim > 0.0 ? Vec3(-out / rim) : Vec3(Vec3::Zero());
}

}  // namespace

Vec3 crossingAlongA(const ContactPoint& c) {
  return c.rimA > 0.0 ? Vec3(c.n.cross(c.ea).normalized()) : c.ea;
}

Vec3 crossingAlongB(const ContactPoint& c) {
  return c.rimB > 0.0 ? Vec3(c.n.cross(c.eb).normalized()) : c.eb;
}

void alignCrossing(ContactPoint& c, const Vec3& fromA, const Vec3& fromB) {
  c.pa = fromA + c.rimA * c.ea;
  c.pb = fromB + c.rimB * c.eb;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostMoves; ++k) {
    const Vec3 ta = crossingAlongA(c), tb = crossingAlongB(c), way = c.pa - c.pb;
    const double sine = c.n.dot(ta.cross(tb));
    double alongA = -c.n.dot(way.cross(tb)) / sine, alongB = -c.n.dot(way.cross(ta)) / sine;
    const double size = std::max(std::abs(alongA), std::abs(alongB));
    if (!std::isfinite(size) || size >= last) return;
    last = size;
    goAlong(c.pa, c.ea, ta, alongA, c.rimA, fromA);
    goAlong(c.pb, c.eb, tb, alongB, c.rimB, fromB);
  }
}

Slant::Slant(const ContactPoint& c) : Slant(c, crossingAlongA(c), crossingAlongB(c)) {}

Slant::Slant(const ContactPoint& c, const Vec3& alongA, const Vec3& alongB)
    : ta(alongA),
      tb(alongB),
      bendA(bendOf(c.rimA, c.ea)),
      bendB(bendOf(c.rimB, c.eb)),
      growthA_(1.0 + (c.pa - c.pb).dot(bendA)),
      growthB_(1.0 - (c.pa - c.pb).dot(bendB)),
      cosine_(ta.dot(tb)) {}

std::pair<double, double> Slant::ways(double a, double b) const {
  const double determinant = cosine_ * cosine_ - growthA_ * growthB_;
  return {(growthB_ * a - cosine_ * b) / determinant, (cosine_ * a - growthA_ * b) / determinant};
}

void alignSlant(ContactPoint& c, const Vec3& fromA, const Vec3& fromB, const Vec3& alongA,
                const Vec3& alongB) {
  c.pa = fromA + c.rimA * c.ea;
  c.pb = fromB + c.rimB * c.eb;
  if (c.rimA == 0.0) c.ea = alongA;
  if (c.rimB == 0.0) c.eb = alongB;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0;; ++k) {
    const Slant slant(c, c.rimA > 0.0 ? Vec3(alongA.cross(c.ea)) : alongA,
                      c.rimB > 0.0 ? Vec3(alongB.cross(c.eb)) : alongB);
    const Vec3 across = slant.ta.cross(slant.tb).normalized(), way = c.pa - c.pb;
    c.n = across.dot(c.n) < 0.0 ? Vec3(-across) : across;
    c.separation = c.n.dot(way) - c.ra - c.rb;
    const auto [wayA, wayB] = slant.ways(slant.ta.dot(way), slant.tb.dot(way));
    const double size = std::max(std::abs(wayA), std::abs(wayB));
    if (!std::isfinite(size) || size >= last || k == kMostMoves) return;
    last = size;
    goAlong(c.pa, c.ea, slant.ta, wayA, c.rimA, fromA);
    goAlong(c.pb, c.eb, slant.tb, wayB, c.rimB, fromB);
  }
}

}  // namespace tumble
