#include "sim/collide/cell_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace tumble {
namespace {

// Margins, measured by tests/bench/sim/broad_phase.cpp.
constexpr double kLeastMargin = 0.15, kMostMargin = 0.5;  // of the median box
constexpr double kCalls = 12.0;                           // that a margin lasts for
constexpr int kFew = 8;                                   // boxes that need no grid
constexpr int kSizes = 40;                                // levels to either side of the usual one
constexpr int kNoLevel = kSizes + 1;
constexpr double kFar = 1 << 20;    // cells from the middle that a grid goes
constexpr double kSlack = 1e-6;     // of a cell: for the rounding of doubles
constexpr double kRounding = 4e-7;  // of a coordinate: more than a float errs by
constexpr std::size_t kAhead = 12;  // pairs whose boxes are called for before they are needed

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double extentOf(const Aabb& box) {
  return (box.hi - box.lo).maxCoeff();
}

int cellAlong(double x, double perCell) {
  return static_cast<int>(std::floor(x * perCell));
}

/// Buckets along an axis, less one: coordinates of cells wrap by this mask.
int maskOf(unsigned bits) {
  return (1 << bits) - 1;
}

float larger(float x, float y) {
  return x < y ? y : x;
}

/// Widest gap [m] along an axis; < 0 for boxes that overlap.
template <class Box>
float gapOf(const Box& a, const Box& b) {
  const float x = larger(a.lo[0] - b.hi[0], b.lo[0] - a.hi[0]);
  const float y = larger(a.lo[1] - b.hi[1], b.lo[1] - a.hi[1]);
  const float z = larger(a.lo[2] - b.hi[2], b.lo[2] - a.hi[2]);
  return larger(larger(x, y), z);
}

/// Boxes that overlap are never apart, rounded or not.
template <class Box>
bool apart(const Box& a, const Box& b) {
  return gapOf(a, b) > 0.0f;
}

/// Calls act(first, last) for the entries in the cells from x0 to x1 of a row, which are fewer than
/// its buckets.
template <class Level, class Action>
void forEachRange(const Level& level, int x0, int x1, int y, int z, Action act) {
  const int mask = maskOf(level.bits[0]);
  const int row = (((z & maskOf(level.bits[2])) << level.bits[1]) + (y & maskOf(level.bits[1])))
                  << level.bits[0];
  const auto firstOf = [&](int x) { return level.first[static_cast<std::size_t>(row + x)]; };
  const int from = x0 & mask, to = x1 & mask;
  if (from <= to) {
    act(firstOf(from), firstOf(to + 1));
  } else {
    act(firstOf(from), firstOf(mask + 1));
    act(firstOf(0), firstOf(to + 1));
  }
}

}  // namespace

void CellGrid::update(std::span<const Aabb> boxes, std::span<const char> apart,
                      std::vector<Pair>& pairs) {
  apart_ = apart;
  ++calls_;
  if (boxes.size() != grown_.size() || anyLeft(boxes)) {
    build(boxes);
    anyLeft(boxes);
  }
  findOverlaps(boxes, pairs);
}

/// Rounds all boxes, and tells whether one is no longer inside its grown box.
bool CellGrid::anyLeft(std::span<const Aabb> boxes) {
  now_.resize(boxes.size());
  bool left = false;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      now_[i].lo[k] = static_cast<float>(boxes[i].lo[axis] - middle_[axis]);
      now_[i].hi[k] = static_cast<float>(boxes[i].hi[axis] - middle_[axis]);
      left |= !(grown_[i].lo[k] <= now_[i].lo[k] && now_[i].hi[k] <= grown_[i].hi[k]);
    }
  return left;
}

