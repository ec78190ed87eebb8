#include "app/present/inertia.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/claim/free_body.h"
#include "app/present/bodies.h"
#include "app/present/named.h"
#include "app/present/palette.h"
#include "sim/body/principal_axes.h"

namespace tumble {

namespace {

/// P lies along v: drawn together they have to differ.
constexpr Colour kMomentum = hex(0x1F7A6E);

constexpr double kAbove = 1.004;   // lines lie a little above their surface
constexpr int kCurvePoints = 120;  // of a closed curve

/// Principal axes of a body that can spin, the moments rising.
std::optional<PrincipalAxes> principalOf(const BodyDef& body) {
  if (!moves(body)) return {};
  const Mat3 inertia = massOf(body).inertia;
  if (!(inertia.trace() > 0.0)) return {};
  const PrincipalAxes found = principalAxes(inertia);
  std::array order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return found.moments[a] < found.moments[b]; });
  PrincipalAxes rising;
  for (int k = 0; k < 3; ++k) {
    rising.moments[k] = found.moments[order[static_cast<std::size_t>(k)]];
    rising.axes.col(k) = found.axes.col(order[static_cast<std::size_t>(k)]);
  }
  if (rising.axes.determinant() < 0.0) rising.axes.col(2) = -rising.axes.col(2);
  return rising;
}

Instance glassEllipsoid(const Vec3& x, const Quat& q, const Vec3& semiAxes) {
  Instance instance;
  instance.form = Form::Ellipsoid;
  instance.finish = Finish::Glass;
  instance.position = x;
  instance.orientation = q;
  instance.scale = semiAxes;
  instance.colour = colour::kFixed;
  return instance;
}

/// A closed curve of constant D = L²/(2T), I₁ < D < I₃, on the ellipsoid Σ Iᵢ ωᵢ² = 1: about the
/// axis of the largest moment for D > I₂, else about that of the smallest.
///   ω = (√a cos φ, √b sin φ) in the two other axes; both equations solved for their squares.
std::vector<Vec3> closedCurve(const Vec3& I, double D, double side) {
  const bool large = D > I[1];
  const int pole = large ? 2 : 0, other = large ? 0 : 2;
  const double rest = std::abs(I[pole] - D);
  const double a = rest / (I[other] * std::abs(I[pole] - I[other]));
  const double b = rest / (I[1] * std::abs(I[pole] - I[1]));
  std::vector<Vec3> points;
  for (int k = 0; k <= kCurvePoints; ++k) {
    const double phi = 2.0 * std::numbers::pi * k / kCurvePoints;
    Vec3 omega;
    omega[other] = std::sqrt(a) * std::cos(phi);
    omega[1] = std::sqrt(b) * std::sin(phi);
    const double square = 1.0 - I[other] * omega[other] * omega[other] - I[1] * omega[1] * omega[1];
    omega[pole] = side * std::sqrt(std::max(0.0, square) / I[pole]);
    points.push_back(omega);
  }
  return points;
}

/// Curves of other momenta: three about each stable pole, and the separatrix as its own limit.
std::vector<std::vector<Vec3>> otherCurves(const Vec3& I) {
  std::vector<std::vector<Vec3>> curves;
  const bool threeAxes = I[1] - I[0] > 1e-3 * I[2] && I[2] - I[1] > 1e-3 * I[2];
  if (!threeAxes) return curves;
  for (const double share : {0.12, 0.45, 1.0 - 1e-9})
    for (const double side : {-1.0, 1.0}) {
      curves.push_back(closedCurve(I, I[2] - share * (I[2] - I[1]), side));
      if (share < 0.9) curves.push_back(closedCurve(I, I[0] + share * (I[1] - I[0]), side));
    }
  return curves;
}

}  // namespace

std::optional<Instance> inertiaEllipsoid(const BodyDef& body, const BodySample& sample) {
  const std::optional<PrincipalAxes> principal = principalOf(body);
  if (!principal) return {};
  const Vec3& I = principal->moments;
  const Vec3 squares = 2.5 / massOf(body).mass * (Vec3::Constant(I.sum()) - 2.0 * I);
  return glassEllipsoid(sample.x, sample.q * Quat(principal->axes),
                        squares.cwiseMax(0.0).cwiseSqrt());
}

