// The lines of a Wavefront OBJ file, checked word by word.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace tumble {

/// A word of an OBJ file that is refused: "m.obj:3:5: expected a finite number, found '1,5'".
class ObjError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The points and faces of an OBJ file, each statement on the line on which it begins:
///   v x y z      x, y, z [m], as written; what follows them is left out
///   f a b c …    numbers of points, from 1; texture coordinates and normals are left out
/// Comments and all other statements become empty lines; a line that ends in \ is joined with the
/// next. Wavefront, "Object Files (.obj)", Advanced Visualizer Manual, appendix B1. Departure: a
/// face names only points above it.
/// @param file  the name that complaints use
/// @throws ObjError with line and column for a number or reference that is not one throughout, a
///                  point or face with fewer than three, or a line that begins with an unknown
///                  word.
std::string cleanObj(std::string_view text, const std::string& file);

}  // namespace tumble
