#include "sim/shape/face_groups.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace tumble {
namespace {

const Vec3& at(const Polyhedron& solid, int i) {
  return solid.points[static_cast<std::size_t>(i)];
}

/// Sums over points, from which the best plane through them follows: the covariance's principal
/// axes (Pearson 1901).
struct Moments {
  double count = 0.0;
  Vec3 first = Vec3::Zero();   // [m]
  Mat3 second = Mat3::Zero();  // [m²]

  void add(const Vec3& p) {
    count += 1.0;
    first += p;
    second += p * p.transpose();
  }
  void add(const Moments& other) {
    count += other.count;
    first += other.first;
    second += other.second;
  }
};

struct Fit {
  Vec3 middle, n;
  double width = 0.0;  // [m] root mean square of the corners' way across their longest one

  explicit Fit(const Moments& sum) : middle(sum.first / sum.count) {
    const Mat3 spread = sum.second / sum.count - middle * middle.transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
    n = axes.eigenvectors().col(0);
    width = std::sqrt(std::max(0.0, axes.eigenvalues()[1]));
  }
};

/// A group as it grows.
struct Growing {
  std::vector<int> faces, corners;
  Moments moments;
  Vec3 area = Vec3::Zero();  // [m²] outward, twice the sum over the faces
};

class Finder {
 public:
  Finder(const Polyhedron& solid, double open)
      : solid_(solid),
        open_(open),
        seen_(solid.points.size(), -1),
        groupOf_(solid.faces.size(), -1) {
    for (const std::vector<int>& face : solid.faces) area_.push_back(areaVector(solid, face));
  }

  std::vector<FaceGroup> found() {
    growAll();
    // Corners in line, of slivers, tell no plane.
    std::erase_if(groups_, [&](const Growing& group) {
      return group.corners.size() < 4 || Fit(group.moments).width <= open_;
    });
    joinApart();
    std::vector<FaceGroup> groups;
    for (Growing& group : groups_) {
      if (group.corners.empty()) continue;
      std::sort(group.corners.begin(), group.corners.end());
      group.corners.erase(std::unique(group.corners.begin(), group.corners.end()),
                          group.corners.end());
      const Fit fit(group.moments);
      groups.push_back({std::move(group.corners), fit.middle, fit.n});
      groups.back().off = off(fit, groups.back().corners);
    }
    return groups;
  }

 private:
  const Vec3& area(int face) const { return area_[static_cast<std::size_t>(face)]; }
  int& groupOf(int face) { return groupOf_[static_cast<std::size_t>(face)]; }

  double off(const Fit& fit, const std::vector<int>& corners) const {
    double most = 0.0;
    for (const int i : corners)
      most = std::max(most, std::abs(fit.n.dot(at(solid_, i) - fit.middle)));
    return most;
  }

  /// Takes a face in, if there is still a plane.
  bool add(Growing& group, int number, int face) {
    Moments moments = group.moments;
    std::vector<int> fresh;
    for (const int i : solid_.faces[static_cast<std::size_t>(face)])
      if (seen_[static_cast<std::size_t>(i)] != number) {
        fresh.push_back(i);
        moments.add(at(solid_, i));
      }
    if (!fresh.empty()) {
      const Fit fit(moments);
      if (off(fit, fresh) > open_ || off(fit, group.corners) > open_) return false;
    }
    for (const int i : fresh) seen_[static_cast<std::size_t>(i)] = number;
    group.corners.insert(group.corners.end(), fresh.begin(), fresh.end());
    group.moments = moments;
    group.area += area(face);
    group.faces.push_back(face);
    groupOf(face) = number;
    return true;
  }

  /// Around the largest face that is left, again and again.
  void growAll() {
    std::vector<int> order(solid_.faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int f, int g) { return area(f).squaredNorm() > area(g).squaredNorm(); });
    for (const int seed : order) {
      if (groupOf(seed) >= 0) continue;
      const int number = static_cast<int>(groups_.size());
      Growing group;
      add(group, number, seed);
      for (std::size_t next = 0; next < group.faces.size(); ++next) {
        const int face = group.faces[next];
        for (const int e : solid_.sides[static_cast<std::size_t>(face)]) {
          const Polyhedron::Edge& edge = solid_.edges[static_cast<std::size_t>(e)];
          const int other = edge.left == face ? edge.right : edge.left;
          // A face folded back on the first is the other side of something thin.
          if (groupOf(other) < 0 && area(seed).dot(area(other)) > 0.0) add(group, number, other);
        }
      }
      groups_.push_back(std::move(group));
    }
  }

  /// The later of two groups that share a plane and a side goes into the first.
  void joinApart() {
    for (std::size_t i = 0; i < groups_.size(); ++i)
      for (std::size_t j = i + 1; j < groups_.size(); ++j)
        if (!groups_[j].corners.empty() && mayShare(groups_[i], groups_[j]))
          join(groups_[i], groups_[j]);
  }

  /// Whether two groups are near enough to one plane for a look at all their corners.
  bool mayShare(const Growing& a, const Growing& b) const {
    constexpr double kAlike = 0.9;  // cosine between their sides
    constexpr double kOften = 4.0;  // more than the corners of one can turn its plane by
    const Vec3 n = a.area.normalized();
    if (n.dot(b.area) < kAlike * b.area.norm()) return false;
    const Vec3 way = b.moments.first / b.moments.count - a.moments.first / a.moments.count;
    return std::abs(n.dot(way)) <= kOften * open_ * (1.0 + way.norm() / Fit(a.moments).width);
  }

  /// Whether a face runs from one group to the other: in one plane with both it would be none.
  bool isStep(const Growing& a, const Growing& b) const {
    const std::set<int> ofA(a.corners.begin(), a.corners.end());
    const std::set<int> ofB(b.corners.begin(), b.corners.end());
    const std::set<int> inA(a.faces.begin(), a.faces.end());
    const std::set<int> inB(b.faces.begin(), b.faces.end());
    const auto lies = [&](int i) { return ofA.count(i) + ofB.count(i) > 0; };
    for (int f = 0; f < static_cast<int>(solid_.faces.size()); ++f) {
      const std::vector<int>& face = solid_.faces[static_cast<std::size_t>(f)];
      if (std::all_of(face.begin(), face.end(), lies) && inA.count(f) + inB.count(f) == 0)
        return true;
    }
    return false;
  }

  void join(Growing& a, Growing& b) const {
    Moments both = a.moments;
    both.add(b.moments);
    const Fit fit(both);
    if (off(fit, a.corners) > open_ || off(fit, b.corners) > open_ || isStep(a, b)) return;
    a.moments = both;
    a.area += b.area;
    a.corners.insert(a.corners.end(), b.corners.begin(), b.corners.end());
    a.faces.insert(a.faces.end(), b.faces.begin(), b.faces.end());
    b.corners.clear();
  }

  const Polyhedron& solid_;
  double open_;
  std::vector<int> seen_;     // of each corner: the group that met it last
  std::vector<int> groupOf_;  // of each face
  std::vector<Vec3> area_;
  std::vector<Growing> groups_;
};

}  // namespace

std::vector<FaceGroup> faceGroups(const Polyhedron& solid, double open) {
  return Finder(solid, open).found();
}

}  // namespace tumble