/// Near pairs whose boxes overlap now. Where rounding leaves a doubt the boxes themselves decide.
void CellGrid::findOverlaps(std::span<const Aabb> boxes, std::vector<Pair>& pairs) const {
  pairs.resize(partner_.size());
  const std::size_t last = partner_.empty() ? 0 : partner_.size() - 1;
  std::size_t count = 0, k = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const ShortBox a = now_[i];
    for (const auto end = static_cast<std::size_t>(start_[i + 1]); k < end; ++k) {
      const auto j = static_cast<std::size_t>(partner_[k]);
      // Boxes of later partners are on their way from memory meanwhile.
      __builtin_prefetch(&now_[static_cast<std::size_t>(partner_[std::min(k + kAhead, last)])]);
      const float gap = gapOf(a, now_[j]);
      bool is = gap < 0.0f;
      if (!(std::abs(gap) > rounding_)) is = boxes[i].overlaps(boxes[j]);
      pairs[count] = {static_cast<int>(i), static_cast<int>(j)};
      count += is ? 1 : 0;
    }
  }
  pairs.resize(count);
}

void CellGrid::build(std::span<const Aabb> boxes) {
  ++builds_;
  grow(boxes);
  chooseMiddle();
  sortIntoLevels();
  shorten();
  found_.clear();
  for (std::size_t l = 0; l < used_; ++l) {
    place(levels_[l]);
    findWithin(levels_[l]);
    for (std::size_t small = 0; small < l; ++small) findAcross(levels_[small], levels_[l]);
  }
  findOfFew();
  sortFound();
  calls_ = 0;
}

