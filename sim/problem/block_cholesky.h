// Chapter 6, problem: Cholesky factors of sparse symmetric matrices made of 3 × 3 or 6 × 6 blocks.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "sim/math/vec.h"

namespace tumble {

/// Turns A into the inverse of its Cholesky factor, a lower triangle. False if A is not positive
/// definite.
template <int N>
bool invertFactor(Eigen::Matrix<double, N, N>& A);

/// Two different rows of blocks that share a block.
using BlockEdge = std::pair<int, int>;

/// Where the blocks of a matrix and of its factor stand: found once for a graph of bodies, used for
/// every matrix on it. George & Liu, Computer Solution of Large Sparse Positive Definite Systems,
/// 1981, ch. 5; the order is that of approximate minimum degree (Amestoy, Davis & Duff 1996).
class BlockStructure {
 public:
  /// @param rows   number of rows of blocks
  /// @param edges  those off the diagonal, each pair of rows at most once
  BlockStructure(int rows, std::span<const BlockEdge> edges);

  bool isFor(int rows, std::span<const BlockEdge> edges) const;

  /// How many products of two blocks a factor takes, but for those of whole columns.
  double products() const;

 private:
  template <int N>
  friend class BlockCholesky;
  template <int N>
  friend class BlockLU;
  void order();
  void fill();

  int rows_;
  std::vector<BlockEdge> edges_;
  std::vector<int> place_;  ///< per row: when it is eliminated
  std::vector<int> begin_;  ///< per column of the factor: its first block below the diagonal
  std::vector<int> below_;  ///< row of each of these blocks, ascending in a column
  std::vector<int> slot_;   ///< per edge: its block
};

/// Structures of the last graphs.
class BlockStructures {
 public:
  /// Stays where it is until many others were asked for.
  const BlockStructure& of(int rows, std::span<const BlockEdge> edges);

 private:
  std::vector<std::unique_ptr<BlockStructure>> known_;
};

/// H = L Lᵀ for a positive definite H, and solutions of H x = b. Of a diagonal block only the lower
/// triangle is read.
/// Set H block by block: `begin`, then add to `diagonal` and `lower`, then `factor`.
template <int N>
class BlockCholesky {
 public:
  static constexpr bool kHasUpper = false;
  using Block = Eigen::Matrix<double, N, N>;
  using Part = Eigen::Matrix<double, N, 1>;

  /// Starts a matrix of zeros. The structure must outlive the use.
  void begin(const BlockStructure& structure);

  Block& diagonal(int row) { return diagonal_[structure_->place_[row]]; }

  /// Block of an edge (i, j): row `edgeRow`, column the other one.
  Block& lower(int e) { return blocks_[structure_->slot_[e]]; }
  /// Which end of the edge is the row of its block.
  int edgeRow(int e) const;

  /// False if H is not positive definite to rounding.
  bool factor();

  /// x ← H⁻¹ x.
  void solve(std::span<Part> x);

 private:
  void eliminate(int column);

  const BlockStructure* structure_ = nullptr;
  std::vector<Block> diagonal_;  ///< by place; after `factor` the inverse of the diagonal of L
  std::vector<Block> blocks_;
  std::vector<Part> moved_;
};

/// H = L U for an H whose blocks stand where those of a symmetric matrix would, without exchange of
/// rows: for matrices that are nearly symmetric and positive definite.
template <int N>
class BlockLU {
 public:
  static constexpr bool kHasUpper = true;
  using Block = Eigen::Matrix<double, N, N>;
  using Part = Eigen::Matrix<double, N, 1>;

  void begin(const BlockStructure& structure);

  Block& diagonal(int row) { return diagonal_[structure_->place_[row]]; }
  /// Blocks of an edge (i, j): row `BlockCholesky::edgeRow` and column the other one, and the other
  /// way round.
  Block& lower(int e) { return lower_[structure_->slot_[e]]; }
  Block& upper(int e) { return upper_[structure_->slot_[e]]; }

  void factor();
  void solve(std::span<Part> x);

 private:
  const BlockStructure* structure_ = nullptr;
  std::vector<Block> diagonal_, lower_, upper_;  ///< after `factor`: D⁻¹, L D⁻¹, U
  std::vector<Part> moved_;
};

}  // namespace tumble
