#include "sim/flight/rotor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/math/elliptic.h"
#include "sim/math/rotation.h"

namespace tumble {
namespace {

constexpr double kPi = std::numbers::pi;

// Multiple angles as polynomials in C = cos 2v; the same with cosh and sinh.
// cos 2nv,  sin 2nv / sin 2v,  cos (2n+1)v / cos v,  sin (2n+1)v / sin v:
constexpr double kCosEven[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {-1, 0, 2, 0}, {0, -3, 0, 4}};
constexpr double kSinEven[4][4] = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 2, 0, 0}, {-1, 0, 4, 0}};
constexpr double kCosOdd[4][4] = {{1, 0, 0, 0}, {-1, 2, 0, 0}, {-1, -2, 4, 0}, {1, -4, -4, 8}};
constexpr double kSinOdd[4][4] = {{1, 0, 0, 0}, {1, 2, 0, 0}, {-1, 2, 4, 0}, {-1, -4, 4, 8}};

/// x^n for n ≥ 0.
double power(double x, int n) {
  double product = 1.0;
  for (; n > 0; n >>= 1, x *= x) {
    if (n & 1) product *= x;
  }
  return product;
}

/// rate × t [rad], less whole turns where it is so large that these alone would fill its digits.
double angle(double rate, double t) {
  const double whole = rate * t;
  return std::abs(whole) < 1e8 ? whole : std::remainder(whole, 2.0 * kPi);
}

/// ½ ψ′ where L lies in the plane of axis 3 and another, of moments I3 and I: l = (a, l3).
double halfPsiRate(double L, double a, double I, double l3, double I3) {
  return 0.5 * L * (l3 / I3 + a * a / ((1.0 + l3) * I));
}

}  // namespace

void Rotor::Series::add(int row, const double (&polynomial)[4], double factor) {
  for (int i = 0; i < 4; ++i) c[i][row] += factor * polynomial[i];
}

Rotor::Rotor(const Quat& q0, const Vec3& omega) : turning_(omega.squaredNorm()) {
  startSteady(q0, q0.normalized().conjugate() * omega);
}

