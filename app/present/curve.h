// Smooth curves and sheets through points.
#pragma once

#include <cstddef>
#include <vector>

namespace tumble {

/// The curve through places that are evenly apart, each piece in equal parts: cubics whose slope at
/// a place is that of the chord of its neighbours (Catmull and Rom 1974); beyond an end it is taken
/// to go on straight.
/// @param places  at least two; a Vector has +, − and multiples
template <class Vector>
std::vector<Vector> curveThrough(const std::vector<Vector>& places, int parts) {
  std::vector<Vector> curve = {places.front()};
  const std::size_t last = places.size() - 1;
  for (std::size_t k = 0; k < last; ++k) {
    const Vector &b = places[k], &c = places[k + 1];
    const Vector a = k > 0 ? places[k - 1] : Vector(2.0 * b - c);
    const Vector d = k + 1 < last ? places[k + 2] : Vector(2.0 * c - b);
    for (int part = 1; part <= parts; ++part) {
      const double s = static_cast<double>(part) / parts;
      curve.push_back(
          b +
          0.5 * s * (c - a + s * (2.0 * a - 5.0 * b + 4.0 * c - d + s * (3.0 * (b - c) + d - a))));
    }
  }
  return curve;
}

/// The sheet through a grid of places, row by row: such curves along the rows, and across them.
/// @param columns  places of a row, at least two of two rows
template <class Vector>
std::vector<Vector> sheetThrough(const std::vector<Vector>& places, int columns, int parts) {
  const std::size_t rows = places.size() / static_cast<std::size_t>(columns);
  std::vector<std::vector<Vector>> along;
  for (std::size_t j = 0; j < rows; ++j) {
    const auto row = places.begin() + static_cast<std::ptrdiff_t>(j) * columns;
    along.push_back(curveThrough(std::vector<Vector>(row, row + columns), parts));
  }
  const std::size_t width = along.front().size(), height = (rows - 1) * parts + 1;
  std::vector<Vector> sheet(width * height, places.front());
  for (std::size_t i = 0; i < width; ++i) {
    std::vector<Vector> column;
    for (const std::vector<Vector>& row : along) column.push_back(row[i]);
    const std::vector<Vector> across = curveThrough(column, parts);
    for (std::size_t j = 0; j < height; ++j) sheet[j * width + i] = across[j];
  }
  return sheet;
}

}  // namespace tumble
