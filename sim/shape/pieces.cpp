#include "sim/shape/pieces.h"

#include <algorithm>
#include <optional>

#include "sim/shape/convex_hull.h"
#include "sim/shape/decompose.h"
#include "sim/shape/flatten.h"
#include "sim/shape/join.h"
#include "sim/shape/slivers.h"

namespace tumble {
namespace {

constexpr double kCoarse = 1e-3;         // of the size: from this tolerance on, cuts are anywhere
constexpr double kSnap = 2e-6;           // of the size: corners no further from a cut are on it
constexpr double kRoughSnap = 2.0;       // of the grain: the same, if corners are rounded
constexpr long kFewWork = 8'000'000;     // triangles looked at, whatever the mesh,
constexpr long kFaceWork = 10'000;       // and for each of its faces
constexpr long kMostWork = 50'000'000;   // where cuts are at notches alone
constexpr long kTrialWork = 16'000'000;  // to see which of two ways makes fewer
constexpr std::size_t kMostFaces = 20'000;  // of a mesh: each is looked at for every cut

/// What may be spent on a solid. One of few faces that asks for more touches itself, and cuts would
/// go on for ever.
long mostWork(const Polyhedron& solid) {
  return kFewWork + kFaceWork * static_cast<long>(solid.faces.size());
}

/// By cuts at notches alone. What a wide tolerance takes for on a cut may leave a piece that no
/// plane parts, as where faces meet that lean little; a closer one does not.
Pieces atNotches(const Polyhedron& solid, double tolerance, const Means& means) {
  try {
    return decompose(solid, tolerance, means);
  } catch (const TooIntricate&) {
    throw;
  } catch (const NoPieces&) {
    if (tolerance == 0.0) throw;
    for (const double share : {0.5, 0.25}) try {
        return decompose(solid, share * tolerance, means);
      } catch (const NoPieces&) {
      }
    throw;
  }
}

/// By cuts at notches alone, or anywhere if these leave fewer pieces, as of a scan.
Pieces fewest(const Polyhedron& solid, double tolerance, double snap) {
  std::optional<Pieces> few;
  try {
    few = atNotches(solid, tolerance, {false, kTrialWork, snap});
  } catch (const NoPieces&) {
  }
  try {
    Pieces pieces = decompose(
        solid, tolerance,
        {true, few ? kTrialWork : mostWork(solid), snap, few ? few->hulls.size() : kMostPieces});
    if (!few || pieces.hulls.size() < few->hulls.size()) return pieces;
  } catch (const NoPieces&) {
    if (!few) throw;
  }
  return *std::move(few);
}

/// Of a mesh whose corners are what they say, to `snap` [m].
Pieces piecesOfFlat(const Polyhedron& solid, PieceKind kind, double tolerance, double snap) {
  if (kind == PieceKind::Hull) {
    Polyhedron hull = convexHull(solid.points);
    Pieces one;
    one.hulls.push_back({std::make_shared<const Polyhedron>(std::move(hull)), -solid.points[0]});
    return one;
  }
  const double size = sizeOf(solid);
  const bool coarse = tolerance >= kCoarse * size;
  if (kind == PieceKind::Good && coarse) return fewest(solid, tolerance, snap);
  Pieces pieces =
      coarse ? decompose(solid, tolerance, {true, mostWork(solid), snap})
             : atNotches(solid, tolerance, {false, std::min(kMostWork, mostWork(solid)), snap});
  if (kind == PieceKind::Slivers) pieces.hulls = slivered(pieces.hulls, solid);
  if (pieces.hulls.size() > kMostPieces)
    throw NoPieces("the mesh makes " + std::to_string(pieces.hulls.size()) +
                       " slivers, more than " + std::to_string(kMostPieces) +
                       "; take pieces = \"good\"",
                   -1);
  return pieces;
}

}  // namespace

Pieces piecesOf(const Polyhedron& solid, PieceKind kind, double tolerance, double grain) {
  const bool many = solid.faces.size() > kMostFaces;
  if (many && kind != PieceKind::Hull)
    throw NoPieces("the mesh has " + std::to_string(solid.faces.size()) + " faces, and at most " +
                       std::to_string(kMostFaces) +
                       " are taken apart; simplify it, or take pieces = \"hull\"",
                   -1);
  const std::optional<Flattened> flat = many ? std::nullopt : flattened(solid, grain);
  const double size = sizeOf(solid), open = std::max(tolerance, kRoughPieces * grain),
               wide = std::max(kSnap * size, kRoughSnap * grain);
  if (!flat) try {
      return piecesOfFlat(solid, kind, tolerance, kSnap * size);
    } catch (const NoPieces&) {
      // Faces that are flat as written may still have corners that miss a cut by some digits.
      if (many || open == tolerance) throw;
      return piecesOfFlat(solid, kind, open, wide);
    }
  Pieces pieces = piecesOfFlat(flat->solid, kind, open - flat->moved, wide);
  pieces.excess += flat->moved;
  return pieces;
}

}  // namespace tumble
