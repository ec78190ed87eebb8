#include "sim/problem/aggregates.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>

namespace tumble {

void Aggregates::gather(const NodeMatrix& A) {
  of_.assign(A.own.size(), -1);
  count_ = 0;
  const auto around = [&](int node) {
    return std::span(A.near).subspan(A.begin[node], A.begin[node + 1] - A.begin[node]);
  };
  const auto isFree = [&](const NodeMatrix::Neighbour& other) { return of_[other.node] < 0; };
  // A node none of whose neighbours is taken begins an aggregate with all of them.
  for (int i = 0; i < A.count(); ++i) {
    const auto others = around(i);
    if (of_[i] >= 0 || !std::all_of(others.begin(), others.end(), isFree)) continue;
    for (const auto& other : others) of_[other.node] = count_;
    of_[i] = count_++;
  }
  // What is left goes with the neighbour that it is tied to most.
  const std::vector<int> first = of_;
  for (int i = 0; i < A.count(); ++i) {
    double most = 0.0;
    if (first[i] >= 0) continue;
    for (const auto& other : around(i)) {
      const double tie = other.block.squaredNorm();
      if (first[other.node] < 0 || !(tie > most)) continue;
      most = tie;
      of_[i] = first[other.node];
    }
    if (of_[i] < 0) of_[i] = count_++;
  }
  findEdges(A);
}

void Aggregates::findEdges(const NodeMatrix& A) {
  // The few that each is next to, of a higher number.
  std::vector<boost::container::small_vector<int, 8>> next(count_);
  const auto forPairs = [&](const auto& act) {
    for (int i = 0; i < A.count(); ++i)
      for (int k = A.begin[i]; k < A.begin[i + 1]; ++k)
        if (const int p = of_[i], q = of_[A.near[k].node]; p != q)
          act(k, std::min(p, q), std::max(p, q));
  };
  forPairs([&](int, int p, int q) {
    if (std::find(next[p].begin(), next[p].end(), q) == next[p].end()) next[p].push_back(q);
  });
  edges_.clear();
  std::vector<int> first;
  for (int p = 0; p < count_; ++p) {
    std::sort(next[p].begin(), next[p].end());
    first.push_back(static_cast<int>(edges_.size()));
    for (const int q : next[p]) edges_.emplace_back(p, q);
  }
  edgeOf_.assign(A.near.size(), -1);
  forPairs([&](int k, int p, int q) {
    const auto at = std::find(next[p].begin(), next[p].end(), q);
    edgeOf_[k] = first[p] + static_cast<int>(at - next[p].begin());
  });
  if (!structure_ || !structure_->isFor(count_, edges_))
    structure_ = std::make_unique<BlockStructure>(count_, edges_);
}

Mat3 freeBlock(const Freedom& F, const Mat3& block, const Freedom& G) {
  if (F.kind == Freedom::Kind::All && G.kind == Freedom::Kind::All) return block;
  return F.along.lazyProduct(block).lazyProduct(G.along);
}

[[gnu::flatten]] void Aggregates::factor(const NodeMatrix& A, std::span<const Freedom> free) {
  // Of the diagonal: what an aggregate has along what none of its nodes is free.
  constexpr double kAcross = 1e-10;
  using Kind = Freedom::Kind;
  free_.assign(free.begin(), free.end());
  factor_.begin(*structure_);
  std::vector<char> moves(count_, 0);
  for (int i = 0; i < A.count(); ++i) {
    if (free_[i].kind == Kind::None) continue;
    const int p = of_[i];
    moves[p] = 1;
    factor_.diagonal(p) += freeBlock(free_[i], A.own[i], free_[i]);
    if (free_[i].kind == Kind::Some)
      factor_.diagonal(p).diagonal().array() += kAcross * A.own[i].trace();
    for (int k = A.begin[i]; k < A.begin[i + 1]; ++k) {
      const int j = A.near[k].node;
      if (free_[j].kind == Kind::None) continue;
      if (edgeOf_[k] < 0)
        factor_.diagonal(p) += freeBlock(free_[i], A.near[k].block, free_[j]);
      else if (factor_.edgeRow(edgeOf_[k]) == p)
        factor_.lower(edgeOf_[k]) += freeBlock(free_[i], A.near[k].block, free_[j]);
    }
  }
  for (int p = 0; p < count_; ++p)
    if (!moves[p]) factor_.diagonal(p).setIdentity();
  factor_.factor();
}

void Aggregates::correct(std::span<const Vec3> r, std::span<Vec3> v) {
  using Kind = Freedom::Kind;
  sums_.assign(count_, Vec3::Zero());
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (free_[i].kind == Kind::All) sums_[of_[i]] += r[i];
    if (free_[i].kind == Kind::Some) sums_[of_[i]] += free_[i].along.lazyProduct(r[i]);
  }
  factor_.solve(sums_);
  for (std::size_t i = 0; i < r.size(); ++i) {
    if (free_[i].kind == Kind::All) v[i] += sums_[of_[i]];
    if (free_[i].kind == Kind::Some) v[i] += free_[i].along.lazyProduct(sums_[of_[i]]);
  }
}

}  // namespace tumble
