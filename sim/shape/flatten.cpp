#include "sim/shape/flatten.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "sim/shape/face_groups.h"
#include "sim/shape/join.h"
#include "sim/shape/written.h"

namespace tumble {
namespace {

constexpr double kOpen = 1.0;    // of the grain: off the best plane; rounding alone: √3/2
constexpr double kMost = 3.0;    // of the grain: the way of a corner
constexpr double kBent = 1e-12;  // of the size: further off its plane, a corner is not on it
constexpr double kFlat = 1e-14;  // of the size: off its plane, and on it
constexpr double kSoft = 1e-9;   // [1] what an equation may give, against a way of 1
constexpr int kMostRounds = 30;

/// A plane n·(x − middle) = d.
struct Plane {
  Vec3 middle, n;
  double reach;    // [m] of its corners from the middle
  double d = 0.0;  // [m]
  Vec3 u = Vec3::Zero(), v = Vec3::Zero();

  void findWays() {
    u = n.unitOrthogonal();
    v = n.cross(u);
  }
  double height(const Vec3& x) const { return n.dot(x - middle) - d; }
  /// How the height of x changes as the plane turns, each way by 1 m at its reach, and rises.
  Eigen::RowVector3d change(const Vec3& x) const {
    return {u.dot(x - middle) / reach, v.dot(x - middle) / reach, -1.0};
  }
  void move(const Vec3& q) {
    n = (n + (q[0] * u + q[1] * v) / reach).normalized();
    d += q[2];
  }
};

/// A corner's part in the equations: with A the normals of its planes, B their changes, q how the
/// planes move and r its heights, A Δx = −(r + B q), to kSoft. The least Δx is −Aᵀ W (r + B q),
/// W = (A Aᵀ + kSoft)⁻¹.
struct Corner {
  std::vector<int> planes;
  Eigen::Matrix<double, Eigen::Dynamic, 3> A, B;
  Eigen::MatrixXd W;
  Eigen::VectorXd r;

  void look(const std::vector<Plane>& all, const Vec3& x) {
    const auto count = static_cast<Eigen::Index>(planes.size());
    A.resize(count, 3), B.resize(count, 3), r.resize(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Plane& plane = all[static_cast<std::size_t>(planes[static_cast<std::size_t>(k)])];
      A.row(k) = plane.n.transpose();
      B.row(k) = plane.change(x);
      r[k] = plane.height(x);
    }
    W = A * A.transpose();
    W.diagonal().array() += kSoft;
    W = W.inverse().eval();
  }
};

/// Newton's method on corners and planes: each round, Σ |Δx|² is least for planes with
///   Σ Bᵀ W B q = −Σ Bᵀ W r.
class Solver {
 public:
  Solver(const Polyhedron& solid, const std::vector<FaceGroup>& groups)
      : x_(solid.points), corners_(solid.points.size()) {
    for (const FaceGroup& group : groups) {
      double reach = 0.0;
      for (const int i : group.corners) {
        reach = std::max(reach, (x_[static_cast<std::size_t>(i)] - group.middle).norm());
        corners_[static_cast<std::size_t>(i)].planes.push_back(static_cast<int>(planes_.size()));
      }
      planes_.push_back({group.middle, group.n, reach});
    }
  }

  /// The corners, all on their planes to `flat` [m]; none if they do not come there.
  std::vector<Vec3> solved(double flat) {
    for (int round = 0; round < kMostRounds; ++round) {
      if (look() <= flat) return x_;
      if (!moveAll()) break;
    }
    return {};
  }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  /// Where all stand; the largest height [m] of a corner over one of its planes.
  double look() {
    double worst = 0.0;
    for (Plane& plane : planes_) plane.findWays();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      corners_[i].look(planes_, x_[i]);
      if (corners_[i].r.size() > 0) worst = std::max(worst, corners_[i].r.cwiseAbs().maxCoeff());
    }
    return worst;
  }

