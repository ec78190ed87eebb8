#include "app/claim/ball_row.h"

#include <algorithm>
#include <cmath>

namespace tumble {

namespace {

constexpr double kTouching = 1e-9;   // [m]
constexpr double kApproach = 1e-10;  // [m/s] slower is rest
constexpr int kHits = 100'000;       // of one impact, and of one advance

}  // namespace

void BallRow::advance(double t) {
  for (int hits = 0; t > 0.0 && ended; ++hits) {
    ended = hits < kHits;
    if (approaches()) hit();
    // The gap that closes first.
    double dt = t;
    for (std::size_t k = 0; k < gap.size(); ++k)
      if (gap[k] > kTouching && u[k] - u[k + 1] > kApproach)
        dt = std::min(dt, gap[k] / (u[k] - u[k + 1]));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += u[i] * dt;
    for (std::size_t k = 0; k < gap.size(); ++k) {
      const double next = gap[k] + (u[k + 1] - u[k]) * dt;
      gap[k] = next > kTouching ? next : 0.0;
    }
    t -= dt;
  }
}

bool BallRow::approaches() const {
  for (std::size_t k = 0; k < gap.size(); ++k)
    if (gap[k] <= kTouching && u[k + 1] - u[k] < -kApproach) return true;
  return false;
}

void BallRow::hit() {
  if (law == "poisson") return poisson();
  std::vector<char> takesPart(gap.size());
  std::vector<double> rebound(gap.size()), j;
  int pass = 0;
  for (; pass < kHits && approaches(); ++pass) {
    if (law == "sequential") {
      hitTwo();
      continue;
    }
    for (std::size_t k = 0; k < gap.size(); ++k) {
      const double vrel = u[k + 1] - u[k];
      const bool rests = std::abs(vrel) <= kApproach;
      const bool joins = rests && (law == "simultaneous" || e[k] == 0.0);
      takesPart[k] = gap[k] <= kTouching && (joins || vrel < -kApproach);
      rebound[k] = vrel < -kApproach ? -e[k] * vrel : 0.0;
    }
    compress(takesPart, rebound, j);
  }
  ended = ended && pass < kHits;
}

// Newton's law for two balls alone.
void BallRow::hitTwo() {
  std::size_t fastest = 0;
  double worst = 0.0;
  for (std::size_t k = 0; k < gap.size(); ++k)
    if (gap[k] <= kTouching && u[k + 1] - u[k] < worst) {
      worst = u[k + 1] - u[k];
      fastest = k;
    }
  const double a = m[fastest], b = m[fastest + 1];
  const double j = -(1.0 + e[fastest]) * worst * a * b / (a + b);
  u[fastest] -= j / a;
  u[fastest + 1] += j / b;
}

// The velocities nearest to those before, by mass, with u[k + 1] − u[k] ≥ rebound[k] where contacts
// take part: Gauss's principle. Less the sum of rebounds, velocities then rise from ball to ball;
// neighbours that would not move as one, with their common momentum (pool adjacent violators).
void BallRow::compress(const std::vector<char>& takesPart, const std::vector<double>& rebound,
                       std::vector<double>& j) {
  struct Block {
    double mass, momentum;
    std::size_t end;
    double velocity() const { return momentum / mass; }
  };
  j.assign(gap.size(), 0.0);
  for (std::size_t begin = 0, end; begin < m.size(); begin = end) {
    end = begin + 1;
    while (end < m.size() && takesPart[end - 1]) ++end;
    std::vector<Block> blocks;
    double shift = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      if (i > begin) shift += rebound[i - 1];
      blocks.push_back({m[i], m[i] * (u[i] - shift), i + 1});
      while (blocks.size() > 1 && blocks.back().velocity() < blocks.end()[-2].velocity()) {
        const Block last = blocks.back();
        blocks.pop_back();
        blocks.back() = {blocks.back().mass + last.mass, blocks.back().momentum + last.momentum,
                         last.end};
      }
    }
    // What a contact takes from all that stand left of it.
    double given = 0.0;
    shift = 0.0;
    std::size_t i = begin;
    for (const Block& block : blocks)
      for (; i < block.end; ++i) {
        if (i > begin) shift += rebound[i - 1];
        const double after = block.velocity() + shift;
        given += m[i] * (u[i] - after);
        u[i] = after;
        if (i + 1 < end) j[i] = given;
      }
  }
}

void BallRow::poisson() {
  std::vector<char> touching(gap.size());
  for (std::size_t k = 0; k < gap.size(); ++k) touching[k] = gap[k] <= kTouching;
  const std::vector<double> none(gap.size(), 0.0);
  std::vector<double> j, rest;
  compress(touching, none, j);
  for (std::size_t k = 0; k < gap.size(); ++k) {
    u[k] -= e[k] * j[k] / m[k];
    u[k + 1] += e[k] * j[k] / m[k + 1];
  }
  int pass = 0;
  for (; pass < kHits && approaches(); ++pass) compress(touching, none, rest);
  ended = ended && pass < kHits;
}

}  // namespace tumble
