// Two tables of numbers, held against each other.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tumble {

/// How far two CSV texts are apart. A number may be off by 1e-9 of the expected one plus 1e-12.
struct NumberDifference {
  bool exact = true;  ///< the same bytes
  double worst =
      0.0;  ///< [1] largest deviation over what is allowed; infinity where the shape differs
  std::string where;                 ///< line, column and both values of the worst; empty if exact
  std::size_t line = 0, column = 0;  ///< of the worst, from 1; 0 where the shape differs
  bool passes() const { return worst <= 1.0; }
};

/// Compares header, count of lines and every field. What is not a finite number has to agree as
/// text.
NumberDifference compareNumbers(const std::string& expected, const std::string& actual);

/// A column of a CSV text against another.
struct Column {
  std::vector<double> x, y;
};

/// What a table with columns t and, perhaps, body says of one column: its numbers against t, of all
/// rows, or of those that are about the same body as the given line. Lines and columns from 1.
Column columnOf(const std::string& csv, std::size_t line, std::size_t column);

}  // namespace tumble
