// Chapter 2, shape: the edges at which a mesh is not convex, and the planes that could cut it
// there.
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "sim/shape/cut.h"

namespace tumble::cut {

/// Of a mesh's size: what rounding of its corners may come to.
inline constexpr double kRounding = 1e-12;

/// An edge of a piece at which it is not convex.
struct Notch {
  int from = 0, to = 0;     ///< corners
  int left = 0, right = 0;  ///< triangles of the mesh
};

/// How near is on a plane.
struct OnPlane {
  double slack = 0.0;  ///< [m] corners of a notch no further from a plane lie on it
  double snap = 0.0;   ///< [m] corners that a cut takes for on it; 0: it decides exactly
};

/// The notches of a closed mesh, found once; of its pieces afterwards. `flat` numbers the flat face
/// that each triangle is a part of: within it is none. Keeps `points` and `whole`, which must
/// outlive it.
class Notches {
 public:
  Notches(const Points& points, const Surface& whole, const std::vector<int>& flat, OnPlane on);

  std::vector<Notch> of(const Surface& piece) const;

  /// The plane of a triangle of the mesh.
  CutPlane planeOf(int triangle) const;

  /// The planes worth a look at a notch: along its faces, between them, and through a neighbour.
  std::vector<CutPlane> planesAt(const Notch& notch, const std::vector<Notch>& others) const;

  /// Whether a plane through a notch leaves no notch on either side of it.
  bool resolves(const CutPlane& plane, const Notch& notch) const;

 private:
  using Edge = std::pair<int, int>;
  const Vec3& at(int p) const { return points_.at[static_cast<std::size_t>(p)]; }
  /// Whether two triangles of the mesh that an edge from a to b of a piece joins make a notch
  /// there.
  bool isNotch(int f, int g, int a, int b) const;
  /// The edge of a notch: of the mesh, or of the piece where a sliver between the two is gone.
  Edge edgeOf(const Notch& notch) const;
  CutPlane spread(CutPlane plane, const std::vector<Notch>& notches) const;

  const Points& points_;
  const Surface& whole_;
  OnPlane on_;
  std::map<std::pair<int, int>, Edge> reflex_;  ///< pairs of triangles: their edge
  std::set<std::pair<int, int>> joined_;        ///< pairs that have an edge
};

}  // namespace tumble::cut