  bool moveAll() {
    const auto unknowns = 3 * static_cast<Eigen::Index>(planes_.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(unknowns);
    for (const Corner& corner : corners_) append(corner, entries, load);
    Matrix matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Matrix> factor(matrix);
    const Eigen::VectorXd q = factor.solve(load);
    if (factor.info() != Eigen::Success || !q.allFinite()) return false;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      Corner& corner = corners_[i];
      for (Eigen::Index k = 0; k < corner.r.size(); ++k) {
        const int plane = corner.planes[static_cast<std::size_t>(k)];
        corner.r[k] += corner.B.row(k).dot(q.segment<3>(3 * plane));
      }
      x_[i] -= corner.A.transpose() * (corner.W * corner.r);
    }
    for (std::size_t p = 0; p < planes_.size(); ++p)
      planes_[p].move(q.segment<3>(3 * static_cast<Eigen::Index>(p)));
    return true;
  }

  static void append(const Corner& corner, std::vector<Eigen::Triplet<double>>& entries,
                     Eigen::VectorXd& load) {
    for (std::size_t k = 0; k < corner.planes.size(); ++k)
      for (std::size_t l = 0; l < corner.planes.size(); ++l) {
        const auto row = static_cast<Eigen::Index>(k), column = static_cast<Eigen::Index>(l);
        const int first = 3 * corner.planes[k], second = 3 * corner.planes[l];
        const double w = corner.W(row, column);
        const Mat3 block = w * corner.B.row(row).transpose() * corner.B.row(column);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) entries.emplace_back(first + i, second + j, block(i, j));
        load.segment<3>(first) -= w * corner.r[column] * corner.B.row(row).transpose();
      }
  }

  std::vector<Vec3> x_;
  std::vector<Corner> corners_;
  std::vector<Plane> planes_;
};

/// Whether most corners of faces that share a plane are on one that is not flat.
bool isRough(const std::vector<FaceGroup>& groups, double bent) {
  std::set<int> all, rough;
  for (const FaceGroup& group : groups) {
    all.insert(group.corners.begin(), group.corners.end());
    if (group.off > bent) rough.insert(group.corners.begin(), group.corners.end());
  }
  return !rough.empty() && 2 * rough.size() >= all.size();
}

/// Whether all faces look the way they did, but for those within a plane that others share.
bool lookAlike(const Polyhedron& a, const Polyhedron& b, const std::vector<FaceGroup>& groups) {
  const auto isWithin = [&](const std::vector<int>& face) {
    return std::any_of(groups.begin(), groups.end(), [&](const FaceGroup& group) {
      return std::all_of(face.begin(), face.end(), [&](int i) {
        return std::binary_search(group.corners.begin(), group.corners.end(), i);
      });
    });
  };
  return std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(),
                    [&](const std::vector<int>& f, const std::vector<int>& g) {
                      return areaVector(a, f).dot(areaVector(b, g)) > 0.0 || isWithin(f);
                    });
}

}  // namespace

std::optional<Flattened> flattened(const Polyhedron& solid, double grain) {
  const double size = sizeOf(solid);
  if (!(grain > 0.0) || grain > kShape * size) return {};
  const std::vector<FaceGroup> groups = faceGroups(solid, kOpen * grain);
  if (!isRough(groups, kBent * size)) return {};
  Flattened asGiven{solid};
  Polyhedron flat = solid;
  flat.points = Solver(solid, groups).solved(kFlat * size);
  if (flat.points.empty() || !lookAlike(solid, flat, groups)) return asGiven;
  double moved = 0.0;
  for (std::size_t i = 0; i < flat.points.size(); ++i)
    moved = std::max(moved, (flat.points[i] - solid.points[i]).norm());
  if (moved > kMost * grain) return asGiven;
  findEdges(flat);
  return Flattened{std::move(flat), moved};
}

}  // namespace tumble
