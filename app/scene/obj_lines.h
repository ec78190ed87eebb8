// The lines of a Wavefront OBJ file, checked word by word.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sim/math/vec.h"

namespace tumble {

/// A word of an OBJ file that is refused: "m.obj:3:5: expected a finite number, found '1,5'".
class ObjError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The points and faces of an OBJ file.
struct ObjFile {
  std::vector<Vec3> points;             ///< [m] the nearest numbers to those written
  std::vector<std::vector<int>> faces;  ///< indices of points, from 0
  std::vector<int> lines;               ///< per face: the line, from 1, on which it begins
  double grain = 0.0;  ///< [m] the last digit written of the coordinates that have fewest; with as
                       ///< many as a single-precision number has, what that leaves open
};

/// Reads
///   v x y z      what follows the three numbers is left out
///   f a b c …    numbers of points, from 1; texture coordinates and normals are left out
/// all groups as one. Comments and all other statements of the format are passed over; a line that
/// ends in \ is joined with the next. Wavefront, "Object Files (.obj)", Advanced Visualizer Manual,
/// appendix B1. Departure: a face names only points above it.
/// @param file  the name that complaints use
/// @throws ObjError with line and column for a number or reference that is not one throughout, a
///                  point or face with fewer than three, or a line that begins with an unknown
///                  word.
ObjFile readObj(std::string_view text, const std::string& file);

}  // namespace tumble
