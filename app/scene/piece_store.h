// Convex pieces of meshes: found once, then remembered by the program and in the user's cache.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/shape/pieces.h"

namespace tumble {

/// The pieces of a mesh, as `piecesOf` finds them: from an earlier call, else from a file in
/// $XDG_CACHE_HOME/tumble (~/.cache/tumble without), else found now and written there, with a line
/// on stderr if that took long. Files are named by a digest of the mesh and how it is taken apart;
/// one that is broken is made anew, and a folder that cannot be written is no error.
/// @param name       of the mesh, for that line
/// @throws NoPieces  as `piecesOf` does
std::shared_ptr<const Pieces> storedPieces(const Polyhedron& solid, PieceKind kind,
                                           double tolerance, double grain, const std::string& name);

/// Pieces as text, and back: to the last bit. Nothing if the text is not whole.
std::string textOf(const Pieces& pieces);
std::shared_ptr<const Pieces> piecesFrom(const std::string& text);

}  // namespace tumble
