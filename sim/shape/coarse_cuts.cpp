#include "sim/shape/coarse_cuts.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numbers>

#include "sim/math/rotation.h"

namespace tumble::cut {
namespace {

CutPlane square(const Vec3& p, const Vec3& n, double size) {
  const Vec3 u = n.unitOrthogonal();
  return planeThrough(p, p + size * u, p + size * n.cross(u));
}

}  // namespace

std::vector<CutPlane> planesAcross(const std::vector<Vec3>& corners) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : corners) mean += p / static_cast<double>(corners.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : corners) spread += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  std::vector<CutPlane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 n = axes.eigenvectors().col(axis);
    double lo = std::numeric_limits<double>::infinity(), hi = -lo;
    for (const Vec3& p : corners) lo = std::min(lo, n.dot(p)), hi = std::max(hi, n.dot(p));
    for (const double share : {0.25, 0.5, 0.75})
      planes.push_back(square(mean + (lo + share * (hi - lo) - n.dot(mean)) * n, n, hi - lo));
  }
  return planes;
}

std::vector<CutPlane> planesInto(const Vec3& over, const Vec3& ground, double size) {
  constexpr int kTurns = 4;  // half-turns of the plane about the way down, in as many steps
  const Vec3 down = (ground - over).normalized();
  const Vec3 u = down.unitOrthogonal(), v = down.cross(u);
  std::vector<CutPlane> planes;
  for (int k = 0; k < kTurns; ++k) {
    double sine, cosine;
    sinCos(std::numbers::pi * k / kTurns, sine, cosine);
    planes.push_back(square(over, cosine * u + sine * v, size));
  }
  return planes;
}

std::vector<Vec3> stirred(std::vector<Vec3> corners, double grain) {
  double k = 0.0;
  for (Vec3& p : corners) {
    k += 1.0;
    // Parts of multiples of irrational numbers fill the cube evenly.
    const Vec3 place = k * Vec3(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
    p += grain * (2.0 * (place - place.array().floor().matrix()) - Vec3::Ones());
  }
  return corners;
}

}  // namespace tumble::cut
