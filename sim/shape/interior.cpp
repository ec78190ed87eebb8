#include "sim/shape/interior.h"

#include <algorithm>
#include <cmath>

#include "sim/math/frames.h"

namespace tumble {
namespace {

bool holds(const Sphere& s, const Vec3& p) {
  return p.squaredNorm() < s.r * s.r;
}
bool holds(const Box& box, const Vec3& p) {
  return (p.array().abs() < box.half.array()).all();
}
bool holds(const Cylinder& c, const Vec3& p) {
  return std::abs(p.y()) < 0.5 * c.h && p.x() * p.x() + p.z() * p.z() < c.r * c.r;
}
bool holds(const Capsule& c, const Vec3& p) {
  const double y = std::max(std::abs(p.y()) - 0.5 * c.h, 0.0);
  return p.x() * p.x() + y * y + p.z() * p.z() < c.r * c.r;
}
bool holds(const Hull& hull, const Vec3& p) {
  const Polyhedron& solid = *hull.solid;
  return std::all_of(solid.faces.begin(), solid.faces.end(), [&](const std::vector<int>& face) {
    return areaVector(solid, face).dot(p - solid.points[static_cast<std::size_t>(face[0])]) < 0.0;
  });
}
bool holds(const Ellipsoid& e, const Vec3& p) {
  return p.cwiseQuotient(e.half).squaredNorm() < 1.0;
}
bool holds(const HalfSpace& h, const Vec3& p) {
  return h.n.dot(p) < h.d;
}
bool holds(const Particle&, const Vec3&) {
  return false;
}
bool holds(const Compound& compound, const Vec3& p) {
  return std::any_of(compound.parts.begin(), compound.parts.end(), [&](const Part& part) {
    const Vec3 p_B = toBody(part.pose, p) + originOf(shapeOf(part));
    return std::visit([&](const auto& solid) { return holds(solid, p_B); }, part.solid);
  });
}

/// The y at which the edge from a to b passes the height z, the same for a, b and b, a.
double crossing(const Vec3& a, int indexA, const Vec3& b, int indexB, double z) {
  if (indexB < indexA) return crossing(b, indexB, a, indexA, z);
  return a.y() + (z - a.z()) / (b.z() - a.z()) * (b.y() - a.y());
}

}  // namespace

Aabb boxAsGiven(const Shape& shape) {
  return boundingBox(withOrigin(shape, Vec3::Zero()), Pose{});
}

Interior::Interior(const Shape& shape) : shape_(shape), box_(boxAsGiven(shape)) {
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) sortTriangles(*mesh->solid);
}

void Interior::sortTriangles(const Polyhedron& solid) {
  std::vector<std::array<int, 3>> cut;
  for (const std::vector<int>& face : solid.faces) cutIntoTriangles(solid, face, cut);
  cells_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(cut.size()))));
  cell_.resize(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_));
  for (const std::array<int, 3>& corners : cut) {
    Triangle t;
    Vec3 lo = box_.hi, hi = box_.lo;
    for (int k = 0; k < 3; ++k) {
      t.index[k] = corners[k];
      t.corner[k] = solid.points[static_cast<std::size_t>(corners[k])];
      lo = lo.cwiseMin(t.corner[k]);
      hi = hi.cwiseMax(t.corner[k]);
    }
    t.n = (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]);
    if (t.n.x() == 0.0) continue;  // seen on edge, no ray along x crosses it
    const std::size_t low = cellOf(lo.y(), lo.z()), high = cellOf(hi.y(), hi.z());
    const std::size_t row = static_cast<std::size_t>(cells_);
    for (std::size_t z = low / row; z <= high / row; ++z)
      for (std::size_t y = low % row; y <= high % row; ++y)
        cell_[z * row + y].push_back(static_cast<int>(triangles_.size()));
    triangles_.push_back(t);
  }
}

std::size_t Interior::cellOf(double y, double z) const {
  const auto index = [&](double value, int axis) {
    const double width = box_.hi[axis] - box_.lo[axis];
    const double place = (value - box_.lo[axis]) / width * cells_;
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(cells_ - 1)));
  };
  return index(z, 2) * static_cast<std::size_t>(cells_) + index(y, 1);
}

/// Whether the ray from p along +x meets the triangle: p is inside its shadow on the yz plane by
/// the even-odd rule, and in front of its plane.
bool Interior::crosses(const Triangle& t, const Vec3& p) const {
  bool inside = false;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    const Vec3 &a = t.corner[k], &b = t.corner[l];
    if ((a.z() > p.z()) == (b.z() > p.z())) continue;
    if (crossing(a, t.index[k], b, t.index[l], p.z()) > p.y()) inside = !inside;
  }
  return inside && t.n.dot(t.corner[0] - p) / t.n.x() > 0.0;
}

bool Interior::contains(const Vec3& p) const {
  if ((p.array() < box_.lo.array()).any() || (p.array() > box_.hi.array()).any()) return false;
  if (triangles_.empty())
    return std::visit(
        [&](const auto& s) {
          if constexpr (std::is_same_v<std::decay_t<decltype(s)>, Mesh>)
            return false;
          else
            return holds(s, p);
        },
        shape_);
  bool odd = false;
  for (const int i : cell_[cellOf(p.y(), p.z())])
    if (crosses(triangles_[static_cast<std::size_t>(i)], p)) odd = !odd;
  return odd;
}

}  // namespace tumble
