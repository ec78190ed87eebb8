#include "sim/elastic/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tumble {
namespace {

/// Modes of F as its corners move along with them, and what each weighs beside the base of the law.
struct Modes {
  Eigen::Matrix<double, 12, 9> q;
  Eigen::Matrix<double, 9, 1> weight;  ///< [Pa]
  int count = 0;

  /// A mode that weighs nothing more is left out.
  template <class Mode>
  void add(double weighs, double base, const Mode& mode) {
    if (weighs == base) return;
    weight[count] = weighs - base;
    q.col(count++) = mode();
  }
};

/// The three modes of the stretches themselves, and those in which F turns or shears in the plane
/// of two of them.
[[gnu::flatten]] Modes modesOf(const Mat3& U, const StretchLaw& law,
                               const std::array<Vec3, 4>& turned, double least) {
  Modes modes;
  for (int m = 0; m < 3; ++m)
    modes.add(std::max(law.weight[m], least), law.base,
              [&] { return cornersOf(law.way.col(m).asDiagonal(), U, turned); });
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const auto inPlane = [&](double sign) {
      Eigen::Matrix<double, 12, 1> q;
      for (int c = 0; c < 4; ++c)
        q.segment<3>(3 * c) =
            std::sqrt(0.5) * (turned[c][j] * U.col(i) + sign * turned[c][i] * U.col(j));
      return q;
    };
    modes.add(std::max(law.twist[k], least), law.base, [&] { return inPlane(-1.0); });
    modes.add(std::max(law.flip[k], least), law.base, [&] { return inPlane(1.0); });
  }
  return modes;
}

/// F V for a rotation V that is found, with columns at right angles, the longest first: turns of
/// Jacobi's, which lose nothing of short columns beside long ones (Hestenes, Inversion of Matrices
/// by Biorthogonalization and Related Results, 1958). V is asked for or left alone.
template <bool AsksV>
struct Straight {
  Mat3 FV, V = Mat3::Identity();

  [[gnu::flatten]] explicit Straight(const Mat3& F) : FV(F) {
    constexpr int kRounds = 12;  // each squares what is left of the cosines: five do
    for (int round = 0; round < kRounds; ++round) {
      const bool first = turn<0, 1>(), second = turn<0, 2>();
      if (!turn<1, 2>() && !first && !second) break;
    }
    sort<0, 1>();
    sort<1, 2>();
    sort<0, 1>();
  }

  /// Two columns to right angles. @return whether they were not
  template <int I, int J>
  bool turn() {
    constexpr double kRight = 1e-15;  // cosine that is rounding
    const double a = FV.col(I).squaredNorm(), b = FV.col(J).squaredNorm(),
                 twice = 2.0 * FV.col(I).dot(FV.col(J));
    if (!(twice * twice > 4.0 * kRight * kRight * a * b)) return false;
    // The lesser angle:  t² d + t (b − a) − d = 0  of its tangent.
    const double more = b - a, root = std::sqrt(more * more + twice * twice);
    const double t = twice / (more + std::copysign(root, more));
    const double c = 1.0 / std::sqrt(1.0 + t * t);
    turn<I, J>(c, c * t);
    return true;
  }

  template <int I, int J>
  void turn(double c, double s) {
    const auto turned = [=](Mat3& A) {
      for (int k = 0; k < 3; ++k) {
        const double p = A(k, I), q = A(k, J);
        A(k, I) = c * p - s * q;
        A(k, J) = s * p + c * q;
      }
    };
    turned(FV);
    if constexpr (AsksV) turned(V);
  }

  template <int I, int J>
  void sort() {
    if (FV.col(I).squaredNorm() < FV.col(J).squaredNorm()) turn<I, J>(0.0, 1.0);
  }
};

