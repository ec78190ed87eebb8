// Dormand and Prince, A Family of Embedded Runge-Kutta Formulae, 1980: order 5 with an estimate of
// order 4, the last stage being the first of the next step. Dense output and first step as in
// Hairer, Nørsett and Wanner, Solving Ordinary Differential Equations I, §II.4 and §II.6.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/ode/step_control.h"
#include "sim/ode/steppers.h"

namespace tumble {
namespace {

using Numbers = std::vector<double>;

constexpr int kStages = 7;
constexpr double kNodes[kStages] = {0.0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1.0, 1.0};
constexpr double kStageWeights[kStages][kStages - 1] = {
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
/// Fifth-order weights minus fourth-order ones.
constexpr double kErrorWeights[kStages] = {
    71.0 / 57600, 0.0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
/// The part of the dense output that cubic interpolation lacks.
constexpr double kDenseWeights[kStages] = {
    -12715105075.0 / 11282082432,  0.0,
    87487479700.0 / 32700410799,   -10690763975.0 / 1880347072,
    701980252875.0 / 199316789632, -1453857185.0 / 822651844,
    69997945.0 / 29380423};

/// Attempts under error control in one step; then the rest is crossed in as many equal substeps.
constexpr int kMaxAttempts = 100000;
/// Substeps of one step that dense output remembers; it has no answer beyond the last of them.
constexpr int kMaxPieces = 256;

/// One accepted substep, ready for interpolation:
///   Y(t + θh) = c₀ + θ (c₁ + (1−θ)(c₂ + θ (c₃ + (1−θ) c₄))).
struct Piece {
  double t = 0.0, h = 0.0;
  Numbers c[5];
};

class Dopri5 : public Stepper {
 public:
  Dopri5(int size, double tolerance)
      : size_(size), tolerance_(tolerance), now_(size), next_(size), stage_(size) {
    for (Numbers& k : k_) k.resize(size);
  }

  void step(const System& system, double t, double h, std::span<double> y) override;
  bool dense(double t, std::span<double> y) const override;
  bool withinTolerance() const override { return withinTolerance_; }

 private:
  double firstSubstep(const System& system, double t, double h);
  double attempt(const System& system, double t, double h);
  void accept(double t, double h);
  void remember(double t, double h);
  /// Error allowed per substep in number i of Y.
  double allowed(int i) const {
    return tolerance_ + tolerance_ * std::max(std::abs(now_[i]), std::abs(next_[i]));
  }

  int size_;
  double tolerance_;
  Numbers now_, next_, stage_, k_[kStages];
  std::vector<Piece> pieces_;
  int pieceCount_ = 0;
  bool withinTolerance_ = true;
};

/// Crosses [t, t + h] in substeps, each as long as its error estimate allows.
void Dopri5::step(const System& system, double t, double h, std::span<double> y) {
  const double end = t + h, sign = h < 0.0 ? -1.0 : 1.0;
  const double least =
      16.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), std::abs(end));
  pieceCount_ = 0;
  withinTolerance_ = true;
  std::copy(y.begin(), y.end(), now_.begin());
  system.derivative(t, now_, k_[0]);

  StepControl control;
  double size = std::max(least, firstSubstep(system, t, h));
  for (int attempts = 0; t != end; ++attempts) {
    const double rest = std::abs(end - t);
    // What cannot be done with care in so many attempts is done without.
    if (attempts == kMaxAttempts) size = rest / kMaxAttempts;
    const bool forced = attempts >= kMaxAttempts || size <= least;
    const bool last = 1.01 * size >= rest;
    const double error = attempt(system, t, last ? end - t : sign * size);

    if (!(error <= 1.0) && !forced) {
      size = std::max(least, (last ? rest : size) * control.afterRejected(error));
      continue;
    }
    accept(t, last ? end - t : sign * size);
    t = last ? end : t + sign * size;
    if (!(error <= 1.0)) withinTolerance_ = false;
    if (!std::isfinite(error)) break;  // the solution has left the numbers and stays away
    if (attempts < kMaxAttempts) size *= control.afterAccepted(error);
  }
  std::copy(now_.begin(), now_.end(), y.begin());
  system.normalise(y);
}

/// A first substep that a look at Y, Y′ and Y″ makes likely to be accepted [s], never above |h|.
double Dopri5::firstSubstep(const System& system, double t, double h) {
  next_ = now_;
  const Numbers& f = k_[0];
  double sizeY = 0.0, sizeF = 0.0, sizeF2 = 0.0;
  for (int i = 0; i < size_; ++i) {
    sizeY = std::max(sizeY, std::abs(now_[i]) / allowed(i));
    sizeF = std::max(sizeF, std::abs(f[i]) / allowed(i));
  }
  const bool tiny = !(sizeY > 1e-5 && sizeF > 1e-5);
  const double probe = std::min(tiny ? 1e-6 : 0.01 * sizeY / sizeF, std::abs(h));
  const double signedProbe = h < 0.0 ? -probe : probe;
  follow(now_, signedProbe, f, stage_);
  system.derivative(t + signedProbe, stage_, k_[1]);
  for (int i = 0; i < size_; ++i) {
    sizeF2 = std::max(sizeF2, std::abs(k_[1][i] - f[i]) / (allowed(i) * probe));
  }
  const double steepest = std::max(sizeF, sizeF2);
  const double guess =
      steepest > 1e-15 && std::isfinite(steepest) ? fifthRoot(0.01 / steepest) : std::abs(h);
  return std::min({100.0 * probe, guess, std::abs(h)});
}

/// Computes all stages and Y(t + h) into next_.
/// @return the largest error estimate relative to what is allowed; NaN or infinite if Y is.
double Dopri5::attempt(const System& system, double t, double h) {
  for (int s = 1; s < kStages; ++s) {
    Numbers& y = s == kStages - 1 ? next_ : stage_;
    for (int i = 0; i < size_; ++i) {
      double slope = 0.0;
      for (int j = 0; j < s; ++j) slope += kStageWeights[s][j] * k_[j][i];
      y[i] = now_[i] + h * slope;
    }
    system.derivative(t + kNodes[s] * h, y, k_[s]);
  }

  double worst = 0.0;
  for (int i = 0; i < size_; ++i) {
    double e = 0.0;
    for (int s = 0; s < kStages; ++s) e += kErrorWeights[s] * k_[s][i];
    const double relative = std::abs(h * e) / allowed(i);
    if (!std::isfinite(relative) || !std::isfinite(next_[i])) {
      return std::numeric_limits<double>::infinity();
    }
    worst = std::max(worst, relative);
  }
  return worst;
}

/// Makes next_ the present; its derivative, the last stage, is the first of the next substep.
void Dopri5::accept(double t, double h) {
  if (pieceCount_ < kMaxPieces) remember(t, h);
  ++pieceCount_;
  std::swap(now_, next_);
  std::swap(k_[0], k_[kStages - 1]);
}

void Dopri5::remember(double t, double h) {
  if (pieceCount_ == static_cast<int>(pieces_.size())) {
    pieces_.emplace_back();
    for (Numbers& c : pieces_.back().c) c.resize(size_);
  }
  Piece& piece = pieces_[pieceCount_];
  piece.t = t;
  piece.h = h;
  for (int i = 0; i < size_; ++i) {
    const double rise = next_[i] - now_[i];
    const double bend = h * k_[0][i] - rise;
    double rest = 0.0;
    for (int s = 0; s < kStages; ++s) rest += kDenseWeights[s] * k_[s][i];
    piece.c[0][i] = now_[i];
    piece.c[1][i] = rise;
    piece.c[2][i] = bend;
    piece.c[3][i] = rise - h * k_[kStages - 1][i] - bend;
    piece.c[4][i] = h * rest;
  }
}

bool Dopri5::dense(double t, std::span<double> y) const {
  for (int n = 0; n < std::min(pieceCount_, kMaxPieces); ++n) {
    const Piece& piece = pieces_[n];
    const double theta = (t - piece.t) / piece.h;
    if (!(theta >= 0.0 && theta <= 1.0)) continue;
    const double left = 1.0 - theta;
    for (int i = 0; i < size_; ++i) {
      const double inner = piece.c[2][i] + theta * (piece.c[3][i] + left * piece.c[4][i]);
      y[i] = piece.c[0][i] + theta * (piece.c[1][i] + left * inner);
    }
    return true;
  }
  return false;
}

}  // namespace

std::unique_ptr<Stepper> makeDopri5(int size, const Choices& choices) {
  return std::make_unique<Dopri5>(size, choices.tolerance);
}

}  // namespace tumble