void addInertiaEllipsoids(const Scene& scene, const Sample& sample, Picture& picture) {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i)
    if (const auto ellipsoid = inertiaEllipsoid(scene.world.bodies[i], sample.bodies[i]))
      picture.instances.push_back(*ellipsoid);
}

void addPolhodes(const Scene& scene, const Recording& recording, const Sample& sample,
                 Picture& picture) {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodySample& body = sample.bodies[i];
    const std::optional<PrincipalAxes> principal = principalOf(scene.world.bodies[i]);
    if (!principal) continue;
    const Quat toWorld = body.q * Quat(principal->axes);
    const Vec3 omega = toWorld.conjugate() * body.omega;
    const double twiceT = principal->moments.dot(omega.cwiseAbs2());
    if (!(twiceT > 0.0)) continue;

    // Metres for a radian per second: the longest semi-axis a little longer than the body.
    const Vec3 semiAxes = (twiceT * principal->moments.cwiseInverse()).cwiseSqrt();
    const double metres =
        kPoinsotReach * boundingRadius(scene.world.bodies[i].shape) / semiAxes.maxCoeff();
    picture.instances.push_back(glassEllipsoid(body.x, toWorld, metres * semiAxes));
    const auto place = [&](const Vec3& omega_P) -> Eigen::Vector3d {
      return body.x + toWorld * (kAbove * metres * omega_P);
    };
    for (const std::vector<Vec3>& curve : otherCurves(principal->moments)) {
      Polyline line;
      for (const Vec3& point : curve) line.points.push_back(place(std::sqrt(twiceT) * point));
      line.colour = colour::kQuiet;
      line.width = 0.9f;
      picture.lines.push_back(std::move(line));
    }
    Polyline polhode;
    for (const Sample& other : recording.samples)
      polhode.points.push_back(
          place((other.bodies[i].q * Quat(principal->axes)).conjugate() * other.bodies[i].omega));
    polhode.colour = colour::kForce;
    polhode.width = 2.4f;
    picture.lines.push_back(std::move(polhode));
    addNamedArrow(body.x, metres * body.omega, colour::kAngular, "ω", picture, true);
  }
}

void addMomenta(const Scene& scene, const Recording& recording, const Sample& sample,
                Picture& picture) {
  const std::vector<BodyDef>& bodies = scene.world.bodies;
  const auto angular = [&](const Sample& at, std::size_t i) {
    return angularMomentum(massOf(bodies[i]).inertia, at.bodies[i].q, at.bodies[i].omega);
  };
  double P = 0.0, L = 0.0, omega = 0.0, length = 0.0;
  for (const BodyDef& body : bodies)
    if (moves(body)) length = std::max(length, kMomentaReach * boundingRadius(body.shape));
  for (const Sample& other : recording.samples)
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (!moves(bodies[i])) continue;
      P = std::max(P, massOf(bodies[i]).mass * other.bodies[i].v.norm());
      L = std::max(L, angular(other, i).norm());
      omega = std::max(omega, other.bodies[i].omega.norm());
    }
  // What is nothing but rounding beside the other momentum has no arrow.
  constexpr double kRounding = 1e-9;
  if (P * length < kRounding * L) P = 0.0;
  if (L < kRounding * P * length) L = omega = 0.0;
  const auto share = [&](double largest) { return largest > 0.0 ? length / largest : 0.0; };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!moves(bodies[i])) continue;
    const BodySample& body = sample.bodies[i];
    addNamedArrow(body.x, share(P) * massOf(bodies[i]).mass * body.v, kMomentum, "P", picture);
    addNamedArrow(body.x, share(L) * angular(sample, i), colour::kInk, "L", picture);
    // L and ω may point the same way.
    addNamedArrow(body.x, share(omega) * body.omega, colour::kAngular, "ω", picture, true);
  }
}

}  // namespace tumble
