#include "sim/elastic/cloth.h"

#include <cmath>

namespace tumble {
namespace {

/// Adds the elements of one rectangle of cloth.
class Weaver {
 public:
  Weaver(const ClothDef& cloth, int first, std::vector<Element>& out)
      : cloth_(cloth),
        first_(first),
        a_(cloth.length / (cloth.columns - 1)),
        b_(cloth.width / (cloth.rows - 1)),
        out_(out) {}

  void addThreads() {
    for (int j = 0; j < cloth_.rows; ++j)
      for (int i = 0; i + 1 < cloth_.columns; ++i)
        addThread({i, j}, {i + 1, j}, a_, j == 0 || j == cloth_.rows - 1 ? 0.5 * b_ : b_);
    for (int j = 0; j + 1 < cloth_.rows; ++j)
      for (int i = 0; i < cloth_.columns; ++i)
        addThread({i, j}, {i, j + 1}, b_, i == 0 || i == cloth_.columns - 1 ? 0.5 * a_ : a_);
  }

  /// Shear, and the twist that bends.
  void addCells() {
    const Weave weave = weaveOf(a_, b_);
    for (int j = 0; j + 1 < cloth_.rows; ++j)
      for (int i = 0; i + 1 < cloth_.columns; ++i) {
        const std::array<int, kElementPoints> corners = {at(i, j), at(i + 1, j), at(i, j + 1),
                                                         at(i + 1, j + 1)};
        if (cloth_.shear > 0.0) add(corners, ClothShear{weave, cloth_.shear, cloth_.damping});
        if (cloth_.bend > 0.0)
          add(corners, ClothBend{{1.0, -1.0, -1.0, 1.0}, 2.0 * cloth_.bend / (a_ * b_)});
      }
  }

  /// Threads that bend, each with its share of the width.
  void addBends() {
    if (cloth_.bend <= 0.0) return;
    for (int j = 0; j < cloth_.rows; ++j)
      for (int i = 1; i + 1 < cloth_.columns; ++i)
        addBend({at(i - 1, j), at(i, j), at(i + 1, j)}, a_,
                j == 0 || j == cloth_.rows - 1 ? 0.5 * b_ : b_);
    for (int j = 1; j + 1 < cloth_.rows; ++j)
      for (int i = 0; i < cloth_.columns; ++i)
        addBend({at(i, j - 1), at(i, j), at(i, j + 1)}, b_,
                i == 0 || i == cloth_.columns - 1 ? 0.5 * a_ : a_);
  }

 private:
  int at(int i, int j) const { return first_ + clothPoint(cloth_, i, j); }

  void add(const std::array<int, kElementPoints>& points, const Energy& energy) {
    out_.push_back({.points = points, .count = pointsOf(energy), .energy = energy});
  }
  void addThread(std::pair<int, int> p, std::pair<int, int> q, double length, double width) {
    if (cloth_.stretch <= 0.0) return;
    add({at(p.first, p.second), at(q.first, q.second)},
        StretchSpring{.stiffness = cloth_.stretch * width / length,
                      .damping = cloth_.damping * width / length,
                      .rest = length});
  }
  void addBend(const std::array<int, 3>& p, double length, double width) {
    add({p[0], p[1], p[2]},
        ClothBend{.difference = {1.0, -2.0, 1.0, 0.0},
                  .stiffness = cloth_.bend * width / (length * length * length)});
  }

  const ClothDef& cloth_;
  int first_;
  double a_, b_;
  std::vector<Element>& out_;
};

}  // namespace

std::vector<Vec3> clothPlaces(const ClothDef& cloth) {
  std::vector<Vec3> places;
  for (int j = 0; j < cloth.rows; ++j)
    for (int i = 0; i < cloth.columns; ++i)
      places.emplace_back((i - 0.5 * (cloth.columns - 1)) * (cloth.length / (cloth.columns - 1)),
                          0.0, (j - 0.5 * (cloth.rows - 1)) * (cloth.width / (cloth.rows - 1)));
  return places;
}

std::vector<double> clothMasses(const ClothDef& cloth) {
  const double cell =
      cloth.density * cloth.length * cloth.width / ((cloth.columns - 1) * (cloth.rows - 1));
  std::vector<double> masses;
  for (int j = 0; j < cloth.rows; ++j)
    for (int i = 0; i < cloth.columns; ++i)
      masses.push_back(cell * (i == 0 || i == cloth.columns - 1 ? 0.5 : 1.0) *
                       (j == 0 || j == cloth.rows - 1 ? 0.5 : 1.0));
  return masses;
}

std::vector<Element> clothElements(const ClothDef& cloth, int first) {
  std::vector<Element> elements;
  Weaver weaver(cloth, first, elements);
  weaver.addThreads();
  weaver.addCells();
  weaver.addBends();
  return elements;
}

std::vector<std::array<int, 3>> clothTriangles(const ClothDef& cloth, int first) {
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j + 1 < cloth.rows; ++j)
    for (int i = 0; i + 1 < cloth.columns; ++i) {
      const int a = first + clothPoint(cloth, i, j), b = a + 1, c = a + cloth.columns, d = c + 1;
      const bool down = (2 * i + 2 < cloth.columns) == (2 * j + 2 < cloth.rows);
      triangles.push_back({a, c, down ? d : b});
      triangles.push_back({down ? a : c, d, b});
    }
  return triangles;
}

Sheet clothSheet(const ClothDef& cloth, double thickness, int first) {
  Sheet sheet{.triangles = clothTriangles(cloth, first)};
  for (const Vec3& place : clothPlaces(cloth)) sheet.flat.emplace_back(place.x(), place.z());
  sheet.thickness = thickness;
  if (thickness > 0.0) {
    constexpr double kStops = 4.0;  // [m/s]
    const double cell =
        cloth.density * cloth.length * cloth.width / ((cloth.columns - 1) * (cloth.rows - 1));
    sheet.stiffness = cell * std::pow(2.0 * kStops / thickness, 2);
  }
  return sheet;
}

}  // namespace tumble
