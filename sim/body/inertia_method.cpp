#include "sim/body/inertia_method.h"

#include <stdexcept>

#include "sim/shape/interior.h"

namespace tumble {
namespace {

MassProperties bySurface(const Shape& shape, double mass, int, std::uint64_t) {
  return solidMass(shape, mass);
}

double cube(double x) {
  return x * x * x;
}

/// Slide SF25: simple, and as good as the box fits.
MassProperties byBox(const Shape& shape, double mass, int, std::uint64_t) {
  const Aabb box = boxAsGiven(shape);
  MassProperties properties = solidMass(Box{0.5 * (box.hi - box.lo)}, mass);
  properties.centre = 0.5 * (box.lo + box.hi);
  return properties;
}

/// Slide SF26:  x = Σ xᵢ/n,  I = m/n Σ (|rᵢ|² 1 − rᵢ rᵢᵀ) = −m/n Σ rᵢ* rᵢ*,  rᵢ = xᵢ − x.
MassProperties byPoints(const Shape& shape, double mass, const Samples& samples) {
  const Interior interior(shape);
  // Moments about the middle of the box, then moved to the centre of mass.
  const Aabb box = boxAsGiven(shape);
  const Vec3 middle = 0.5 * (box.lo + box.hi);
  double count = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (int i = 0; i < samples.count(); ++i) {
    const Vec3 p = samples[i];
    if (!interior.contains(p)) continue;
    const Vec3 r = p - middle;
    count += 1.0;
    first += r;
    second += r * r.transpose();
  }
  if (count == 0.0) throw std::invalid_argument("samples: no point is inside; take more");
  const Vec3 mean = first / count;
  const Mat3 spread = second / count - mean * mean.transpose();
  const Mat3 inertia = spread.trace() * Mat3::Identity() - spread;
  constexpr double kLine = 1e-14;  // of the cube of the trace
  if (!(inertia.determinant() > kLine * cube(inertia.trace())))
    throw std::invalid_argument("samples: the points inside lie on a line; take more");
  return {mass, mass * inertia, middle + mean};
}

template <Spread spread>
MassProperties bySamples(const Shape& shape, double mass, int samples, std::uint64_t seed) {
  return byPoints(shape, mass, Samples(spread, boxAsGiven(shape), samples, seed));
}

constexpr InertiaMethod kMethods[] = {
    {"surface", "exact: closed forms, or Green's theorem over the faces of a mesh", {}, bySurface},
    {"box", "that of the bounding box", {}, byBox},
    {"grid", "points on a grid", Spread::Grid, bySamples<Spread::Grid>},
    {"random", "random points", Spread::Random, bySamples<Spread::Random>},
    {"quasi", "quasi-random points", Spread::Quasi, bySamples<Spread::Quasi>},
};

}  // namespace

std::span<const InertiaMethod> inertiaMethods() {
  return kMethods;
}

const InertiaMethod* findInertiaMethod(std::string_view name) {
  for (const InertiaMethod& method : kMethods)
    if (method.name == name) return &method;
  return nullptr;
}

}  // namespace tumble
