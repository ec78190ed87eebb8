// Differential equations with known solutions.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "sim/ode/integrator.h"

namespace tumble::test {

/// A driven oscillator of unit mass and stiffness, Y = (x, p):  ẋ = p,  ṗ = −x + cos 2t,
/// which begins at (2/3, 1/2):  x = cos t + ½ sin t − ⅓ cos 2t.
class DrivenOscillator : public System {
 public:
  int size() const override { return 2; }
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override {
    ++evaluations;
    ydot[0] = y[1];
    ydot[1] = -y[0] + std::cos(2.0 * t);
  }
  Offers offers() const override { return {.split = Split::Exact}; }
  void kick(double t, double h, std::span<double> y) const override {
    y[1] += h * (-y[0] + std::cos(2.0 * t));
  }
  void drift(double, double h, std::span<double> y) const override { y[0] += h * y[1]; }

  static std::array<double, 2> exact(double t) {
    return {std::cos(t) + 0.5 * std::sin(t) - std::cos(2.0 * t) / 3.0,
            -std::sin(t) + 0.5 * std::cos(t) + 2.0 / 3.0 * std::sin(2.0 * t)};
  }
  mutable int evaluations = 0;
};

/// A planet of unit gravitational parameter, Y = (x, y, u, v), on an ellipse of unit half-axis and
/// eccentricity 0.6 from its nearest point: nonlinear, uneven in speed, closed after 2π.
class Kepler : public System {
 public:
  int size() const override { return 4; }
  void derivative(double, std::span<const double> y, std::span<double> ydot) const override {
    ++evaluations;
    kick4(y, ydot);
    ydot[0] = y[2];
    ydot[1] = y[3];
  }
  Offers offers() const override { return {.split = Split::Exact}; }
  void kick(double, double h, std::span<double> y) const override {
    std::array<double, 4> rate{};
    kick4(y, rate);
    y[2] += h * rate[2];
    y[3] += h * rate[3];
  }
  void drift(double, double h, std::span<double> y) const override {
    y[0] += h * y[2];
    y[1] += h * y[3];
  }
  static std::vector<double> start() { return {0.4, 0.0, 0.0, 2.0}; }
  static double energy(std::span<const double> y) {
    return 0.5 * (y[2] * y[2] + y[3] * y[3]) - 1.0 / std::hypot(y[0], y[1]);
  }
  mutable int evaluations = 0;

 private:
  static void kick4(std::span<const double> y, std::span<double> rate) {
    const double r2 = y[0] * y[0] + y[1] * y[1], r3 = r2 * std::sqrt(r2);
    rate[2] = -y[0] / r3;
    rate[3] = -y[1] / r3;
  }
};

/// A right-hand side given by a function of (t, y, ydot), which also counts its calls.
template <class F>
class Given : public System {
 public:
  Given(int size, F f) : size_(size), f_(f) {}
  int size() const override { return size_; }
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override {
    ++evaluations;
    f_(t, y, ydot);
  }
  mutable long evaluations = 0;

 private:
  int size_;
  F f_;
};

/// Carries y through `steps` equal steps from 0 to `duration`.
inline void run(const Integrator& row, const System& system, double duration, int steps,
                std::span<double> y) {
  const auto stepper = row.make(system.size());
  const double h = duration / steps;
  for (int n = 0; n < steps; ++n) stepper->step(system, n * h, h, y);
}

}  // namespace tumble::test
