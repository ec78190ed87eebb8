// What the broad phase is timed by, in the report and in the benchmarks: a swarm of boxes.
#pragma once

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "sim/collide/broad_phase.h"

namespace tumble {

/// Up to how many boxes each row of the table of broad phases is timed: beyond, it takes too long.
inline constexpr std::array kMostBoxes = {3000, 10000, 100000};

/// CPU time [s] of this thread.
inline double cpuTime() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Boxes with edges of 0.4 to 1.6, 0.24 of them in a unit cube, that bounce about in a cube; a step
/// takes them 1 % of their mean edge on average.
class Swarm {
 public:
  /// @param fast  boxes that move 300 times as fast
  explicit Swarm(int count, int fast = 0) : side_(std::cbrt(count / 0.24)) {
    std::mt19937_64 engine(1);
    const auto vector = [&](double lo, double hi) {
      Vec3 v;
      for (int k = 0; k < 3; ++k)
        v[k] = lo + (hi - lo) * std::ldexp(static_cast<double>(engine() >> 11), -53);
      return v;
    };
    // Of a vector with coordinates in ±1 the mean length is 0.96.
    for (int i = 0; i < count; ++i) {
      const Vec3 half = vector(0.2, 0.8), x = vector(0.0, side_);
      boxes_.push_back({x - half, x + half});
      steps_.push_back((i < fast ? 3.0 : 0.01) / 0.96 * vector(-1.0, 1.0));
    }
  }
  void step() {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const Vec3 x = 0.5 * (boxes_[i].lo + boxes_[i].hi);
      for (int k = 0; k < 3; ++k)
        if ((x[k] < 0.0 && steps_[i][k] < 0.0) || (x[k] > side_ && steps_[i][k] > 0.0))
          steps_[i][k] *= -1.0;
      boxes_[i].lo += steps_[i];
      boxes_[i].hi += steps_[i];
    }
  }
  const std::vector<Aabb>& boxes() const { return boxes_; }

 private:
  double side_;
  std::vector<Aabb> boxes_;
  std::vector<Vec3> steps_;
};

/// What looking at the clock costs [s].
inline double clockTime() {
  const double start = cpuTime();
  for (int k = 0; k < 1000; ++k) cpuTime();
  return (cpuTime() - start) / 1001.0;
}

/// Mean CPU time [s] of an update over many steps, without the steps themselves.
inline double timeOfUpdate(BroadPhase broadPhase, int count, int fast = 0) {
  Swarm swarm(count, fast);
  for (int k = 0; k < 30; ++k) {
    swarm.step();
    broadPhase.update(swarm.boxes());
  }
  const int steps = std::max(60, 200000 / count);
  const double clock = clockTime();
  double spent = 0.0;
  for (int k = 0; k < steps; ++k) {
    swarm.step();
    const double start = cpuTime();
    broadPhase.update(swarm.boxes());
    spent += cpuTime() - start - clock;
  }
  return spent / steps;
}

/// Slope of log y against log x, least squares.
inline double slopeOf(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double p = std::log(x[k]), q = std::log(y[k]);
    sx += p, sy += q, sxx += p * p, sxy += p * q;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace tumble
