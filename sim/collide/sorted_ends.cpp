#include "sim/collide/sorted_ends.h"

#include <algorithm>

namespace tumble {

namespace {

void sortUnique(std::vector<std::pair<int, int>>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace

// Intervals are closed: where values are equal, a lower end stands before an upper one.
bool SortedEnds::before(const End& a, const End& b) {
  return a.value < b.value || (a.value == b.value && a.isLower && !b.isLower);
}

void SortedEnds::update(std::span<const Aabb> boxes, std::vector<Pair>& pairs) {
  swaps_ = 0;
  if (boxes.size() != last_.size()) {
    startAfresh(boxes);
  } else {
    begun_.clear();
    ended_.clear();
    for (int axis = 0; axis < 3; ++axis) sortAxis(axis, boxes);
    mergeChanges();
  }
  last_.assign(boxes.begin(), boxes.end());
  pairs.assign(pairs_.begin(), pairs_.end());
}

void SortedEnds::startAfresh(std::span<const Aabb> boxes) {
  const int count = static_cast<int>(boxes.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<End>& ends = ends_[axis];
    ends.clear();
    for (int i = 0; i < count; ++i) {
      ends.push_back({boxes[i].lo[axis], i, true});
      ends.push_back({boxes[i].hi[axis], i, false});
    }
    std::sort(ends.begin(), ends.end(), before);
  }

  // One sweep along x meets every pair that overlaps there. The last open box takes the place of
  // one that closes.
  pairs_.clear();
  open_.clear();
  place_.resize(boxes.size());
  for (const End& end : ends_[0]) {
    if (!end.isLower) {
      place_[open_.back()] = place_[end.box];
      open_[place_[end.box]] = open_.back();
      open_.pop_back();
      continue;
    }
    for (const int other : open_)
      if (boxes[end.box].overlaps(boxes[other])) pairs_.push_back(std::minmax(end.box, other));
    place_[end.box] = open_.size();
    open_.push_back(end.box);
  }
  std::sort(pairs_.begin(), pairs_.end());
}

void SortedEnds::sortAxis(int axis, std::span<const Aabb> boxes) {
  std::vector<End>& ends = ends_[axis];
  for (End& end : ends) {
    end.value = end.isLower ? boxes[end.box].lo[axis] : boxes[end.box].hi[axis];
  }
  for (std::size_t k = 1; k < ends.size(); ++k) {
    const End moved = ends[k];
    std::size_t place = k;
    for (; place > 0 && before(moved, ends[place - 1]); --place) {
      noteSwap(moved, ends[place - 1], boxes);
      ends[place] = ends[place - 1];
      ++swaps_;
    }
    ends[place] = moved;
  }
}

// Two ends change places at most once in a sort, and only if their final order is new: a pair can
// begin or end to overlap only where a lower end of one passes an upper end of the other.
void SortedEnds::noteSwap(const End& moved, const End& passed, std::span<const Aabb> boxes) {
  if (moved.isLower == passed.isLower || moved.box == passed.box) return;
  const Pair pair = std::minmax(moved.box, passed.box);
  const bool was = last_[pair.first].overlaps(last_[pair.second]);
  const bool is = boxes[pair.first].overlaps(boxes[pair.second]);
  if (is && !was) begun_.push_back(pair);
  if (was && !is) ended_.push_back(pair);
}

void SortedEnds::mergeChanges() {
  if (begun_.empty() && ended_.empty()) return;
  sortUnique(begun_);
  sortUnique(ended_);
  merged_.clear();
  auto begun = begun_.cbegin();
  auto ended = ended_.cbegin();
  for (const Pair& pair : pairs_) {
    for (; begun != begun_.cend() && *begun < pair; ++begun) merged_.push_back(*begun);
    if (ended != ended_.cend() && *ended == pair) {
      ++ended;
    } else {
      merged_.push_back(pair);
    }
  }
  merged_.insert(merged_.end(), begun, begun_.cend());
  pairs_.swap(merged_);
}

}  // namespace tumble
