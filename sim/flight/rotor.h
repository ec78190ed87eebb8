// Chapter 4, flight: the attitude of a body that turns freely, in closed form.
#pragma once

#include "sim/flight/polhode.h"

namespace tumble {

/// The torque-free rotor. Stand in a frame whose third axis lies along L, and let the body frame be
/// that of its polhode. Then the attitude is one theta function of a complex argument for each half
/// of the quaternion:
///   (w + i z,  x + i y) = e^{iAt/2} (ϑ₄(ζ), ± ϑ₁(ζ)) / norm,   ζ = v₀ + ν t ∓ i ξ,   nome p =
///   e^{−2πK′/K}, ν = L agm(s₃, s),   v₀ = π u₀ / 2K,   ξ = π η / 2K,   upper signs if I₁ < I₃
///   (`sense`).
/// For the ratio of the halves is the polhode in stereographic projection,
///   (l₁ + i l₂)/(1 + l₃) = ± i ϑ₁(ζ)/ϑ₄(ζ),
/// and arg(w + i z) = ½ ψ with ψ′ = (2T + L ω₃)/(L + L₃), which is regular because l₃ > 0. The pole
/// at l₃ = ∞ gives η = F(atan √(d₃/d₁) | 1 − m); its complement, for l₃ = 0,
///   η* = K′ − η = F(atan(a₃/a₁) | 1 − m) = a₃ RF(a₁², a₂², 1)
/// stays finite in either limit. With E = e^{−ξ}, E* = e^{−ξ*}, p = (E E*)⁴ every term of the
/// series is a product of powers of E and E*; a symmetric body has E = 0, a spin about axis 3 has
/// E* = 0. Near the separatrix, K > 2K′, Jacobi's imaginary transformation gives the same with
/// hyperbolic functions of Y = π u/4K′ and the nome e^{−πK/2K′}. Either nome is at most e^{−π}:
/// four terms do.
///   Jacobi, Sur la rotation d'un corps, 1850; Whittaker, Analytical Dynamics, §69 (direction
///   cosines by theta functions of nome e^{−πK′/K}; the quaternion follows by ϑ₃(0)ϑ₄(ζ) +
///   ϑ₄(0)ϑ₃(ζ) ∝ ϑ₄(ζ|2τ)²); van Zon and Schofield 2007; Celledoni, Fassò, Säfström and Zanna, The
///   exact computation of the free rigid body motion and its use in splitting methods, 2008.
/// World frame, SI.
class Rotor {
 public:
  /// Does not turn.
  Rotor() = default;

  /// Turns steadily from q0 with angular velocity omega [rad/s].
  Rotor(const Quat& q0, const Vec3& omega);

  /// @param Ibody  inertia tensor in the body frame [kg m²], symmetric and positive definite
  /// @param q0     attitude at t = 0
  /// @param L      angular momentum [kg m²/s], constant
  Rotor(const Mat3& Ibody, const Quat& q0, const Vec3& L);

  /// Attitude at t [s], body to world, of unit length and without a jump in its sign. Its error is
  /// that of the angles rate × t.
  Quat attitude(double t) const;

  /// A bound [1/s²] on the acceleration, for all time, of a body point at distance 1 from the
  /// centre of mass.
  double turning() const { return turning_; }

 private:
  /// The theta functions as polynomials in C = cos 2v or cosh 2Y, of degree 3, row by row:
  ///   w + i z ~ α₀ p₀(C) + i α₁ p₁(C),   x + i y ~ β₀ p₂(C) + i β₁ p₃(C).
  struct Series {
    Vec4 c[4] = {Vec4::UnitX(), Vec4::Zero(), Vec4::Zero(), Vec4::Zero()};
    void add(int row, const double (&polynomial)[4], double factor);
  };
  struct Waves {
    Vec4 functions;  ///< α₀, α₁, β₀, β₁
    double C, phase;
  };

  void startSteady(const Quat& q0, const Vec3& omega_B);
  void startCircle(const Polhode& path);
  void startElliptic(const Polhode& path);
  void startTrigonometric(const Polhode& path, double E, double E_);
  void startHyperbolic(const Polhode& path, double xi, double nome);
  Waves trigonometric(double t) const;
  Waves hyperbolic(double t) const;
  Vec4 unturned(double t) const;

  bool hyperbolic_ = false;
  double rate_ = 0.0, start_ = 0.0;  ///< v or Y = start_ + rate_ t
  double phaseRate_ = 0.0;           ///< ½ A
  double period_ = 0.0;              ///< Λ = πK/2K′, the half period in Y
  double phaseStep_ = 0.0;           ///< what the phase gains in a half period, beside phaseRate_ t
  Series series_;
  Eigen::Matrix4d frame_ = Eigen::Matrix4d::Identity();  ///< (w, z, x, y) to the coefficients of q
  double turning_ = 0.0;
};

}  // namespace tumble
