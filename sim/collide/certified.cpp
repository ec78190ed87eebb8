#include "sim/collide/certified.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/collide/core.h"
#include "sim/math/double_double.h"

namespace tumble {
namespace {

using convex::Few;

// A number is a double or a pair of doubles.
double high(double x) {
  return x;
}
double high(const DoubleDouble& x) {
  return x.hi;
}
template <class T>
T exactly(double x);
template <>
double exactly<double>(double x) {
  return x;
}
template <>
DoubleDouble exactly<DoubleDouble>(double x) {
  return {x, 0.0};
}

template <class T>
struct Triple {
  T x, y, z;
};
template <class T>
Triple<T> operator+(const Triple<T>& a, const Triple<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Triple<T> operator-(const Triple<T>& a, const Triple<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Triple<T> operator*(double s, const Triple<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
T dot(const Triple<T>& a, const Triple<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
Triple<T> exactly(const Vec3& v) {
  return {exactly<T>(v.x()), exactly<T>(v.y()), exactly<T>(v.z())};
}
template <class T>
double lengthOf(const Triple<T>& v) {
  const double x = high(v.x), y = high(v.y), z = high(v.z);
  return std::sqrt(x * x + y * y + z * z);
}

// The columns of R(q) for q of any length.
template <class T>
struct Turn {
  Triple<T> column[3];

  explicit Turn(const Quat& q) {
    const T w = exactly<T>(q.w()), x = exactly<T>(q.x()), y = exactly<T>(q.y()),
            z = exactly<T>(q.z());
    const T ww = w * w, xx = x * x, yy = y * y, zz = z * z;
    const T one = exactly<T>(1.0) / (ww + xx + yy + zz);
    const auto twice = [&](const T& a) { return one * (2.0 * a); };
    column[0] = {one * (ww + xx - yy - zz), twice(x * y + w * z), twice(x * z - w * y)};
    column[1] = {twice(x * y - w * z), one * (ww - xx + yy - zz), twice(y * z + w * x)};
    column[2] = {twice(x * z + w * y), twice(y * z - w * x), one * (ww - xx - yy + zz)};
  }
  Triple<T> operator()(const Triple<T>& p) const {
    return {column[0].x * p.x + column[1].x * p.y + column[2].x * p.z,
            column[0].y * p.x + column[1].y * p.y + column[2].y * p.z,
            column[0].z * p.x + column[1].z * p.y + column[2].z * p.z};
  }
};

template <class T>
struct Solid {
  Few<Triple<T>> points, normals;  // [m]; outward, of any length
  std::span<const Polyhedron::Edge> edges;
  std::span<const std::vector<int>> faces;
  double bent = 0.0;  // [m] how far corners of a face are off its plane

  Triple<T> along(const Polyhedron::Edge& e) const { return points[e.to] - points[e.from]; }
};

// Twice the area vector (Newell).
template <class T>
Triple<T> areaOf(const Solid<T>& solid, const std::vector<int>& face) {
  const Triple<T>& p = solid.points[face[0]];
  Triple<T> sum = exactly<T>(Vec3(Vec3::Zero()));
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    sum = sum + cross(solid.points[face[k]] - p, solid.points[face[k + 1]] - p);
  return sum;
}

template <class T>
Solid<T> placed(const Shape& shape, const Quat& q, const Triple<T>& x) {
  const Turn<T> turn(q);
  Solid<T> solid;
  if (const Box* box = std::get_if<Box>(&shape)) {
    const Polyhedron& cube = convex::unitCube();
    for (const Vec3& p : cube.points)
      solid.points.push_back(x + turn(exactly<T>(Vec3(p.cwiseProduct(box->half)))));
    for (int f = 0; f < 6; ++f)
      solid.normals.push_back((f % 2 == 0 ? -1.0 : 1.0) * turn.column[f / 2]);
    solid.edges = cube.edges;
    solid.faces = cube.faces;
    return solid;
  }
  const Hull* hull = std::get_if<Hull>(&shape);
  if (!hull) throw std::invalid_argument("only boxes and hulls have a certified gap");
  const Triple<T> origin = exactly<T>(hull->origin);
  for (const Vec3& p : hull->solid->points)
    solid.points.push_back(x + turn(exactly<T>(p) - origin));
  for (const std::vector<int>& face : hull->solid->faces) {
    const Triple<T> n = areaOf(solid, face);
    solid.normals.push_back(n);
    for (std::size_t k = 3; k < face.size(); ++k) {
      const T height = dot(n, solid.points[face[k]] - solid.points[face[0]]);
      solid.bent = std::max(solid.bent, std::abs(high(height)) / lengthOf(n));
    }
  }
  solid.edges = hull->solid->edges;
  solid.faces = hull->solid->faces;
  return solid;
}

// The search over axes. Every gap is that of all points of both along an n as it stands, and so a
// lower bound of the widest, however n was rounded.
template <class T>
class Search {
 public:
  Search(const Solid<T>& a, const Solid<T>& b) : a_(a), b_(b) {}

  double widest() {
    for (std::size_t f = 0; f < b_.faces.size(); ++f)
      offer(b_.normals[f], a_.points[0], b_.points[b_.faces[f][0]]);
    for (std::size_t f = 0; f < a_.faces.size(); ++f)
      offer(-1.0 * a_.normals[f], a_.points[a_.faces[f][0]], b_.points[0]);
    for (const Polyhedron::Edge& i : a_.edges) offerEdge(i);
    return best_;
  }

 private:
  // p and q: one point of a and b each, to see first that n cannot win.
  void offer(const Triple<T>& n, const Triple<T>& p, const Triple<T>& q) {
    const double length = lengthOf(n);
    T low = dot(n, p), top = dot(n, q);
    if (!(high(low - top) > best_ * length)) return;
    for (const Triple<T>& point : a_.points) {
      const T height = dot(n, point);
      if (height < low) low = height;
    }
    for (const Triple<T>& point : b_.points) {
      const T height = dot(n, point);
      if (top < height) top = height;
    }
    best_ = std::max(best_, high(low - top) / length);
  }

  // All edges of b whose arc of normals crosses the mirrored arc of this one, or may.
  void offerEdge(const Polyhedron::Edge& i) {
    const Triple<T> ea = a_.along(i);
    const double lengthA = lengthOf(ea);
    heights_.clear();
    for (const Triple<T>& n : b_.normals)
      heights_.push_back(high(dot(n, ea)) / (lengthA * lengthOf(n)));
    for (const Polyhedron::Edge& j : b_.edges) {
      if (sameSide(heights_[j.left], heights_[j.right])) continue;
      const Triple<T> eb = b_.along(j);
      const double lengthB = lengthOf(eb);
      const auto height = [&](int f) {
        return high(dot(a_.normals[f], eb)) / (lengthB * lengthOf(a_.normals[f]));
      };
      const double left = height(i.left), right = height(i.right);
      if (sameSide(left, right)) continue;
      Triple<T> n = cross(ea, eb);
      if (!(lengthOf(n) > kParallel * lengthA * lengthB)) continue;
      // Rounding may leave n not quite square to ea, which counts where the edges are parallel.
      n = n - (high(dot(n, ea)) / (lengthA * lengthA)) * ea;
      const Triple<T>&p = a_.points[i.from], &q = b_.points[j.from];
      const double up = heights_[j.left], side = std::abs(up) > std::abs(left) ? up : left;
      if (std::abs(side) > kSure) {
        offer(side > 0.0 ? -1.0 * n : n, p, q);
      } else {
        offer(n, p, q);
        offer(-1.0 * n, p, q);
      }
    }
  }

  // Sines below kSure may be rounding.
  static bool sameSide(double left, double right) {
    return (left > kSure && right > kSure) || (left < -kSure && right < -kSure);
  }

  static constexpr double kSure = 1e-14;
  // Edges nearer to parallel than this add less than rounding.
  static constexpr double kParallel = sizeof(T) == sizeof(double) ? 1e-15 : 1e-28;

  const Solid<T>&a_, &b_;
  Few<double> heights_;
  double best_ = -std::numeric_limits<double>::infinity();
};

template <class T>
Gap searched(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB,
             double relative) {
  // Far from the world's origin only the difference of the centres counts, which is exact in pairs.
  const Triple<T> d = exactly<T>(poseA.x) - exactly<T>(poseB.x);
  const Solid<T> solidA = placed<T>(a, poseA.q, d);
  const Solid<T> solidB = placed<T>(b, poseB.q, exactly<T>(Vec3(Vec3::Zero())));
  const double size = boundingRadius(a) + boundingRadius(b) + lengthOf(d);
  const double value = Search<T>(solidA, solidB).widest();
  return {value, relative * size + 4.0 * (solidA.bent + solidB.bent)};
}

}  // namespace

Gap certifiedSeparation(const Shape& a, const Pose& poseA, const Shape& b, const Pose& poseB) {
  const Gap fast = searched<double>(a, poseA, b, poseB, 8e-15);
  if (!(std::abs(fast.value) < fast.bound)) return fast;
  return searched<DoubleDouble>(a, poseA, b, poseB, 1e-26);
}

}  // namespace tumble
