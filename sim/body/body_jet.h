// Chapter 3, body: Taylor series of the motion of bodies, order by order.
#pragma once

#include <span>
#include <vector>

#include "sim/body/force.h"
#include "sim/body/pivot.h"

namespace tumble {

/// Normalised Taylor coefficients of one body's motion: x[k] = x⁽ᵏ⁾/k!, and so on. World frame, SI,
/// but for names in _B.
struct BodySeries {
  std::vector<Vec3> x, P, L;
  std::vector<Vec4> q;         ///< w first
  std::vector<Mat3> R;         ///< only if the body is gripped
  std::vector<Vec3> spin_B;    ///< angular momentum about the centre of mass, or about the pivot
  std::vector<Vec3> own_B;     ///< angular momentum about the centre of mass, if it has a pivot
  std::vector<Vec3> omega_B;   ///< [rad/s]
  std::vector<Vec3> force;     ///< [N] but for a reaction
  std::vector<Vec3> torque_B;  ///< [N m] about the same point as spin_B
  bool gripped = false;        ///< something may twist it: a pivot, drag, a force off its centre
};

/// The recurrences of free bodies under forces that have them,
///   ẋ = P/M,  q̇ = ½ q (0, ω_B),  Ṗ = F,  Ḣ_B = H_B × ω_B + τ_B,  ω_B = I⁻¹ H_B,
/// each coefficient from those of lower order by Cauchy products (Hairer, Nørsett and Wanner,
/// Solving Ordinary Differential Equations I, §I.8). About a pivot the same are the equations of
/// Euler and Poisson of the heavy top.
class BodyJet {
 public:
  /// True if every force has its recurrence: wind, drag, point forces, springs and fields do; on a
  /// body with a pivot only wind and point forces.
  static bool covers(std::span<const Force> forces, std::span<const RigidBody> bodies,
                     std::span<const int> pivotOf);

  /// Expands the motion of the bodies about their present state up to `order`.
  /// @param pivotOf  per body: its index in `pivots`, or −1
  void expand(const Vec3& gravity, std::span<const Force> forces, std::span<const Pivot> pivots,
              std::span<const int> pivotOf, std::span<const RigidBody> bodies, int order);

  const BodySeries& body(std::size_t i) const { return series_[i]; }
  /// Coefficient k of the power [W] of all forces that have no potential, as `powerOfForces`.
  double power(int k) const { return power_[k]; }

 private:
  struct SpringSeries {
    std::vector<Vec3> span, force;                     ///< [m] from b to a; [N] on a
    std::vector<double> length2, inverse, pull, rate;  ///< l², 1/l, f/l and l̇
  };

  void begin(int order);
  void move(int k);
  void addForces(int k);
  void addSpring(const Spring& spring, SpringSeries& s, int k);
  void markGripped();
  void grip(int body, const Vec3& point_B, const std::vector<Vec3>& force, double sign, int k);
  void grip(int body, const Vec3& point_B, const Vec3& force, int k);
  void addMomenta(int k);
  Vec3 pointAt(int body, const Vec3& point_B, int k) const;
  bool held(int body) const { return pivotOf_[body] >= 0; }

  Vec3 gravity_;
  std::span<const Force> forces_;
  std::span<const Pivot> pivots_;
  std::span<const int> pivotOf_;
  std::span<const RigidBody> bodies_;
  std::vector<BodySeries> series_;
  std::vector<SpringSeries> springs_;  ///< in the order of the list of forces
  std::vector<double> power_;
};

}  // namespace tumble
