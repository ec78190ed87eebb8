// Chapter 6, problem: a coarse grid for points that bend together.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "sim/problem/block_cholesky.h"
#include "sim/problem/node_matrix.h"

namespace tumble {

/// The directions along which a node is free, as the projection onto them.
struct Freedom {
  enum class Kind { All, Some, None } kind = Kind::All;
  Mat3 along = Mat3::Identity();
  bool operator==(const Freedom&) const = default;
};

/// F B G, for a block between a node that is free along F and one that is along G.
Mat3 freeBlock(const Freedom& F, const Mat3& block, const Freedom& G);

/// What neighbours have in common of an error, which sweeps from point to point take long to find:
/// a point and those around it move as one (aggregation; Vaněk, Mandel & Brezina, Algebraic
/// Multigrid by Smoothed Aggregation, 1996, §5.1, without its smoothing).
class Aggregates {
 public:
  /// Deals the nodes out.
  void gather(const NodeMatrix& A);
  /// The matrix Pᵀ A P of aggregates, whose nodes move with theirs as far as they are free.
  void factor(const NodeMatrix& A, std::span<const Freedom> free);
  /// Moves the nodes so that nothing is left of what they are free along of r in any sum over an
  /// aggregate.
  void correct(std::span<const Vec3> r, std::span<Vec3> v);

 private:
  void findEdges(const NodeMatrix& A);

  int count_ = 0;
  std::vector<int> of_;  ///< per node: its aggregate
  std::vector<Freedom> free_;
  std::vector<BlockEdge> edges_;
  std::vector<int> edgeOf_;  ///< per neighbour in A; −1 in one aggregate
  std::unique_ptr<BlockStructure> structure_;
  BlockCholesky<3> factor_;
  std::vector<Vec3> sums_;
};

}  // namespace tumble
