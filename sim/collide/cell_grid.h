// Chapter 5, collide: near pairs from cells of space, at a cost that grows as the number of bodies.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sim/shape/shape.h"

namespace tumble {

/// Finds overlapping boxes by the cells in which they begin, and remembers which are near: boxes
/// are grown by a margin, and while none has left its grown box, only grown boxes that overlap can
/// be pairs (Verlet, "Computer Experiments on Classical Fluids", 1967). The faster a box has moved,
/// the larger its margin; a few that are too fast for one are held against all.
///
/// Boxes of one level, up to four times as large as each other, share a grid whose cells are no
/// smaller than they: two that overlap begin in the same cell or in neighbours. A box is held
/// against the larger levels too (Mirtich, "Impulse-based Dynamic Simulation", 1996, §2.3), and
/// boxes of levels with few in them, such as a floor, against all. The cells of a grid wrap around
/// a table with about one bucket a box, as wide along each axis as the boxes are spread: a grid
/// ends nowhere, and neighbours stand together in memory.
class CellGrid {
 public:
  using Pair = std::pair<int, int>;

  /// Pairs (i, j), i < j, of boxes [m] that overlap or touch, sorted, whatever the history; but
  /// none of two boxes of a set that is told apart.
  /// @param apart  per box whether it is of that set, the same in every call; or empty
  void update(std::span<const Aabb> boxes, std::span<const char> apart, std::vector<Pair>& pairs);

  /// Calls that made the grid anew.
  long builds() const { return builds_; }

 private:
  /// A box [m] about the middle of all, in half the memory.
  struct ShortBox {
    std::array<float, 3> lo, hi;
  };
  struct Entry {
    ShortBox box;
    int body;
  };
  struct Level {
    int size = 0;                       ///< boxes up to 4^size times the usual one
    double perCell = 0.0;               ///< [1/m] one over the edge of a cell
    double reach = 0.0;                 ///< [m] by which rounding may enlarge a box
    std::array<unsigned, 3> bits = {};  ///< buckets along each axis are 2^bits, four or more
    std::vector<int> bodies;
    bool apart = false;      ///< all of them are of the set
    std::vector<int> first;  ///< entry of each bucket, and one past the last
    std::vector<Entry> entries;
  };
  /// Entries that stand side by side.
  struct Range {
    int first, last;
  };

  /// Whether two boxes, by their numbers, are both of the set that is told apart.
  bool bothApart(int i, int j) const {
    return !apart_.empty() && apart_[static_cast<std::size_t>(i)] &&
           apart_[static_cast<std::size_t>(j)];
  }
  bool anyLeft(std::span<const Aabb> boxes);
  void build(std::span<const Aabb> boxes);
  void grow(std::span<const Aabb> boxes);
  double median(std::vector<double>& values) const;
  double motionOf(std::size_t body) const;
  void chooseMiddle();
  void sortIntoLevels();
  void place(Level& level);
  void findWithin(const Level& level);
  void findAcross(const Level& small, const Level& large);
  void findOfFew();
  void findOverlaps(std::span<const Aabb> boxes, std::vector<Pair>& pairs) const;
  void test(const Entry& entry, const Level& level, Range range);
  void sortFound();
  void shorten();

  std::span<const char> apart_;  ///< of this call
  std::vector<ShortBox> now_;    ///< of this call, rounded
  std::vector<ShortBox> grown_;  ///< when the grid was made, rounded outward
  std::vector<int> partner_;     ///< near bodies of each body that come after it, sorted
  std::vector<int> start_;       ///< first partner of each body, and one past the last
  float rounding_ = 0.0f;        ///< [m] of the difference of two rounded coordinates
  Vec3 middle_ = Vec3::Zero();
  double usual_ = 0.0;         ///< [m] edge of a cell of level 0
  std::vector<Level> levels_;  ///< from small to large; only the first `used_` are
  std::size_t used_ = 0;
  std::vector<int> few_;         ///< boxes held against all
  long builds_ = 0, calls_ = 0;  ///< calls since the last of them

  // Scratch, to allocate nothing once warm.
  std::vector<Aabb> wide_;  ///< grown boxes before rounding
  std::vector<double> extents_, values_;
  std::vector<int> size_, bucket_;
  std::vector<Pair> found_;
};

}  // namespace tumble