Rotor::Rotor(const Mat3& Ibody, const Quat& q0, const Vec3& L) {
  const Polhode path(Ibody, q0, L);
  turning_ = path.turning();
  if (path.kind == Polhode::Kind::Rest) {
    const Vec3 omega = path.L * path.l.cwiseQuotient(path.I);
    startSteady(q0, path.axes_B * omega);
    return;
  }
  if (path.kind == Polhode::Kind::Circle) {
    startCircle(path);
  } else {
    startElliptic(path);
  }

  // q = q0 A Q(0)⁻¹ Q(t) A⁻¹, A the axes of the polhode, Q the solution in its frames.
  const Quat axes(path.axes_B);
  const Vec4 now = unturned(0.0);
  const Quat start(now[0], now[2], now[3], now[1]);
  const Quat left = q0.normalized() * axes * start.conjugate(), right = axes.conjugate();
  const Quat basis[4] = {{1, 0, 0, 0}, {0, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  for (int i = 0; i < 4; ++i) frame_.col(i) = (left * basis[i] * right).coeffs();
}

void Rotor::startSteady(const Quat& q0, const Vec3& omega_B) {
  // q = q0 (cos ωt/2, n_B sin ωt/2).
  const double omega = omega_B.norm();
  const Quat unit = q0.normalized();
  const Vec3 n_B = omega > 0.0 ? Vec3(omega_B / omega) : Vec3(Vec3::UnitZ());
  phaseRate_ = 0.5 * omega;
  frame_.setZero();
  frame_.col(0) = unit.coeffs();
  frame_.col(1) = (unit * Quat(0.0, n_B.x(), n_B.y(), n_B.z())).coeffs();
}

void Rotor::startCircle(const Polhode& path) {
  // K = K(0) = π/2, and l₃ = a₃ stays: tan ½β = E*.
  rate_ = path.L * path.s3;
  const double sine = path.sense * path.l[1] / path.a2, cosine = path.l[0] / path.a1;
  start_ = sine * carlsonRF(cosine * cosine, 1.0, 1.0);
  startTrigonometric(path, 0.0, path.a1 / (1.0 + path.a3));
}

void Rotor::startElliptic(const Polhode& path) {
  // K = π s₃/2M, K′ = π s₃/2M′.
  const double M = agm(path.s3, path.s), M_ = agm(path.s3, path.s1);
  const double etaStar = path.a3 * carlsonRF(path.a1 * path.a1, path.a2 * path.a2, 1.0);
  // u₀ = F(am u₀ | m) from sn u₀, cn u₀ ≥ 0 and dn u₀.
  const double sn = path.sense * path.l[1] / path.a2;
  const double cn = path.l[0] / path.a1, dn = path.l[2] / path.a3;
  const double u0 = sn * carlsonRF(cn * cn, dn * dn, 1.0);

  if (M_ < 2.0 * M) {
    rate_ = path.L * M;
    start_ = u0 * M / path.s3;
    const double xiStar = etaStar * M / path.s3;
    startTrigonometric(path, exponential(xiStar - 0.5 * kPi * M / M_), exponential(-xiStar));
  } else {
    hyperbolic_ = true;
    rate_ = 0.5 * path.L * M_;
    start_ = 0.5 * u0 * M_ / path.s3;
    period_ = 0.5 * kPi * M_ / M;
    startHyperbolic(path, 0.25 * kPi - 0.5 * etaStar * M_ / path.s3, exponential(-period_));
  }
}

// ϑ₄ = 1 + 2 Σ (−1)ⁿ p^{n²} cos 2nζ,  ϑ₁ = 2 Σ (−1)ⁿ p^{(n+½)²} sin (2n+1)ζ,  ζ = v ∓ iξ. The rate
// A is ψ′ at v = 0 less what ϑ₄ adds there.
void Rotor::startTrigonometric(const Polhode& path, double E, double E_) {
  series_.c[0].setZero();
  series_.add(0, kCosEven[0], 1.0);
  double theta = 1.0, slope = 0.0, sign = 1.0;  // ϑ₄ and its slope at v = 0
  for (int n = 0; n < 4; ++n, sign = -sign) {
    // p^{n²} e^{±2nξ} and p^{(n+½)²} e^{±(2n+1)ξ}.
    if (n > 0) {
      const double scale = sign * power(E_, 4 * n * n);
      const double large = scale * power(E, 4 * n * n - 2 * n), small = large * power(E, 4 * n);
      series_.add(0, kCosEven[n], large + small);
      series_.add(1, kSinEven[n], path.sense * (large - small));
      theta += large + small;
      slope += 2 * n * (large - small);
    }
    const int odd = 2 * n + 1;
    const double large = sign * power(E_, odd * odd) * power(E, odd * odd - odd);
    const double small = large * power(E, 2 * odd);
    series_.add(2, kSinOdd[n], path.sense * (large + small));
    series_.add(3, kCosOdd[n], small - large);
  }
  phaseRate_ = halfPsiRate(path.L, path.a1, path.I[0], path.a3, path.I[2]) -
               path.sense * rate_ * slope / theta;
}

// The same by ϑ₂ and i ϑ₁ of ∓ξ − iY and nome e^{−Λ}, up to a factor of modulus ≠ 1 and the phase
// that goes into the rate: ψ′ where l₁ = 0 less what is added there.
void Rotor::startHyperbolic(const Polhode& path, double xi, double nome) {
  series_.c[0].setZero();
  double theta = 1.0, slope = 0.0, sign = 1.0;
  for (int n = 0; n < 4; ++n, sign = -sign) {
    double s, c;
    sinCos((2 * n + 1) * xi, s, c);
    const double scale = power(nome, n * n + n);
    series_.add(0, kCosOdd[n], scale * c);
    series_.add(1, kSinOdd[n], -path.sense * scale * s);
    series_.add(2, kSinOdd[n], path.sense * sign * scale * c);
    series_.add(3, kCosOdd[n], -sign * scale * s);
    sinCos(2 * n * xi, s, c);
    if (n == 0) continue;
    theta += 2.0 * power(nome, n * n) * c;
    slope += 4.0 * n * power(nome, n * n) * s;
  }
  phaseStep_ = -2.0 * path.sense * xi;
  const double l3 = path.a3 * path.s / path.s3;
  phaseRate_ =
      halfPsiRate(path.L, path.a2, path.I[1], l3, path.I[2]) + path.sense * rate_ * slope / theta;
}

Rotor::Waves Rotor::trigonometric(double t) const {
  double s, c;
  sinCos(start_ + angle(rate_, t), s, c);
  return {{1.0, 2.0 * s * c, s, c}, (c - s) * (c + s), angle(phaseRate_, t)};
}

Rotor::Waves Rotor::hyperbolic(double t) const {
  // Y less whole half periods, each of which turns the body half round axis 3.
  double Y = start_ + rate_ * t;
  const double count = std::floor(Y / period_ + 0.5);
  Y -= count == 0.0 ? 0.0 : count * period_;
  const bool odd = count != 2.0 * std::floor(0.5 * count);

  // Beyond 40 the body is at rest beside axis 2 to all digits.
  const double e = exponential(std::clamp(Y, -40.0, 40.0));
  const double ch = 0.5 * (e + 1.0 / e), sh = 0.5 * (e - 1.0 / e);
  const double half = odd ? -1.0 : 1.0;
  return {{ch, sh, half * sh, half * ch},
          ch * ch + sh * sh,
          angle(phaseRate_, t) + angle(phaseStep_, count)};
}

Vec4 Rotor::unturned(double t) const {
  const Waves waves = hyperbolic_ ? hyperbolic(t) : trigonometric(t);
  const double C = waves.C;
  const Vec4* p = series_.c;
  const Vec4 f = (p[0] + C * (p[1] + C * (p[2] + C * p[3]))).cwiseProduct(waves.functions);
  double s, c;
  sinCos(waves.phase, s, c);
  const Vec4 turned(c * f[0] - s * f[1], s * f[0] + c * f[1],  //
                    c * f[2] - s * f[3], s * f[2] + c * f[3]);
  return turned / std::sqrt(f.squaredNorm());
}

Quat Rotor::attitude(double t) const {
  return Quat(Vec4(frame_ * unturned(t)));
}

}  // namespace tumble
