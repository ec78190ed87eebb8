// Chapter 2, shape: convex decomposition (slide SH27: "a good one").
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// The convex pieces that carry the contacts of a mesh, in the frame of its polyhedron.
struct Pieces {
  std::vector<Hull> hulls;
  double excess =
      0.0;  ///< [m] no point of a piece is further from the mesh; with a tolerance of 0: 0
  double slack = 0.0;  ///< [m] pieces that touch overlap, or gape, by no more
};

/// How a mesh is taken apart.
enum class PieceKind {
  Good,    ///< few: cut at its notches
  Hull,    ///< one, its convex hull: hits where the mesh is hollow
  Slivers  ///< each good piece once more in four slices: right, but costly
};

/// The largest number of pieces; a mesh that needs more is refused.
inline constexpr std::size_t kMostPieces = 512;

/// What the pieces of a mesh whose corners are rounded may stand out by, in last digits: corners
/// that are in one plane, but of no face in it, are off it by some.
inline constexpr double kRoughPieces = 6.0;

/// A mesh that has no decomposition within bounds; the text says why, and what may help. It names
/// points by their numbers from 1, as in OBJ files.
class NoPieces : public std::runtime_error {
 public:
  NoPieces(const std::string& what, int face) : std::runtime_error(what), face_(face) {}
  int face() const { return face_; }  ///< index of a face that shows it; −1 for none

 private:
  int face_;
};

/// Takes a polyhedron apart at its notches, the edges at which it is not convex. Each cut is by a
/// plane through corners of the mesh: that along a face at a notch, between its faces or through
/// two notches which leaves fewest of them (it resolves some, and may cut others in two), then
/// crosses fewest edges, then comes first. What is on which side is decided exactly; corners within
/// `tolerance` of a cut count as on it.
///   Chazelle, "Convex Partitions of Polyhedra", SIAM J. Comput. 13, 1984. Departure: one plane
///   takes several notches, and notches shallower than the tolerance stay.
/// From a tolerance of a thousandth of the size on, as scans need it, planes into dents and across
/// the piece are tried beside these, and that one is taken whose parts fill their hulls best.
/// @param tolerance  [m] that a piece may stand out of the mesh; 0: the union of the pieces is the
///                   mesh, their corners rounded once
/// @param grain      [m] the last digit of the corners' coordinates: where it has bent the faces,
///                   it is the mesh with flat ones (`flattened`) that is taken apart, and pieces
///                   may stand out by kRoughPieces of it, if that is more; so may those of flat
///                   faces that do not come apart otherwise; 0: corners are as given
/// @throws NoPieces  for more than kMostPieces, or too much work to find them
Pieces piecesOf(const Polyhedron& solid, PieceKind kind, double tolerance, double grain = 0.0);

}  // namespace tumble
