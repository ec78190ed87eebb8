#include "app/claim/free_rotor.h"

#include <cmath>

namespace tumble {

Vec3 FreeRotor::omega(const Quat& at) const {
  const Quat unit = at.normalized();
  const Vec3 L_B = unit.conjugate() * L;
  const Vec3 omega_B = inertiaInverse * L_B;
  return unit * omega_B;
}

Quat FreeRotor::after(double h) const {
  const auto rate = [this](const Vec4& coefficients) -> Vec4 {
    const Quat at(coefficients);
    const Vec3 w = 0.5 * omega(at);
    return (Quat(0.0, w.x(), w.y(), w.z()) * at).coeffs();
  };
  const Vec4 y = q.coeffs();
  const Vec4 k1 = rate(y);
  const Vec4 k2 = rate(y + 0.5 * h * k1);
  const Vec4 k3 = rate(y + 0.5 * h * k2);
  const Vec4 k4 = rate(y + h * k3);
  return Quat(Vec4(y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4))).normalized();
}

void FreeRotor::advance(double time, double fastest) {
  const int steps = 1 + static_cast<int>(fastest * time / kTurn);
  for (int i = 0; i < steps; ++i) q = after(time / steps);
}

double angleBetween(const Quat& p, const Quat& q) {
  const Quat turn = p.conjugate() * q;
  return 2.0 * std::atan2(turn.vec().norm(), std::abs(turn.w()));
}

}  // namespace tumble
