// Differential equations with known solutions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/ode/integrator.h"

namespace tumble::test {

/// A system whose group is that of translations: increments are added to Y.
class Flat : public System {
 public:
  int algebraSize() const override { return size(); }
  void algebra(double t, std::span<const double> y, std::span<double> a) const override {
    derivative(t, y, a);
  }
  void commutator(std::span<const double>, std::span<const double>,
                  std::span<double> out) const override {
    std::fill(out.begin(), out.end(), 0.0);
  }
  void act(std::span<const double> a, std::span<double> y) const override {
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += a[i];
  }
};

/// A driven oscillator of unit mass and stiffness, Y = (x, p):  ẋ = p,  ṗ = −x + cos 2t,
/// which begins at (2/3, 1/2):  x = cos t + ½ sin t − ⅓ cos 2t. Offers everything.
class DrivenOscillator : public Flat {
 public:
  int size() const override { return 2; }
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override {
    ++evaluations;
    ydot[0] = y[1];
    ydot[1] = -y[0] + std::cos(2.0 * t);
  }
  Offers offers() const override { return {.split = Split::Exact, .jet = true, .lie = true}; }
  void kick(double t, double h, std::span<double> y) const override {
    y[1] += h * (-y[0] + std::cos(2.0 * t));
  }
  void drift(double, double h, std::span<double> y) const override { y[0] += h * y[1]; }
  void jet(double t, std::span<const double> y, int order, std::span<double> c) const override {
    c[0] = y[0], c[1] = y[1];
    double cosine = std::cos(2.0 * t), sine = std::sin(2.0 * t);
    for (int k = 0; k < order; ++k) {
      c[2 * k + 2] = c[2 * k + 1] / (k + 1);
      c[2 * k + 3] = (-c[2 * k] + cosine) / (k + 1);
      const double next = -2.0 * sine / (k + 1);
      sine = 2.0 * cosine / (k + 1);
      cosine = next;
    }
  }

  static std::array<double, 2> exact(double t) {
    return {std::cos(t) + 0.5 * std::sin(t) - std::cos(2.0 * t) / 3.0,
            -std::sin(t) + 0.5 * std::cos(t) + 2.0 / 3.0 * std::sin(2.0 * t)};
  }
  mutable int evaluations = 0;
};

/// A pendulum, Y = (x, p):  ẋ = p,  ṗ = −sin x. Offers everything.
class Pendulum : public Flat {
 public:
  int size() const override { return 2; }
  void derivative(double, std::span<const double> y, std::span<double> ydot) const override {
    ydot[0] = y[1];
    ydot[1] = -std::sin(y[0]);
  }
  Offers offers() const override { return {.split = Split::Exact, .jet = true, .lie = true}; }
  void kick(double, double h, std::span<double> y) const override { y[1] -= h * std::sin(y[0]); }
  void drift(double, double h, std::span<double> y) const override { y[0] += h * y[1]; }
  void jet(double, std::span<const double> y, int order, std::span<double> c) const override {
    std::vector<double> s(order + 1), u(order + 1);  // sin x and cos x
    c[0] = y[0], c[1] = y[1];
    s[0] = std::sin(y[0]), u[0] = std::cos(y[0]);
    for (int k = 0; k < order; ++k) {
      c[2 * k + 2] = c[2 * k + 1] / (k + 1);
      c[2 * k + 3] = -s[k] / (k + 1);
      for (int j = 0; j <= k; ++j) {
        s[k + 1] += u[k - j] * c[2 * j + 1] / (k + 1);
        u[k + 1] -= s[k - j] * c[2 * j + 1] / (k + 1);
      }
    }
  }
};

/// Euler's equations of a free top,  ẏ₁ = a y₂ y₃,  ẏ₂ = b y₃ y₁,  ẏ₃ = c y₁ y₂ + f (1 − cos 2t),
/// by derivative, jet and translations.
class EulerEquations : public Flat {
 public:
  EulerEquations(double a, double b, double c, double f = 0.0) : a_(a), b_(b), c_(c), f_(f) {}
  int size() const override { return 3; }
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override {
    ydot[0] = a_ * y[1] * y[2];
    ydot[1] = b_ * y[2] * y[0];
    ydot[2] = c_ * y[0] * y[1] + f_ * (1.0 - std::cos(2.0 * t));
  }
  Offers offers() const override { return {.jet = true, .lie = true}; }
  void jet(double t, std::span<const double> y, int order, std::span<double> c) const override {
    std::copy(y.begin(), y.end(), c.begin());
    double cosine = std::cos(2.0 * t), sine = std::sin(2.0 * t);
    for (int k = 0; k < order; ++k) {
      double sum[3] = {0.0, 0.0, f_ * ((k == 0 ? 1.0 : 0.0) - cosine)};
      for (int j = 0; j <= k; ++j) {
        const double *u = &c[3 * j], *v = &c[3 * (k - j)];
        sum[0] += a_ * u[1] * v[2];
        sum[1] += b_ * u[2] * v[0];
        sum[2] += c_ * u[0] * v[1];
      }
      for (int n = 0; n < 3; ++n) c[3 * k + 3 + n] = sum[n] / (k + 1);
      const double next = -2.0 * sine / (k + 1);
      sine = 2.0 * cosine / (k + 1);
      cosine = next;
    }
  }

 private:
  double a_, b_, c_, f_;
};

/// A planet of unit gravitational parameter, Y = (x, y, u, v), on an ellipse of unit half-axis and
/// eccentricity 0.6 from its nearest point: nonlinear, uneven in speed, closed after 2π.
class Kepler : public Flat {
 public:
  int size() const override { return 4; }
  void derivative(double, std::span<const double> y, std::span<double> ydot) const override {
    ++evaluations;
    kick4(y, ydot);
    ydot[0] = y[2];
    ydot[1] = y[3];
  }
  Offers offers() const override { return {.split = Split::Exact, .lie = true}; }
  void kick(double, double h, std::span<double> y) const override {
    ++evaluations;
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
  /// By Kepler's equation  t = E − 0.6 sin E.
  static std::vector<double> exact(double t) {
    double E = t;
    for (int i = 0; i < 50; ++i) E -= (E - 0.6 * std::sin(E) - t) / (1.0 - 0.6 * std::cos(E));
    const double rate = 1.0 / (1.0 - 0.6 * std::cos(E));
    return {std::cos(E) - 0.6, 0.8 * std::sin(E), -rate * std::sin(E), 0.8 * rate * std::cos(E)};
  }
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
/// @param order  for a row of any order, 0 = its own
inline void run(const Integrator& row, const System& system, double duration, int steps,
                std::span<double> y, int order = 0) {
  const auto stepper = row.make(system.size(), {.order = order});
  const double h = duration / steps;
  for (int n = 0; n < steps; ++n) stepper->step(system, n * h, h, y);
}

}  // namespace tumble::test
