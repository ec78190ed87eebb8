// Chapter 2, elastic: a strand of hair as points and energies.
#pragma once

#include <vector>

#include "sim/elastic/elastic_body.h"

namespace tumble {

/// A strand in its own frame: its root at the origin, straight along +Y at rest. Point 0 stands one
/// piece below the root and point 1 on it: held, they clamp the strand's direction. The others
/// follow evenly, the last at the tip.
struct StrandDef {
  int points = 10;        ///< 3 or more, with the two of the root
  double length = 0.1;    ///< [m] from root to tip
  double density = 1e-3;  ///< [kg/m]
  double stretch = 10.0;  ///< [N] E A: its pull per strain
  double bend = 1e-6;     ///< [N m²] E I
  double damping = 0.0;   ///< [N s] of the rate of strain
};

/// Pieces between root and tip.
inline int strandPieces(const StrandDef& strand) {
  return strand.points - 2;
}

/// Places of the points when straight [m].
std::vector<Vec3> strandPlaces(const StrandDef& strand);

/// Masses [kg] of the points: half of the pieces at both sides; the two of the root share theirs.
std::vector<double> strandMasses(const StrandDef& strand);

/// Its energies, by numbers of points plus `first`: pieces as springs, and turns between them. The
/// turn at the root bends half a piece, for the other half is held; so the shape under small loads
/// is right to second order in the length of a piece.
std::vector<Element> strandElements(const StrandDef& strand, int first = 0);

}  // namespace tumble
