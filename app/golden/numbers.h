// Two tables of numbers, held against each other.
#pragma once

#include <string>

namespace tumble {

/// How far two CSV texts are apart. A number may be off by 1e-9 of the expected one plus 1e-12.
struct NumberDifference {
  bool exact = true;  ///< the same bytes
  double worst =
      0.0;  ///< [1] largest deviation over what is allowed; infinity where the shape differs
  std::string where;  ///< line, column and both values of the worst; empty if exact
  bool passes() const { return worst <= 1.0; }
};

/// Compares header, count of lines and every field. What is not a finite number has to agree as
/// text.
NumberDifference compareNumbers(const std::string& expected, const std::string& actual);

}  // namespace tumble
