// Chapter 4, flight: the path of the angular momentum in a body that turns freely.
#pragma once

#include <array>

#include "sim/math/vec.h"

namespace tumble {

/// Free of torque, L is at rest in the world. In the body its direction l moves on the curve in
/// which the unit sphere meets the ellipsoid of the energy (Poinsot 1851):
///   l₁² + l₂² + l₃² = 1,   l₁²/I₁ + l₂²/I₂ + l₃²/I₃ = 2T/L²,   dl/dt = l × ω,   ω_k = L l_k/I_k.
/// The principal axes are ordered as by Jacobi: I₂ lies between the others, and l₃ never changes
/// sign. With
///   d₁ = |1/I₂ − 1/I₁|,  d₃ = |1/I₃ − 1/I₂|,  d = d₁ + d₃ = |1/I₃ − 1/I₁|   (here times I₁I₂I₃)
/// the curve is
///   l = (a₁ cn u, ± a₂ sn u, a₃ dn u),   u = u₀ + L s₃ t,   k = s₁/s₃,   k′ = s/s₃,
///   a₁² = l₁² + l₂² d₃/d,   a₂² = l₂² + l₁² d/d₃,   a₃² = l₃² + l₂² d₁/d,
///   s₁² = d₁ (d l₁² + d₃ l₂²),   s₃² = d₃ (d l₃² + d₁ l₂²),   s² = s₃² − s₁² = d (d₃ l₃² − d₁
///   l₁²).
/// All are sums of positive terms but s, which vanishes where the spin about axis 2 loses its hold;
/// it is taken with twice the digits. Landau and Lifshitz, Mechanics, §37; van Zon and Schofield,
/// Numerical implementation of the exact dynamics of free rigid bodies, 2007.
struct Polhode {
  enum class Kind {
    Rest,      ///< l stays: a sphere, a spin about a principal axis, or no spin
    Circle,    ///< I₁ = I₂: l turns steadily about axis 3
    Elliptic,  ///< three unlike moments
  };

  Kind kind = Kind::Rest;
  double L = 0.0;                  ///< [kg m²/s] |L|
  Mat3 axes_B = Mat3::Identity();  ///< columns: axes 1, 2, 3 in the body frame, right-handed
  Vec3 I = Vec3::Ones();           ///< [kg m²] I₁, I₂, I₃
  Vec3 l = Vec3::Zero();  ///< [1] direction of L at the start along the axes; l₁, l₃ ≥ 0
  double sense = 1.0;     ///< the sign of l₂ in l: +1 if I₁ < I₃, −1 if I₁ > I₃
  double d = 0.0, d1 = 0.0, d3 = 0.0;   ///< [kg² m⁴]
  double a1 = 0.0, a2 = 0.0, a3 = 0.0;  ///< [1]
  double s = 0.0, s1 = 0.0, s3 = 0.0;   ///< [1/(kg m²)]

  /// @param Ibody  inertia tensor in the body frame [kg m²]
  /// @param q      attitude, body to world; need not be of unit length
  /// @param L      angular momentum [kg m²/s], world frame
  Polhode(const Mat3& Ibody, const Quat& q, const Vec3& L);

  /// A bound [1/s²] on the acceleration of a point at distance 1 from the centre of mass, for all
  /// time. The point r has  a = ω̇ × r − ω² r⊥,  r⊥ across ω. With c, s the cosine and sine between
  /// r and ω,
  ///   |a|² ≤ ω⁴ s² + 2 ω² |ω̇| c s + |ω̇|² = (ω² s + |ω̇| c)² + (|ω̇| s)²,
  /// the square of a symmetric matrix [ω², |ω̇|; |ω̇|, 0] times (s, c), so that
  ///   |a| ≤ ½ ω² + √(¼ ω⁴ + |ω̇|²).
  /// Along the curve ω² is linear in sn² u and ω̇² quadratic: their greatest values are at hand.
  double turning() const;

 private:
  void layAxes(const std::array<int, 3>& axis, const Vec3& direction);
  void measure(double excess);
};

}  // namespace tumble
