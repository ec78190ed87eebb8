// vary = { key = [first, last] }: numbers of a template that run from copy to copy.
#pragma once

#include "app/scene/section.h"

namespace tumble {

/// A number or list of numbers at a key of the template.
struct Variation {
  std::vector<std::string> key;  ///< {"shape", "sphere"}
  Spot spot;
  bool list = false;
  std::vector<double> first, last;

  /// Writes the value of copy i of n into the template:
  ///   ((n − 1 − i) first + i last) / (n − 1), both ends exact.
  void apply(Table& body, int i, int n) const;
};

/// Reads the key `vary` of an array, nested tables and dotted keys alike.
std::vector<Variation> readVary(Section& array);

}  // namespace tumble
