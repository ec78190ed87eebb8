// Chapter 6, problem: points of mass that something bends between, as rows of 3 × 3 blocks.
#pragma once

#include <span>
#include <vector>

#include "sim/problem/problem.h"

namespace tumble {

/// A symmetric positive definite matrix of 3 × 3 blocks, row by row.
struct NodeMatrix {
  /// A block off the diagonal.
  struct Neighbour {
    int node = 0;
    Mat3 block = Mat3::Zero();
  };
  std::vector<Mat3> own;   ///< blocks of the diagonal
  std::vector<int> begin;  ///< per node: its first neighbour
  std::vector<Neighbour> near;

  int count() const { return static_cast<int>(own.size()); }
  void times(std::span<const Vec3> x, std::span<Vec3> out) const;
};

/// The bodies of a problem that move, as nodes, and A = M + K of them.
struct Nodes {
  std::vector<int> nodeOf, bodyOf;  ///< per body, −1 where it does not move; and back
  NodeMatrix A;

  void read(const Problem& problem);
  /// v of all bodies: those of the nodes, vStar of what stands; and no pulls.
  void write(const Problem& problem, std::span<const Vec3> v, Solution& solution) const;
};

/// The rows of a cone of a node against what does not move:  u = J v + bias.
struct NodeRows {
  int node = 0;
  Mat3 J = Mat3::Zero();     ///< rows n, t1, t2, or n alone
  Vec3 bias = Vec3::Zero();  ///< with what the other body moves
};
NodeRows rowsOfNode(const Problem& problem, const Cone& cone, std::span<const int> nodeOf);

}  // namespace tumble
