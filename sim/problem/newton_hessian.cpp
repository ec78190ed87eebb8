// The matrices of Newton's steps: M + ρ Jᵀ ∂Π J, patch by patch.
#include <algorithm>
#include <cmath>

#include "sim/problem/newton_system.h"

namespace tumble {
namespace {

/// ∂Π_K on the surface of a friction cone; z is what is projected, of which only the tangential
/// part counts.
template <class Point>
Mat3 edgeSlope(const Point& point, const Vec3& z) {
  const double mu = point.mu, tangential = std::hypot(z[1], z[2]);
  const Vec3 along(1.0, mu * z[1] / tangential, mu * z[2] / tangential);
  const Vec3 across(0.0, -z[2] / tangential, z[1] / tangential);
  return along * along.transpose() / (1.0 + mu * mu) +
         mu * point.force[0] / tangential * across * across.transpose();
}

/// ∂Π_K on a piece.
template <class Point>
Mat3 slopeOf(const Point& point, Piece piece, double rho, double yielding) {
  Mat3 slope = Mat3::Zero();
  if (piece == Piece::Edge) return edgeSlope(point, point.lambda - rho * point.u);
  slope.diagonal().head(point.kind == ConeKind::Friction ? 3 : 1).setConstant(yielding);
  return slope;
}

/// A + B Cᵀ, of which the lower triangle counts.
template <class B, class C>
void addLower(Mat6& A, const B& b, const C& c) {
  A.leftCols<2>().noalias() += b.lazyProduct(c.template topRows<2>().transpose());
  A.block<4, 2>(2, 2).noalias() +=
      b.template bottomRows<4>().lazyProduct(c.template middleRows<2>(2).transpose());
  A.block<2, 2>(4, 4).noalias() +=
      b.template bottomRows<2>().lazyProduct(c.template bottomRows<2>().transpose());
}

template <class B, class C>
void addLower(Mat3& A, const B& b, const C& c) {
  A.noalias() += b.lazyProduct(c.transpose());
}

/// Adds ρ J ∂Π Jᵀ of one point to the lower triangle.
template <class Point, class Block>
void addPoint(const Point& point, double rho, double yielding, Block& K) {
  if (point.kind != ConeKind::Friction) {
    K.noalias() += (rho * yielding * point.J.col(0)) * point.J.col(0).transpose();
  } else if (point.factored == Piece::Whole) {
    addLower(K, (rho * point.J).eval(), point.J);
  } else {
    const Mat3 slope = rho * slopeOf(point, Piece::Edge, rho, yielding);
    addLower(K, point.J.lazyProduct(slope).eval(), point.J);
  }
}

template <class Block>
void mirror(Block& K) {
  for (int c = 1; c < K.cols(); ++c)
    for (int r = 0; r < c; ++r) K(r, c) = K(c, r);
}

/// Xᵀ K, for X that brings the twist of b to the centre of a, from which b is an arm away.
Mat3 atOtherCentre(const Vec3& /*arm*/, const Mat3& K) {
  return K;
}
Mat6 atOtherCentre(const Vec3& arm, const Mat6& K) {
  Mat6 moved = K;
  for (int c = 0; c < 6; ++c) moved.col(c).tail<3>() += arm.cross(Vec3(K.col(c).head<3>()));
  return moved;
}

}  // namespace

/// A factor begins with A = M + K.
template <int N>
template <class Factor>
void NewtonSystem<N>::beginMasses(Factor& factor) {
  factor.begin(*structure_);
  for (std::size_t i = 0; i < movers.size(); ++i) {
    Block& block = factor.diagonal(static_cast<int>(i));
    block.diagonal().template head<3>().setConstant(movers[i].mass);
    if constexpr (N == 6) block.template bottomRightCorner<3, 3>() = movers[i].inertia;
  }
  for (const Link& link : couplings_) {
    if (link.i == link.j) {
      factor.diagonal(link.i).template topLeftCorner<3, 3>() += link.block;
      continue;
    }
    const Mat3 below = link.iIsRow ? link.block : Mat3(link.block.transpose());
    factor.lower(link.edge).template topLeftCorner<3, 3>() += below;
    if constexpr (Factor::kHasUpper)
      factor.upper(link.edge).template topLeftCorner<3, 3>() += below.transpose();
  }
}

/// Where the unhindered motion approaches, or stays to rounding, a contact is expected to hold;
/// there rounding alone would choose a piece.
template <int N>
void NewtonSystem<N>::guessPieces() {
  constexpr double kNearly = 1e-6;  // of the scale
  const double nearly = kNearly * scale;
  forRows(&Mover::star, [&](Point& point, const Three& star) {
    const bool holds = std::min(star[0] + point.bias[0], point.u[0]) < nearly;
    const bool slips = point.piece == Piece::Edge && std::hypot(point.u[1], point.u[2]) >= nearly;
    point.factored = holds && !slips ? Piece::Whole : point.piece;
  });
  guess_ = false;
}

/// Adds to a factor what one point with rows of its own for b gives.
template <int N>
template <class Factor>
void NewtonSystem<N>::addAlone(Factor& factor, const Patch& patch, const Point& point,
                               const Mat3& slope) {
  const Rows& other = others_[patch.other];
  const Rows a = point.J * slope, b = other * slope;
  factor.diagonal(patch.a).noalias() += a.lazyProduct(point.J.transpose());
  factor.diagonal(patch.b).noalias() += b.lazyProduct(other.transpose());
  const Block ab = a.lazyProduct(other.transpose()), ba = b.lazyProduct(point.J.transpose());
  factor.lower(patch.edge) += patch.aIsRow ? ab : ba;
  if constexpr (Factor::kHasUpper) factor.upper(patch.edge) += patch.aIsRow ? ba : ab;
}

/// H = A + ρ Jᵀ ∂Π J.
template <int N>
[[gnu::flatten]] void NewtonSystem<N>::assemble() {
  beginMasses(H_);
  if (guess_) {
    guessPieces();
  } else {
    for (Point& point : points) point.factored = point.piece;
  }
  for (const Patch& patch : patches_) {
    if (patch.a < 0) continue;
    if (!patch.shares) {
      const Point& point = points[patch.begin];
      if (point.factored != Piece::Zero)
        addAlone(H_, patch, point, rho * slopeOf(point, point.factored, rho, yielding(point)));
      continue;
    }
    Block K = Block::Zero();
    for (int p = patch.begin; p < patch.end; ++p)
      if (points[p].factored != Piece::Zero) addPoint(points[p], rho, yielding(points[p]), K);
    H_.diagonal(patch.a) += K;
    if (patch.b < 0) continue;
    mirror(K);
    const Block ba = atOtherCentre(patch.arm, K), ab = ba.transpose();
    H_.lower(patch.edge) -= patch.aIsRow ? ab : ba;
    H_.diagonal(patch.b) += atOtherCentre(patch.arm, ab);
  }
  H_.factor();
  factoredRho_ = rho;
  ++factorizations;
}

/// ∂Π (1 + n mu ûtᵀ), with ût the direction of the slip; or what the law of springs has instead.
template <int N>
Mat3 NewtonSystem<N>::liveSlope(const Point& point) const {
  if (springs_) return slopeOfSpring(point, point.lambda - rho * point.u);
  const Mat3 slope = slopeOf(point, point.piece, rho, yielding(point));
  const double slip = std::hypot(point.u[1], point.u[2]);
  if (point.kind != ConeKind::Friction || !(slip > 0.0)) return slope;
  Mat3 follows = Mat3::Identity();
  follows.row(0).template tail<2>() = point.mu / slip * point.u.template tail<2>().transpose();
  return slope * follows;
}

/// The Jacobian of the gradient where s = mu |u_t| follows v: M + ρ Jᵀ ∂Π (1 + n mu ûtᵀ) J, with ût
/// the direction of the slip. Not symmetric.
template <int N>
void NewtonSystem<N>::assembleLive() {
  beginMasses(live_);
  for (const Patch& patch : patches_) {
    if (patch.a < 0) continue;
    Block K = Block::Zero();
    for (int p = patch.begin; p < patch.end; ++p) {
      const Point& point = points[p];
      if (point.piece == Piece::Zero) continue;
      const Mat3 slope = rho * liveSlope(point);
      if (!patch.shares) {
        addAlone(live_, patch, point, slope);
      } else {
        K.noalias() += (point.J * slope).lazyProduct(point.J.transpose());
      }
    }
    live_.diagonal(patch.a) += K;
    if (patch.b < 0 || !patch.shares) continue;
    const Block ba = atOtherCentre(patch.arm, K);
    const Block ab = atOtherCentre(patch.arm, Block(K.transpose())).transpose();
    live_.lower(patch.edge) -= patch.aIsRow ? ab : ba;
    live_.upper(patch.edge) -= patch.aIsRow ? ba : ab;
    live_.diagonal(patch.b) += atOtherCentre(patch.arm, ab);
  }
  live_.factor();
  ++factorizations;
}

template void NewtonSystem<3>::beginMasses(BlockCholesky<3>&);
template void NewtonSystem<6>::beginMasses(BlockCholesky<6>&);
template void NewtonSystem<3>::assemble();
template void NewtonSystem<6>::assemble();
template Mat3 NewtonSystem<3>::liveSlope(const Point&) const;
template Mat3 NewtonSystem<6>::liveSlope(const Point&) const;
template void NewtonSystem<3>::assembleLive();
template void NewtonSystem<6>::assembleLive();

}  // namespace tumble
