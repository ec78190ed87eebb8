#include "sim/body/mass_surface.h"

#include <cmath>

namespace tumble {
namespace {

/// ∬ αᵖ βᑫ dα dβ over the shadow of a face on a plane of coordinates, as at[p][q], p + q ≤ 3.
struct ShadowMoments {
  double at[4][4] = {};
};

/// ∮ αᵖ⁺¹ βᑫ dβ / (p + 1) along the edges; a, b are the axes of the plane.
ShadowMoments shadowMoments(const Polyhedron& solid, const std::vector<int>& face,
                            const Vec3& origin, int a, int b) {
  const double off = 0.5 * std::sqrt(0.6);
  const double nodes[3] = {0.5 - off, 0.5, 0.5 + off};
  const double weights[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  ShadowMoments sum;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vec3 from = solid.points[static_cast<std::size_t>(face[k])] - origin;
    const Vec3 to = solid.points[static_cast<std::size_t>(face[(k + 1) % face.size()])] - origin;
    const double db = to[b] - from[b];
    for (int node = 0; node < 3; ++node) {
      const double alpha = from[a] + nodes[node] * (to[a] - from[a]);
      const double beta = from[b] + nodes[node] * db;
      double powerA = weights[node] * db;
      for (int p = 0; p <= 3; ++p) {
        powerA *= alpha;
        double term = powerA / (p + 1);
        for (int q = 0; p + q <= 3; ++q, term *= beta) sum.at[p][q] += term;
      }
    }
  }
  return sum;
}

/// What the volume integrals of 1, x, y, z, xx, yy, zz, xy, yz, zx are made of.
struct Sums {
  double one = 0.0;
  Vec3 first = Vec3::Zero(), squares = Vec3::Zero(), products = Vec3::Zero();
};

/// Adds one face. On it γ = −(u α + v β + w), and its normal is as (u, v, 1) in (α, β, γ).
void addFace(const Polyhedron& solid, const std::vector<int>& face, const Vec3& origin,
             Sums& sums) {
  const Vec3 n = areaVector(solid, face);
  int c = 0;
  n.cwiseAbs().maxCoeff(&c);
  const int a = (c + 1) % 3, b = (c + 2) % 3;
  const double u = n[a] / n[c], v = n[b] / n[c];
  const Vec3 p0 = solid.points[static_cast<std::size_t>(face[0])] - origin;
  const double w = -(u * p0[a] + v * p0[b] + p0[c]);
  const ShadowMoments shadow = shadowMoments(solid, face, origin, a, b);
  const auto& m = shadow.at;

  // ∬ γ, γγ, γγγ, ββγ, γγα dα dβ.
  const double g = -(u * m[1][0] + v * m[0][1] + w * m[0][0]);
  const double gg = u * (u * m[2][0] + 2.0 * (v * m[1][1] + w * m[1][0])) +
                    v * (v * m[0][2] + 2.0 * w * m[0][1]) + w * w * m[0][0];
  const double gga = u * (u * m[3][0] + 2.0 * (v * m[2][1] + w * m[2][0])) +
                     v * (v * m[1][2] + 2.0 * w * m[1][1]) + w * w * m[1][0];
  const double ggb = u * (u * m[2][1] + 2.0 * (v * m[1][2] + w * m[1][1])) +
                     v * (v * m[0][3] + 2.0 * w * m[0][2]) + w * w * m[0][1];
  const double ggg = -(u * gga + v * ggb + w * gg);
  const double bbg = -(u * m[1][2] + v * m[0][3] + w * m[0][2]);

  // Each volume integral takes the part of the normal along the variable that was integrated.
  sums.one += c == 0 ? g : a == 0 ? u * m[1][0] : v * m[0][1];
  sums.first[a] += 0.5 * u * m[2][0];
  sums.first[b] += 0.5 * v * m[0][2];
  sums.first[c] += 0.5 * gg;
  sums.squares[a] += u * m[3][0] / 3.0;
  sums.squares[b] += v * m[0][3] / 3.0;
  sums.squares[c] += ggg / 3.0;
  sums.products[a] += 0.5 * u * m[2][1];  // αβ
  sums.products[b] += 0.5 * v * bbg;      // βγ
  sums.products[c] += 0.5 * gga;          // γα
}

/// About a point of the polyhedron's frame; the order of faces is the order of summation.
VolumeIntegrals integrateAbout(const Polyhedron& solid, const Vec3& origin) {
  Sums s;
  for (const std::vector<int>& face : solid.faces) addFace(solid, face, origin, s);
  VolumeIntegrals integrals;
  integrals.volume = s.one;
  const Vec3 d = s.first / s.one;
  integrals.centre = origin + d;
  Mat3& I = integrals.inertia;
  I = s.squares.sum() * Mat3::Identity();
  I.diagonal() -= s.squares;
  I(0, 1) = I(1, 0) = -s.products[0];
  I(1, 2) = I(2, 1) = -s.products[1];
  I(2, 0) = I(0, 2) = -s.products[2];
  I -= s.one * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  return integrals;
}

}  // namespace

VolumeIntegrals integrate(const Polyhedron& solid) {
  // First about a corner, where differences of nearby numbers are exact, then about what that
  // finds.
  const Vec3 near = integrateAbout(solid, solid.points[0]).centre;
  return integrateAbout(solid, near);
}

}  // namespace tumble