/// Of F V with columns at right angles. The last direction follows from the others, and any will do
/// for a column that is 0.
[[gnu::flatten]] Stretches stretchesOf(const Mat3& FV, const Mat3& V) {
  Stretches s{Mat3::Identity(), V, {FV.col(0).norm(), FV.col(1).norm(), 0.0}};
  if (s.sigma[0] > 0.0) s.U.col(0) = FV.col(0) / s.sigma[0];
  s.U.col(1) = s.sigma[1] > 0.0 ? Vec3(FV.col(1) / s.sigma[1]) : s.U.col(0).unitOrthogonal();
  s.U.col(2) = s.U.col(0).cross(s.U.col(1));
  s.sigma[2] = s.U.col(2).dot(FV.col(2));
  return s;
}

}  // namespace

Vec3 stretchesAloneOf(const Mat3& F) {
  return stretchesOf(Straight<false>(F).FV, Mat3::Identity()).sigma;
}

Stretches stretchesOf(const Mat3& F) {
  const Straight<true> straight(F);
  return stretchesOf(straight.FV, straight.V);
}

Stretches stretchesFor(ElementAsk ask, const Mat3& F) {
  if (ask != ElementAsk::Energy) return stretchesOf(F);
  return {Mat3::Identity(), Mat3::Identity(), stretchesAloneOf(F)};
}

Cell cellOf(const std::array<Vec3, 4>& x) {
  Mat3 edges;
  edges << x[1] - x[0], x[2] - x[0], x[3] - x[0];
  const double six = edges.determinant();
  if (!(six > 0.0)) throw std::invalid_argument("a tetrahedron without volume, or inside out");
  Cell cell;
  cell.volume = six / 6.0;
  for (int i = 0; i < 3; ++i)
    cell.gradient[i + 1] = edges.col((i + 1) % 3).cross(edges.col((i + 2) % 3)) / six;
  cell.gradient[0] = -(cell.gradient[1] + cell.gradient[2] + cell.gradient[3]);
  return cell;
}

Solidity solidityOf(double young, double poisson, double viscosity) {
  if (!(young > 0.0) || !(poisson >= 0.0) || !(poisson < 0.5))
    throw std::invalid_argument("a solid needs E > 0 and Poisson's ratio in [0, 0.5)");
  return {.mu = 0.5 * young / (1.0 + poisson),
          .lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
          .viscosity = viscosity};
}

[[gnu::flatten]] Mat3 deformation(const Cell& cell, const ElementPlaces& x) {
  Mat3 F = Mat3::Zero();
  for (int i = 0; i < 4; ++i) F.noalias() += x[i] * cell.gradient[i].transpose();
  return F;
}

[[gnu::flatten]] void differentiateSolid(const Cell& cell, double viscosity, const Mat3& F,
                                         const Stretches& stretches, const StretchLaw& law,
                                         ElementAsk ask, ElementTerms& terms) {
  terms.energy = cell.volume * law.energy;
  if (ask == ElementAsk::Energy) return;
  std::array<Vec3, 4> turned;
  for (int i = 0; i < 4; ++i) turned[i] = stretches.V.transpose() * cell.gradient[i];
  // P = U diag(ψ) Vᵀ.
  terms.gradient.head<12>() = cell.volume * cornersOf(law.slope.asDiagonal(), stretches.U, turned);
  if (ask == ElementAsk::Forces) return;
  const double least =
      ask == ElementAsk::Projected ? 0.0 : -std::numeric_limits<double>::infinity();
  const Modes modes = modesOf(stretches.U, law, turned, least);
  setBlocks<4>(terms.hessian, [&](int i, int j) {
    Mat3 block = law.base * cell.gradient[i].dot(cell.gradient[j]) * Mat3::Identity();
    for (int m = 0; m < modes.count; ++m) {
      const Vec3 q = modes.weight[m] * modes.q.col(m).segment<3>(3 * i);
      block += q * modes.q.col(m).segment<3>(3 * j).transpose();
    }
    return Mat3(cell.volume * block);
  });
  if (viscosity > 0.0)
    setViscosity(cell.gradient, cell.volume, viscosity, F, terms.damping);
  else
    terms.damping.topLeftCorner<12, 12>().setZero();
}

}  // namespace tumble
