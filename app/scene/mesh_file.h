// Meshes from Wavefront OBJ files.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/shape/polyhedron.h"

namespace tumble {

/// A mesh file that is refused: "dumbbell.obj:31: the edge from …".
class MeshError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A mesh, and where its faces stand in its file.
struct MeshFile {
  std::shared_ptr<const Polyhedron> solid;
  std::vector<int> lines;     ///< per face of the solid: the line, from 1, on which it begins
  Vec3 first = Vec3::Zero();  ///< [m] the file's first point, which all of the solid's are less
  double grain = 0.0;         ///< [m] of its coordinates: the last digit written

  /// ":12", the line of a face; "" for −1.
  std::string lineOf(int face) const;
};

/// Reads points (`v x y z` [m]) and faces (`f 1 2 3 …`) of an OBJ file, all groups as one solid;
/// other statements of the format are passed over.
/// @throws MeshError with file, line and column for a word that is none of the format's
/// (`readObj`),
///                   with file and line if the file cannot be read or bounds no solid.
MeshFile readMesh(const std::string& path);

/// The same from text; `file` is the name that complaints use.
MeshFile parseMesh(const std::string& text, const std::string& file);

/// Path of a mesh that a scene names: beside the scene, else among the program's own meshes.
/// @throws MeshError naming the places that were tried, or what stands there instead of a file.
std::string meshPath(const std::string& mesh, const std::string& sceneFile);

}  // namespace tumble