double CellGrid::median(std::vector<double>& values) const {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How far [m] along an axis the middle of a box has gone in a call, since the grid was made; 0
/// where that is not known.
double CellGrid::motionOf(std::size_t body) const {
  if (grown_.size() != wide_.size()) return 0.0;
  const ShortBox &now = now_[body], &then = grown_[body];
  float most = 0.0f;
  for (std::size_t k = 0; k < 3; ++k)
    most = larger(most, std::abs(now.lo[k] + now.hi[k] - (then.lo[k] + then.hi[k])));
  return std::isfinite(most) ? 0.5 * most / static_cast<double>(calls_) : 0.0;
}

/// The usual box is the largest of no more than twice the median.
void CellGrid::grow(std::span<const Aabb> boxes) {
  wide_.assign(boxes.begin(), boxes.end());
  extents_.clear();
  values_.clear();
  for (const Aabb& box : boxes) {
    extents_.push_back(extentOf(box));
    if (std::isfinite(extents_.back())) values_.push_back(extents_.back());
  }
  const double size = median(values_);
  usual_ = 0.0;
  for (const double extent : values_)
    if (extent <= 2.0 * size) usual_ = std::max(usual_, extent);
  usual_ += 2.0 * kLeastMargin * size;
  usual_ = usual_ > 0.0 ? usual_ * (1.0 + 4.0 * kSlack) : 1.0;

  const double most = kMostMargin * size;
  int fast = 0;
  for (std::size_t i = 0; i < wide_.size(); ++i) fast += motionOf(i) > 0.5 * most;
  for (std::size_t i = 0; i < wide_.size(); ++i) {
    const double motion = motionOf(i);
    double margin = std::clamp(kCalls * motion, kLeastMargin * size, most);
    if (fast > kFew)
      margin = 0.0;
    else if (motion > 0.5 * most)
      margin = kInfinity;
    wide_[i].lo.array() -= margin;
    wide_[i].hi.array() += margin;
  }
}

/// Half of all boxes begin to either side of the middle.
void CellGrid::chooseMiddle() {
  for (int k = 0; k < 3; ++k) {
    values_.clear();
    for (const Aabb& box : wide_)
      if (std::isfinite(box.lo[k])) values_.push_back(box.lo[k]);
    middle_[k] = median(values_);
  }
}

void CellGrid::sortIntoLevels() {
  // Cells of level k are 4^k usual boxes wide. Boxes that are told apart have levels of their own.
  std::array<int, 2 * (2 * kSizes + 2)> counts{};
  const auto keyOf = [&](int i) {
    const int size = size_[static_cast<std::size_t>(i)];
    return static_cast<std::size_t>(2 * (size + kSizes) + (bothApart(i, i) ? 1 : 0));
  };
  size_.assign(wide_.size(), kNoLevel);
  for (std::size_t i = 0; i < wide_.size(); ++i) {
    const double ratio = extentOf(wide_[i]) / usual_ * (1.0 + kSlack);
    if (!std::isfinite(ratio)) continue;
    int exponent = 0;
    std::frexp(ratio, &exponent);
    const int size = std::max(-kSizes, exponent >= 0 ? (exponent + 1) / 2 : exponent / 2);
    const double away = (wide_[i].lo - middle_).lpNorm<Eigen::Infinity>();
    if (size > kSizes || !(away < kFar * std::ldexp(usual_, 2 * size))) continue;
    size_[i] = size;
    ++counts[keyOf(static_cast<int>(i))];
  }

  std::array<int, counts.size()> levelOf{};
  used_ = 0;
  for (std::size_t key = 0; key < counts.size(); ++key) {
    if (counts[key] <= kFew) continue;
    if (levels_.size() == used_) levels_.emplace_back();
    levelOf[key] = static_cast<int>(used_);
    levels_[used_].size = static_cast<int>(key / 2) - kSizes;
    levels_[used_].apart = key % 2 == 1;
    levels_[used_].bodies.clear();
    ++used_;
  }
  few_.clear();
  for (int i = 0; i < static_cast<int>(wide_.size()); ++i) {
    const std::size_t key = keyOf(i);
    if (counts[key] <= kFew)
      few_.push_back(i);
    else
      levels_[static_cast<std::size_t>(levelOf[key])].bodies.push_back(i);
  }
  for (const int i : few_) size_[static_cast<std::size_t>(i)] = kNoLevel;
}

/// Rounding to a float errs by 6e-8 of a coordinate. Boxes that overlap do so when rounded too, and
/// when grown; and one that is inside its grown box as floats reaches beyond the wide one by no
/// more than the rounding.
void CellGrid::shorten() {
  double largest = 0.0;
  grown_.resize(wide_.size());
  for (std::size_t i = 0; i < wide_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      const double lo = wide_[i].lo[axis] - middle_[axis], hi = wide_[i].hi[axis] - middle_[axis];
      grown_[i].lo[k] = static_cast<float>(lo - kRounding * std::abs(lo));
      grown_[i].hi[k] = static_cast<float>(hi + kRounding * std::abs(hi));
      for (const double x : {std::abs(lo), std::abs(hi)})
        if (std::isfinite(x)) largest = std::max(largest, x);
    }
  rounding_ = static_cast<float>(kRounding * largest);
}

/// Sorts the boxes of a level by buckets.
void CellGrid::place(Level& level) {
  // Even, boxes are spread over four times their mean distance from the middle.
  const double count = static_cast<double>(level.bodies.size());
  Vec3 spread = Vec3::Zero();
  double largest = 0.0;
  for (const int i : level.bodies) {
    const Vec3 away = (wide_[static_cast<std::size_t>(i)].lo - middle_).cwiseAbs();
    spread += away / count;
    largest = std::max(largest, away.maxCoeff());
  }
  const double cell = std::ldexp(usual_, 2 * level.size);
  level.reach = 3.0 * kRounding * (largest + cell);
  level.perCell = 1.0 / (cell + 2.0 * level.reach);
  for (int k = 0; k < 3; ++k) {
    const double cells = std::min(4.0 * spread[k] * level.perCell + 2.0, kFar);
    level.bits[static_cast<std::size_t>(k)] =
        std::max(2u, static_cast<unsigned>(std::bit_width(static_cast<unsigned>(cells))));
  }
  const unsigned most = std::max(6u, static_cast<unsigned>(std::bit_width(level.bodies.size())));
  while (level.bits[0] + level.bits[1] + level.bits[2] > most)
    --*std::max_element(level.bits.begin(), level.bits.end());

  level.first.assign((std::size_t{1} << (level.bits[0] + level.bits[1] + level.bits[2])) + 1, 0);
  bucket_.clear();
  for (const int i : level.bodies) {
    const Vec3 p = wide_[static_cast<std::size_t>(i)].lo - middle_;
    const int x = cellAlong(p.x(), level.perCell) & maskOf(level.bits[0]),
              y = cellAlong(p.y(), level.perCell) & maskOf(level.bits[1]),
              z = cellAlong(p.z(), level.perCell) & maskOf(level.bits[2]);
    bucket_.push_back((((z << level.bits[1]) + y) << level.bits[0]) + x);
    ++level.first[static_cast<std::size_t>(bucket_.back())];
  }
  int sum = 0;
  for (int& first : level.first) first = sum += first;
  level.entries.resize(level.bodies.size());
  for (std::size_t k = level.bodies.size(); k-- > 0;) {
    int& last = level.first[static_cast<std::size_t>(bucket_[k])];
    level.entries[static_cast<std::size_t>(--last)] = {
        grown_[static_cast<std::size_t>(level.bodies[k])], level.bodies[k]};
  }
}

void CellGrid::test(const Entry& a, const Level& level, Range range) {
  for (int k = range.first; k < range.last; ++k) {
    const Entry& b = level.entries[static_cast<std::size_t>(k)];
    if (!apart(a.box, b.box) && !bothApart(a.body, b.body))
      found_.push_back(std::minmax(int{a.body}, int{b.body}));
  }
}

/// Each cell against half of its neighbours, which stand in five rows; so each pair comes once.
void CellGrid::findWithin(const Level& level) {
  if (level.apart) return;
  const int nx = maskOf(level.bits[0]) + 1, ny = maskOf(level.bits[1]) + 1;
  for (std::size_t bucket = 0; bucket + 1 < level.first.size(); ++bucket) {
    const int begin = level.first[bucket], end = level.first[bucket + 1];
    if (begin == end) continue;
    const int at = static_cast<int>(bucket), x = at % nx, y = at / nx % ny, z = at / nx / ny;
    std::array<Range, 10> ranges;
    std::size_t count = 0;
    const auto add = [&](int first, int last) {
      if (first < last) ranges[count++] = {first, last};
    };
    forEachRange(level, x + 1, x + 1, y, z, add);
    forEachRange(level, x - 1, x + 1, y + 1, z, add);
    for (int beside = -1; beside <= 1; ++beside)
      forEachRange(level, x - 1, x + 1, y + beside, z + 1, add);
    for (int k = begin; k < end; ++k) {
      const Entry entry = level.entries[static_cast<std::size_t>(k)];
      test(entry, level, {k + 1, end});
      for (std::size_t r = 0; r < count; ++r) test(entry, level, ranges[r]);
    }
  }
}

/// A box of a smaller level reaches over two cells at most, and what overlaps it begins there or
/// one cell before.
void CellGrid::findAcross(const Level& small, const Level& large) {
  if (small.apart && large.apart) return;
  for (const Entry& entry : small.entries) {
    const Aabb& box = wide_[static_cast<std::size_t>(entry.body)];
    const Vec3 lo = (box.lo - middle_).array() - large.reach;
    const Vec3 hi = (box.hi - middle_).array() + large.reach;
    const auto from = [&](int k) { return cellAlong(lo[k], large.perCell) - 1; };
    const auto to = [&](int k) { return cellAlong(hi[k], large.perCell); };
    for (int z = from(2); z <= to(2); ++z)
      for (int y = from(1); y <= to(1); ++y)
        forEachRange(large, from(0), to(0), y, z, [&](int first, int last) {
          test(entry, large, {first, last});
        });
  }
}

void CellGrid::findOfFew() {
  for (const int i : few_) {
    const ShortBox& box = grown_[static_cast<std::size_t>(i)];
    for (int j = 0; j < static_cast<int>(grown_.size()); ++j) {
      const bool seen = size_[static_cast<std::size_t>(j)] == kNoLevel && j <= i;
      if (!seen && !apart(box, grown_[static_cast<std::size_t>(j)]) && !bothApart(i, j))
        found_.push_back(std::minmax(i, j));
    }
  }
}

/// By the first body in one pass, then by the second within the few that share it.
void CellGrid::sortFound() {
  start_.assign(grown_.size() + 1, 0);
  for (const Pair& pair : found_) ++start_[static_cast<std::size_t>(pair.first)];
  int sum = 0;
  for (int& start : start_) start = sum += start;
  partner_.resize(found_.size());
  for (const auto& [i, j] : found_)
    partner_[static_cast<std::size_t>(--start_[static_cast<std::size_t>(i)])] = j;
  for (std::size_t i = 0; i + 1 < start_.size(); ++i)
    std::sort(partner_.begin() + start_[i], partner_.begin() + start_[i + 1]);
}

}  // namespace tumble
