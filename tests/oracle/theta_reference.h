// A free body in quadruple precision by the theta functions of the literature: one evaluation for
// any time, so that ten thousand bodies can be compared. Held itself to Taylor series.
#pragma once

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <complex>
#include <numeric>

#include "tests/flight/taylor_reference.h"
#include "tests/oracle/quad.h"

namespace tumble::test {

using Complex = std::complex<Quad>;

/// Jacobi's ϑ₁ … ϑ₄ of nome q at z, given e^{iz} and e^{−iz}, and their slopes, by direct
/// summation.
struct Thetas {
  Complex theta[5], slope[5];

  Thetas(const Quad& q, const Complex& up, const Complex& down) {
    theta[3] = theta[4] = 1;
    Complex ups = up, downs = down;  // e^{±ikz}
    const Quad root = sqrt(q), step = sqrt(root);
    Quad scale = step, ratio = root;
    // k = 1, 2, 3, …: q^{k²/4}, of ϑ₁ and ϑ₂ where k is odd, of ϑ₃ and ϑ₄ where it is even.
    for (int k = 1; k < 400; ++k) {
      const Complex cosine = (ups + downs) / Quad(2), minus = (ups - downs) / Quad(2);
      const Complex sine(minus.imag(), -minus.real());
      const Quad f = 2 * scale, sign = (k / 2) % 2 ? -1 : 1;
      if (k % 2) {
        sum(1, sign * f, sine, k, cosine);
        sum(2, f, cosine, k, -sine);
      } else {
        sum(3, f, cosine, k, -sine);
        sum(4, sign * f, cosine, k, -sine);
      }
      if (scale * (abs(ups.real()) + abs(ups.imag()) + abs(downs.real()) + abs(downs.imag())) <
          1e-38)
        break;
      ups *= up;
      downs *= down;
      scale *= ratio * step;
      ratio *= root;
    }
  }

 private:
  void sum(int j, const Quad& factor, const Complex& value, int k, const Complex& derivative) {
    theta[j] += factor * value;
    slope[j] += factor * Quad(k) * derivative;
  }
};

inline Quad meanOf(Quad a, Quad b) {
  while (abs(a - b) > 1e-18 * a) {
    const Quad mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
  }
  return (a + b) / 2;
}

/// The free top of the literature (Whittaker, Analytical Dynamics, §69; van Zon and Schofield 2007)
/// in the frame of its polhode: sn, cn, dn by ϑ₁ … ϑ₄ of nome e^{−πK′/K}, the angle about L by ϑ₃
/// and ϑ₄ at v + iξ. Three unlike moments, and no steady spin.
class ThetaTop {
 public:
  explicit ThetaTop(const FreeTop<Quad>& top) : start_(top) {
    chooseAxes();
    const Quad d1 = abs(1 / I_[1] - 1 / I_[0]), d3 = abs(1 / I_[2] - 1 / I_[1]), d = d1 + d3;
    const Quad l11 = l_[0] * l_[0], l22 = l_[1] * l_[1], l33 = l_[2] * l_[2];
    a_ = {sqrt(l11 + l22 * d3 / d), sqrt(l22 + l11 * d / d3), sqrt(l33 + l22 * d1 / d)};
    const Quad k = sqrt(d1 / d3) * a_[0] / a_[2];
    const Quad k1 = sqrt(d * (d3 * l33 - d1 * l11) / (d3 * (d * l33 + d1 * l22)));
    const Quad pi = boost::math::constants::pi<Quad>();
    const Quad M = meanOf(1, k1), M1 = meanOf(1, k);  // π/2K, π/2K′
    q_ = exp(-pi * M / M1);
    sense_ = I_[0] < I_[2] ? 1 : -1;
    const Quad sn = sense_ * l_[1] / a_[1], cn = l_[0] / a_[0], dn = l_[2] / a_[2];
    v0_ = M * sn * boost::math::ellint_rf(Quad(cn * cn), Quad(dn * dn), Quad(1));
    xi_ = -sense_ * M * sqrt(d3) * boost::math::ellint_rf(d1, Quad(d1 / (a_[2] * a_[2])), d);
    rate_ = M * L_ * a_[2] * sqrt(d * d3);

    const Thetas zero(q_, Quad(1), Quad(1)), begin = at(0, xi_);
    for (int j = 2; j <= 4; ++j) theta_[j] = zero.theta[j].real();
    const Complex s = structure(begin.theta), slope = structure(begin.slope);
    // Im (slope / s), s real.
    A_ = L_ * (a_[2] / I_[2] + (1 - a_[2]) / I_[0]) - rate_ * slope.imag() / s.real();
  }

