#include "sim/problem/block_cholesky.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace tumble {

BlockStructure::BlockStructure(int rows, std::span<const BlockEdge> edges)
    : rows_(rows), edges_(edges.begin(), edges.end()) {
  order();
  fill();
}

bool BlockStructure::isFor(int rows, std::span<const BlockEdge> edges) const {
  return rows == rows_ && std::equal(edges.begin(), edges.end(), edges_.begin(), edges_.end());
}

double BlockStructure::products() const {
  double sum = 0.0;
  for (int c = 0; c < rows_; ++c) {
    const double below = begin_[c + 1] - begin_[c];
    sum += 0.5 * below * (below + 1.0);
  }
  return sum;
}

void BlockStructure::order() {
  Eigen::SparseMatrix<double> graph(rows_, rows_);  // its lower triangle
  graph.reserve(static_cast<Eigen::Index>(edges_.size()) + rows_);
  auto edge = edges_.begin();
  for (int i = 0; i < rows_; ++i) {
    graph.startVec(i);
    graph.insertBack(i, i) = 1.0;
    for (; edge != edges_.end() && edge->first == i; ++edge)
      graph.insertBack(edge->second, i) = 1.0;
  }
  graph.finalize();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(graph.selfadjointView<Eigen::Lower>(), permutation);
  place_.resize(rows_);
  for (int k = 0; k < rows_; ++k) place_[permutation.indices()[k]] = k;
}

/// A column of the factor has the blocks of the matrix, and those of the columns whose first block
/// stands in its row.
void BlockStructure::fill() {
  std::vector<std::vector<int>> columns(rows_);
  for (const auto& [i, j] : edges_) {
    const auto [first, last] = std::minmax(place_[i], place_[j]);
    columns[first].push_back(last);
  }
  begin_.assign(1, 0);
  for (int c = 0; c < rows_; ++c) {
    std::vector<int>& column = columns[c];
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    below_.insert(below_.end(), column.begin(), column.end());
    begin_.push_back(static_cast<int>(below_.size()));
    if (column.empty()) continue;
    std::vector<int>& parent = columns[column.front()];
    parent.insert(parent.end(), column.begin() + 1, column.end());
  }
  for (const auto& [i, j] : edges_) {
    const auto [first, last] = std::minmax(place_[i], place_[j]);
    const auto from = below_.begin() + begin_[first], to = below_.begin() + begin_[first + 1];
    slot_.push_back(static_cast<int>(std::lower_bound(from, to, last) - below_.begin()));
  }
}

const BlockStructure& BlockStructures::of(int rows, std::span<const BlockEdge> edges) {
  constexpr std::size_t kMost = 64;
  for (const auto& structure : known_)
    if (structure->isFor(rows, edges)) return *structure;
  if (known_.size() == kMost) known_.erase(known_.begin());
  known_.push_back(std::make_unique<BlockStructure>(rows, edges));
  return *known_.back();
}

template <int N>
void BlockCholesky<N>::begin(const BlockStructure& structure) {
  structure_ = &structure;
  diagonal_.resize(structure.rows_);
  blocks_.resize(structure.below_.size());
  moved_.resize(structure.rows_);
  for (Block& block : diagonal_) block.setZero();
  for (Block& block : blocks_) block.setZero();
}

template <int N>
int BlockCholesky<N>::edgeRow(int e) const {
  const auto& [i, j] = structure_->edges_[e];
  return structure_->place_[i] > structure_->place_[j] ? i : j;
}

template <int N>
[[gnu::flatten]] bool invertFactor(Eigen::Matrix<double, N, N>& A) {
  Eigen::Matrix<double, N, N> L = Eigen::Matrix<double, N, N>::Zero();
  double inverse[N];  // of its diagonal
  for (int j = 0; j < N; ++j) {
    double pivot = A(j, j);
    for (int k = 0; k < j; ++k) pivot -= L(j, k) * L(j, k);
    if (!(pivot > 0.0)) return false;
    const double scale = 1.0 / std::sqrt(pivot);
    inverse[j] = scale;
    for (int i = j + 1; i < N; ++i) {
      double sum = A(i, j);
      for (int k = 0; k < j; ++k) sum -= L(i, k) * L(j, k);
      L(i, j) = sum * scale;
    }
  }
  A.setZero();
  for (int j = 0; j < N; ++j) {
    A(j, j) = inverse[j];
    for (int i = j + 1; i < N; ++i) {
      double sum = 0.0;
      for (int k = j; k < i; ++k) sum -= L(i, k) * A(k, j);
      A(i, j) = sum * inverse[i];
    }
  }
  return true;
}

