// Chapter 2, shape: one way of taking a mesh apart.
#pragma once

#include "sim/shape/pieces.h"

namespace tumble {

/// Where cuts may be, how many triangles may be looked at for them, in all surfaces together, and
/// what is on them.
struct Means {
  bool anywhere = false;  ///< not at notches alone
  long work = 0;
  double snap = 0.0;               ///< [m] corners no further from a cut are on it
  std::size_t most = kMostPieces;  ///< pieces, before any are joined
};

/// A mesh for which the means were too few.
class TooIntricate : public NoPieces {
  using NoPieces::NoPieces;
};

/// As piecesOf, by these means alone.
/// @throws NoPieces, TooIntricate
Pieces decompose(const Polyhedron& solid, double tolerance, const Means& means);

}  // namespace tumble