  /// Attitude (w, x, y, z) after t [s].
  std::array<Quad, 4> attitude(const Quad& t) const {
    const std::array<Quad, 4> from = inFrame(0), to = inFrame(t);
    // from⁻¹ to, its vector along the body axes.
    std::array<Quad, 3> turn;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      turn[i] = from[0] * to[i + 1] - to[0] * from[i + 1] -
                (from[j + 1] * to[k + 1] - from[k + 1] * to[j + 1]);
    }
    Quad w = 0;
    for (int i = 0; i < 4; ++i) w += from[i] * to[i];
    std::array<Quad, 3> u;
    for (int i = 0; i < 3; ++i) u[axis_[i]] = sign_[i] * turn[i];
    const auto& q = start_.q;
    return {q[0] * w - q[1] * u[0] - q[2] * u[1] - q[3] * u[2],
            q[0] * u[0] + w * q[1] + q[2] * u[2] - q[3] * u[1],
            q[0] * u[1] + w * q[2] + q[3] * u[0] - q[1] * u[2],
            q[0] * u[2] + w * q[3] + q[1] * u[1] - q[2] * u[0]};
  }

 private:
  /// Axis 3 holds the spin (Jacobi's order), L leans towards axes 1 and 3.
  void chooseAxes() {
    const auto& I = start_.I;
    const auto& L = start_.L;
    std::iota(axis_.begin(), axis_.end(), 0);
    std::sort(axis_.begin(), axis_.end(), [&](int i, int j) { return I[i] < I[j]; });
    const auto hold = [&](int end) {
      const int k = axis_[end], middle = axis_[1];
      return Quad(abs(1 / I[middle] - 1 / I[k]) * L[k] * L[k]);
    };
    if (hold(2) < hold(0)) std::swap(axis_[0], axis_[2]);
    L_ = sqrt(L[0] * L[0] + L[1] * L[1] + L[2] * L[2]);
    sign_[0] = L[axis_[0]] < 0 ? -1 : 1;
    sign_[2] = L[axis_[2]] < 0 ? -1 : 1;
    const bool even = axis_[1] == (axis_[0] + 1) % 3;
    sign_[1] = sign_[0] * sign_[2] * (even ? 1 : -1);
    for (int i = 0; i < 3; ++i) {
      I_[i] = I[axis_[i]];
      l_[i] = sign_[i] * L[axis_[i]] / L_;
    }
  }

  Thetas at(const Quad& v, const Quad& x) const {
    const Quad s = sin(v), c = cos(v), e = exp(x);
    return Thetas(q_, Complex(c / e, s / e), Complex(c * e, -s * e));
  }

  Complex structure(const Complex (&f)[5]) const { return theta_[3] * f[4] + theta_[4] * f[3]; }

  std::array<Quad, 4> inFrame(const Quad& t) const {
    const Quad v = v0_ + rate_ * t;
    const Thetas real = at(v, 0);
    const Quad down = real.theta[4].real();
    const Quad l1 = a_[0] * theta_[4] / theta_[2] * real.theta[2].real() / down;
    const Quad l2 = sense_ * a_[1] * theta_[3] / theta_[2] * real.theta[1].real() / down;
    const Quad l3 = a_[2] * theta_[4] / theta_[3] * real.theta[3].real() / down;
    // (w + iz)² = ½ (1 + l₃) e^{iψ},  x + iy = −i (l₁ + i l₂)(w + iz)/(1 + l₃).
    const Complex s = structure(at(v, xi_).theta);
    const Quad size = sqrt(s.real() * s.real() + s.imag() * s.imag());
    const Quad half = A_ * t / 2, c = cos(half), d = sin(half);
    const Quad re = sqrt((1 + s.real() / size) / 2), im = s.imag() / size / (2 * re);
    const Quad r = sqrt((1 + l3) / 2), w = r * (c * re - d * im), z = r * (d * re + c * im);
    return {w, (l1 * z + l2 * w) / (1 + l3), (l2 * z - l1 * w) / (1 + l3), z};
  }

  FreeTop<Quad> start_;
  std::array<int, 3> axis_;
  std::array<int, 3> sign_;
  std::array<Quad, 3> I_, l_, a_;
  Quad L_, q_, v0_, xi_, rate_, A_, theta_[5];
  int sense_;
};

}  // namespace tumble::test
