// Chapter 2, shape: closed surfaces of triangles, cut by planes.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "sim/math/vec.h"

namespace tumble::cut {

struct Fraction3;

/// Corners of all pieces of one mesh, each known to all its digits.
struct Points {
  std::vector<Vec3> at;                                 ///< [m] rounded
  std::vector<std::shared_ptr<const Fraction3>> exact;  ///< where that is not the whole; else null
  mutable long looks = 0;  ///< what whole numbers and long outlines cost, in triangles looked at
  mutable double snapped = 0.0;  ///< [m] how far from a cut corners were that counted as on it
};

/// A triangle of a surface, counter-clockwise seen from outside.
struct Triangle {
  std::array<int, 3> corner;
  int face = -1;  ///< of the mesh that it is a part of; −1: made by a cut
};
using Surface = std::vector<Triangle>;

/// The plane through three corners; above is where they run counter-clockwise.
struct CutPlane {
  Vec3 a, b, c;            ///< [m] exact
  Vec3 n = Vec3::UnitY();  ///< [1] unit, rounded
  double d = 0.0;          ///< [m] n·a
  double height(const Vec3& p) const { return n.dot(p) - d; }
};
CutPlane planeThrough(const Vec3& a, const Vec3& b, const Vec3& c);

/// Sixfold volume [m³] of what a surface encloses.
double sixfoldVolume(const Points& points, const Surface& surface);

/// Whether a surface encloses no more than a share of its area times its size from the origin.
bool isThin(const Points& points, const Surface& surface, double share);

/// The corners of a surface, each once.
std::vector<Vec3> cornersOf(const Points& points, const Surface& surface);

/// What a plane leaves below and above it, each closed along the cut. New corners are the exact
/// crossings; with a tolerance they are rounded.
struct Halves {
  Surface below, above;
};
Halves halve(Points& points, const Surface& surface, const CutPlane& plane, double tolerance);

/// The pieces that hang together by their edges. Those with a cavity stay one.
std::vector<Surface> pieces(const Points& points, const Surface& surface);

/// The triangles that fill closed loops of directed edges in a plane with this normal, seen along
/// which they run counter-clockwise about what they fill and clockwise about holes.
Surface fill(const Points& points, const std::vector<std::array<int, 2>>& edges, const Vec3& n,
             bool exact);

/// Twice the signed area of a triangle seen along −axis, or its sign if that is in doubt. Unless it
/// is asked for exactly, what rounding of the corners may make of a line is 0.
double turn(const Points& points, int a, int b, int c, int axis, bool exact);

/// What rounding of corners no further than `far` [m] from the origin, by the sum of their
/// coordinates' sizes, may make of a line at most.
double mostNoise(double far);

}  // namespace tumble::cut
