// Chapter 5, collide: the three steps of box against box. Frame of b throughout.
#pragma once

#include "sim/collide/contact_point.h"
#include "sim/math/vec.h"

namespace tumble::box_box {

/// Two boxes seen from b: only the difference of the centres enters, so that boxes far from the
/// world's origin lose nothing but the rounding of their own positions.
struct BoxPair {
  Vec3 halfA, halfB;  ///< [m]
  Mat3 C;             ///< columns: body axes of a in the frame of b
  Vec3 d;             ///< [m] centre of a in the frame of b
  double size;        ///< [m] geometric mean of the half diagonals
};

/// One of the 15 directions of the separating-axis test.
struct Axis {
  NormalTie tie;  ///< FaceOfB (axis j of b), FaceOfA (axis i of a) or Edges (i of a with j of b)
  int i, j;
  double gap;  ///< [m] width of the slab between the boxes across this direction; < 0: overlap
};

/// The direction of widest gap (Gottschalk, Lin, Manocha, OBBTree, 1996):
///   gap(n) = |n·d| − Σ halfB |n·eⱼ| − Σ halfA |n·cᵢ|,   n ∈ {eⱼ, cᵢ, eⱼ × cᵢ / s},  s = |eⱼ × cᵢ|
/// A face of a must win over one of b, and a pair of edges over both, by more than `bias` [m].
/// Departure: where s gets smaller than gap/size, an edge axis counts only in part, so that the
/// widest gap stays continuous when edges turn parallel and their cross product loses its
/// direction.
Axis widestAxis(const BoxPair& pair, double bias);

/// The axis as unit vector out of b towards a.
Vec3 direction(const BoxPair& pair, const Axis& axis);

/// A contact point in the frame of b; `tie` with the edges' body axes i of a, j of b if it names
/// any.
struct LocalPoint {
  Vec3 pb = Vec3::Zero();  ///< [m] pa = pb + separation n
  double separation = 0.0;
  std::uint64_t feature = 0;
  NormalTie tie = NormalTie::FaceOfB;
  int i = 0, j = 0;
};

/// At most this many corners has the intersection of two rectangles seen along n.
inline constexpr int kMaxPoints = 8;

/// A list of contact points without allocation.
struct LocalManifold {
  Vec3 n = Vec3::UnitY();
  LocalPoint points[kMaxPoints];
  int count = 0;
};

/// The corners of the region that the supporting faces of a and b share when seen along the axis,
/// with their separations: Sutherland–Hodgman. `tolerance` [m]: lying on a side counts as inside.
void clipFaces(const BoxPair& pair, const Axis& axis, double tolerance, LocalManifold& out);

/// The nearest features of two boxes: one vertex, edge or face against another, by trying all.
/// All points that share the least distance to `tolerance` [m]; n along it. For boxes apart.
void nearestFeatures(const BoxPair& pair, double tolerance, LocalManifold& out);

}  // namespace tumble::box_box