namespace {

/// A Lᵀ for a lower triangle L.
Mat3 timesUpper(const Mat3& A, const Mat3& L) {
  return A.lazyProduct(L.transpose());
}

/// The same: each column of the product ends where its row of L does.
Mat6 timesUpper(const Mat6& A, const Mat6& L) {
  Mat6 product;
  product.leftCols<2>().noalias() =
      A.leftCols<2>().lazyProduct(L.topLeftCorner<2, 2>().transpose());
  product.middleCols<2>(2).noalias() = A.leftCols<4>().lazyProduct(L.block<2, 4>(2, 0).transpose());
  product.rightCols<2>().noalias() = A.lazyProduct(L.bottomRows<2>().transpose());
  return product;
}

/// A − B Bᵀ, of which the lower triangle counts.
void takeSquare(Mat3& A, const Mat3& B) {
  A.noalias() -= B.lazyProduct(B.transpose());
}

/// The same, in pairs of columns.
void takeSquare(Mat6& A, const Mat6& B) {
  A.leftCols<2>().noalias() -= B.lazyProduct(B.topRows<2>().transpose());
  A.block<4, 2>(2, 2).noalias() -= B.bottomRows<4>().lazyProduct(B.middleRows<2>(2).transpose());
  A.block<2, 2>(4, 4).noalias() -= B.bottomRows<2>().lazyProduct(B.bottomRows<2>().transpose());
}

}  // namespace

/// Divides a column by its diagonal, and takes its products off the columns to the right.
template <int N>
[[gnu::flatten]] void BlockCholesky<N>::eliminate(int column) {
  const std::vector<int>&begin = structure_->begin_, &below = structure_->below_;
  const Block& inverse = diagonal_[column];
  const int first = begin[column], end = begin[column + 1];
  for (int s = first; s < end; ++s) {
    blocks_[s] = timesUpper(blocks_[s], inverse);
  }
  for (int s = first; s < end; ++s) {
    const int j = below[s];
    takeSquare(diagonal_[j], blocks_[s]);
    int target = begin[j];
    for (int r = s + 1; r < end; ++r, ++target) {
      while (below[target] != below[r]) ++target;
      blocks_[target].noalias() -= blocks_[r].lazyProduct(blocks_[s].transpose());
    }
  }
}

template <int N>
bool BlockCholesky<N>::factor() {
  for (int c = 0; c < structure_->rows_; ++c) {
    if (!invertFactor(diagonal_[c])) return false;
    eliminate(c);
  }
  return true;
}

template <int N>
[[gnu::flatten]] void BlockCholesky<N>::solve(std::span<Part> x) {
  const std::vector<int>&begin = structure_->begin_, &below = structure_->below_;
  const int n = structure_->rows_;
  for (int i = 0; i < n; ++i) moved_[structure_->place_[i]] = x[i];
  for (int c = 0; c < n; ++c) {
    const Part y = diagonal_[c].lazyProduct(moved_[c]);
    moved_[c] = y;
    for (int s = begin[c]; s < begin[c + 1]; ++s)
      moved_[below[s]].noalias() -= blocks_[s].lazyProduct(y);
  }
  for (int c = n - 1; c >= 0; --c) {
    Part y = moved_[c];
    for (int s = begin[c]; s < begin[c + 1]; ++s)
      y.noalias() -= blocks_[s].transpose().lazyProduct(moved_[below[s]]);
    moved_[c].noalias() = diagonal_[c].transpose().lazyProduct(y);
  }
  for (int i = 0; i < n; ++i) x[i] = moved_[structure_->place_[i]];
}

template <int N>
void BlockLU<N>::begin(const BlockStructure& structure) {
  structure_ = &structure;
  diagonal_.assign(structure.rows_, Block::Zero());
  lower_.assign(structure.below_.size(), Block::Zero());
  upper_.assign(structure.below_.size(), Block::Zero());
  moved_.resize(structure.rows_);
}

template <int N>
void BlockLU<N>::factor() {
  const std::vector<int>&begin = structure_->begin_, &below = structure_->below_;
  for (int c = 0; c < structure_->rows_; ++c) {
    diagonal_[c] = Block(diagonal_[c].partialPivLu().inverse());
    for (int s = begin[c]; s < begin[c + 1]; ++s) lower_[s] *= diagonal_[c];
    for (int s = begin[c]; s < begin[c + 1]; ++s) {
      const int j = below[s];
      diagonal_[j].noalias() -= lower_[s].lazyProduct(upper_[s]);
      int target = begin[j];
      for (int r = s + 1; r < begin[c + 1]; ++r, ++target) {
        while (below[target] != below[r]) ++target;
        lower_[target].noalias() -= lower_[r].lazyProduct(upper_[s]);
        upper_[target].noalias() -= lower_[s].lazyProduct(upper_[r]);
      }
    }
  }
}

template <int N>
void BlockLU<N>::solve(std::span<Part> x) {
  const std::vector<int>&begin = structure_->begin_, &below = structure_->below_;
  const int n = structure_->rows_;
  for (int i = 0; i < n; ++i) moved_[structure_->place_[i]] = x[i];
  for (int c = 0; c < n; ++c)
    for (int s = begin[c]; s < begin[c + 1]; ++s)
      moved_[below[s]].noalias() -= lower_[s].lazyProduct(moved_[c]);
  for (int c = n - 1; c >= 0; --c) {
    Part y = moved_[c];
    for (int s = begin[c]; s < begin[c + 1]; ++s)
      y.noalias() -= upper_[s].lazyProduct(moved_[below[s]]);
    moved_[c].noalias() = diagonal_[c].lazyProduct(y);
  }
  for (int i = 0; i < n; ++i) x[i] = moved_[structure_->place_[i]];
}

template bool invertFactor(Mat3& A);
template bool invertFactor(Mat6& A);
template class BlockCholesky<3>;
template class BlockCholesky<6>;
template class BlockLU<3>;
template class BlockLU<6>;

}  // namespace tumble
