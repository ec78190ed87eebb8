#include "sim/collide/ellipsoid.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

// [part of ρ₁] Radii that differ by less are one: the point is as round as a ball's.
constexpr double kRound = 1e-9;

}  // namespace

Vec3 outermostOnEllipsoid(const Vec3& half, const Mat3& R, const Vec3& m) {
  const Vec3 x = half.cwiseProduct(R.transpose() * m);
  return R * half.cwiseProduct(x / x.norm());
}

Osculating osculatingTorus(const Vec3& half, const Mat3& R, const Vec3& n) {
  const Vec3 n_B = R.transpose() * n, x = half.cwiseProduct(n_B);
  const double h = x.norm();
  const Vec3 p_B = half.cwiseProduct(x / h);

  // The second derivative of h across n, in two tangents: a symmetric matrix of radii.
  const Vec3 t = n_B.unitOrthogonal(), u = n_B.cross(t);
  const auto bent = [&](const Vec3& v, const Vec3& w) {
    return (half.cwiseProduct(v).dot(half.cwiseProduct(w)) - p_B.dot(v) * p_B.dot(w)) / h;
  };
  const double tt = bent(t, t), uu = bent(u, u), tu = bent(t, u);
  const double mean = 0.5 * (tt + uu), lean = 0.5 * (tt - uu);
  const double off = std::sqrt(lean * lean + tu * tu);
  const double longest = mean + off, shortest = (tt * uu - tu * tu) / longest;

  Osculating torus;
  torus.round = shortest;
  torus.axis.setZero();
  torus.centre = R * (p_B - shortest * n_B);
  if (!(longest - shortest > kRound * longest)) return torus;
  // Along the longest radius; of the two ways to write it the one that cancels nothing.
  const Vec3 along =
      lean >= 0.0 ? Vec3((off + lean) * t + tu * u) : Vec3(tu * t + (off - lean) * u);
  torus.rim = longest - shortest;
  torus.axis = R * n_B.cross(along.normalized());
  torus.centre = R * (p_B - longest * n_B);
  return torus;
}

void bendAsEllipsoidA(ContactPoint& c, const Vec3& x, const Mat3& R) {
  const Osculating torus = osculatingTorus(c.halfA, R, -c.n);
  c.pa = x + torus.centre;
  c.ra = torus.round;
  c.rimA = torus.rim;
  c.ea = torus.axis;
}

void bendAsEllipsoidB(ContactPoint& c, const Vec3& x, const Mat3& R) {
  const Osculating torus = osculatingTorus(c.halfB, R, c.n);
  c.pb = x + torus.centre;
  c.rb = torus.round;
  c.rimB = torus.rim;
  c.eb = torus.axis;
}

}  // namespace tumble
