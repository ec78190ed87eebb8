// Chapter 6, problem: Dantzig pivoting for boxed linear complementarity problems.
#include "sim/problem/lcp.h"

#include <cmath>
#include <limits>
#include <vector>

#include "sim/problem/growing_cholesky.h"

namespace tumble {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPivot = 1e-12;  ///< Schur pivots below this, of a diagonal of 1, count as zero
constexpr double kNoise = 32.0 * kEps;  ///< of a sum, relative to the sum of the sizes of its terms
constexpr double kFoot = 1e-7;          ///< compliance that makes f unique: see solveLcp
constexpr double kExcuse = 1e-6;  ///< of |b|: the most that rounding, which grows with f, excuses
constexpr double kGain = 1e-6;    ///< of |b| |d|: what counts as a gain along a direction d
constexpr int kRounds = 20;       ///< times that what rounding spoiled is driven again

/// Where an index stands, and so which condition it keeps while others are driven.
enum class Place {
  Outside,  ///< not taken in yet, or lo = hi: none
  Lower,    ///< f = lo, a ≥ 0
  Upper,    ///< f = hi, a ≤ 0
  Free,     ///< a = 0 because f moves: in the factor
  Held,     ///< a = 0 with f between its bounds, depends on the free ones
};

/// The next change of place on the way of the driven index.
struct Event {
  double step = kInfinity;
  int index = -1;
  Place to = Place::Free;

  void earlier(double candidate, int who, Place where) {
    if (candidate < step) *this = {std::max(candidate, 0.0), who, where};
  }
};

class Dantzig {
 public:
  Dantzig(const MatX& A, const VecX& b, const VecX& lo, const VecX& hi, double foot);

  LcpReport solve();
  VecX result() const { return scale_.cwiseProduct(f_); }

 private:
  void takeEqualities();
  void drive(int d);
  bool settled(int d);
  bool depends(int d);
  void findDirection(int d, double sign);
  Event nextEvent(int d, double sign) const;
  void advance(const Event& event, int d, double sign);
  void join(int i);
  void leave(int i, Place to);
  void stayOut(int i);
  void refine();
  bool clip();
  double noiseOf(int i) const;
  bool violated(int i) const;
  bool endless() const;
  LcpReport report() const;

  MatX A_;
  VecX scale_, b_, lo_, hi_, f_, a_;
  VecX df_, da_, column_;  // direction: df over free_, da over all; scratch
  double foot_;            // compliance of each index, relative to its own diagonal
  double largest_;         // |b|
  double rateNoise_ = 0.0;
  std::vector<Place> place_;
  std::vector<bool> skip_;      // does not enter during this drive: too dependent on the free ones
  std::vector<bool> hopeless_;  // was driven for ever
  std::vector<int> free_;       // in the order of the factor
  GrowingCholesky factor_;
  int n_, pivots_ = 0, cap_;
};

/// Power of two nearest to 1/√diagonal: scaling by it rounds nothing.
double scaleOf(double diagonal) {
  if (!(diagonal > 0.0)) return 1.0;
  int exponent = 0;
  std::frexp(diagonal, &exponent);
  return std::ldexp(1.0, -(exponent / 2));
}

Dantzig::Dantzig(const MatX& A, const VecX& b, const VecX& lo, const VecX& hi, double foot)
    : foot_(foot),
      largest_(b.size() > 0 ? b.lpNorm<Eigen::Infinity>() : 0.0),
      n_(static_cast<int>(b.size())),
      cap_(50 * n_ + 200) {
  scale_.resize(n_);
  for (int i = 0; i < n_; ++i) scale_[i] = scaleOf(A(i, i));
  A_ = scale_.asDiagonal() * A * scale_.asDiagonal();
  b_ = scale_.cwiseProduct(b);
  lo_ = lo.cwiseQuotient(scale_);
  hi_ = hi.cwiseQuotient(scale_);
  f_ = VecX::Zero(n_).cwiseMax(lo_).cwiseMin(hi_);
  a_ = b_ + A_ * f_;
  df_ = da_ = column_ = VecX::Zero(n_);
  place_.assign(n_, Place::Outside);
  skip_.assign(n_, false);
  hopeless_.assign(n_, false);
  factor_.reset(n_);
}

LcpReport Dantzig::solve() {
  takeEqualities();
  for (int d = 0; d < n_; ++d)
    if (place_[d] == Place::Outside) drive(d);
  for (int round = 0; round < kRounds; ++round) {
    do refine();
    while (!clip());
    bool clean = true;
    for (int d = 0; d < n_; ++d) {
      if (!violated(d) || hopeless_[d]) continue;
      clean = false;
      if (place_[d] != Place::Free) drive(d);
    }
    if (clean) break;
  }
  return report();
}

/// Puts all equalities into the factor at once: none of them ever leaves it. Those that depend on
/// the others stay outside, to be driven like the rest.
void Dantzig::takeEqualities() {
  for (int i = 0; i < n_; ++i) {
    if (lo_[i] > -kInfinity || hi_[i] < kInfinity) continue;
    for (int k = 0; k < factor_.size(); ++k) column_[k] = A_(free_[k], i);
    if (factor_.append(column_, (1.0 + foot_) * A_(i, i), kPivot) <= kPivot) continue;
    free_.push_back(i);
    place_[i] = Place::Free;
  }
  if (!free_.empty()) refine();
}

/// Moves f_d, and the free ones with it, until the condition of d holds.
void Dantzig::drive(int d) {
  if (place_[d] == Place::Free) leave(d, Place::Outside);
  place_[d] = Place::Outside;
  skip_.assign(n_, false);
  while (!settled(d) && pivots_ < cap_) {
    ++pivots_;
    const double sign = a_[d] < 0.0 ? 1.0 : -1.0;
    findDirection(d, sign);
    if (sign * da_[d] <= kPivot && depends(d)) continue;
    const Event event = nextEvent(d, sign);
    if (event.index < 0) {
      hopeless_[d] = true;
      return;
    }
    advance(event, d, sign);
  }
}

/// Takes d in if its condition holds already, up to rounding.
bool Dantzig::settled(int d) {
  if (place_[d] != Place::Outside || lo_[d] >= hi_[d]) return true;
  const double noise = kNoise * (std::abs(b_[d]) + A_.col(d).cwiseAbs().dot(f_.cwiseAbs()));
  if (f_[d] <= lo_[d] && a_[d] >= -noise) {
    place_[d] = Place::Lower;
  } else if (f_[d] >= hi_[d] && a_[d] <= noise) {
    place_[d] = Place::Upper;
  } else if (std::abs(a_[d]) <= noise) {
    join(d);
  }
  return place_[d] != Place::Outside;
}

/// Whether a_d, which the free ones determine, is 0 as far as rounding lets us see: then d stays
/// where it is. True also if the look at it freed others, so that the direction has changed.
bool Dantzig::depends(int d) {
  refine();
  double noise = noiseOf(d);
  for (int k = 0; k < factor_.size(); ++k) noise += std::abs(df_[k]) * noiseOf(free_[k]);
  if (std::abs(a_[d]) > noise) return false;
  a_[d] = 0.0;
  stayOut(d);
  return true;
}

/// df and da per unit of motion of f_d along `sign` that keeps a = 0 for the free ones.
void Dantzig::findDirection(int d, double sign) {
  const int m = factor_.size();
  for (int k = 0; k < m; ++k) df_[k] = -sign * A_(free_[k], d);
  factor_.solveInPlace(df_);
  da_ = sign * A_.col(d);
  da_[d] += sign * foot_ * A_(d, d);
  for (int k = 0; k < m; ++k) da_ += df_[k] * A_.col(free_[k]);
  rateNoise_ = kNoise * (1.0 + df_.head(m).lpNorm<1>());
}

/// First index that reaches a bound or a = 0; of several at once the lowest, d before all.
Event Dantzig::nextEvent(int d, double sign) const {
  Event event;
  const double slope = sign * da_[d];
  if (slope > kPivot) event.earlier(std::abs(a_[d]) / slope, d, Place::Free);
  if (sign > 0.0) event.earlier(hi_[d] - f_[d], d, Place::Upper);
  if (sign < 0.0) event.earlier(f_[d] - lo_[d], d, Place::Lower);

  for (int i = 0; i < n_; ++i) {
    if (i == d || skip_[i]) continue;
    const double rate = da_[i];
    if (place_[i] == Place::Lower && rate < -rateNoise_)
      event.earlier(a_[i] / -rate, i, Place::Free);
    if (place_[i] == Place::Upper && rate > rateNoise_)
      event.earlier(-a_[i] / rate, i, Place::Free);
    if (place_[i] == Place::Held && std::abs(rate) > rateNoise_) event.earlier(0.0, i, Place::Free);
  }
  for (int k = 0; k < factor_.size(); ++k) {
    const int i = free_[k];
    if (df_[k] < -rateNoise_) event.earlier((f_[i] - lo_[i]) / -df_[k], i, Place::Lower);
    if (df_[k] > rateNoise_) event.earlier((hi_[i] - f_[i]) / df_[k], i, Place::Upper);
  }
  return event.step < kInfinity ? event : Event{};
}

void Dantzig::advance(const Event& event, int d, double sign) {
  for (int k = 0; k < factor_.size(); ++k) {
    const int i = free_[k];
    f_[i] = std::min(std::max(f_[i] + event.step * df_[k], lo_[i]), hi_[i]);
  }
  f_[d] = std::min(std::max(f_[d] + event.step * sign, lo_[d]), hi_[d]);
  a_ += event.step * da_;
  for (int i : free_) a_[i] = 0.0;

  const int i = event.index;
  if (event.to == Place::Free) {
    a_[i] = 0.0;
    join(i);
  } else if (place_[i] == Place::Free) {
    leave(i, event.to);
  } else {
    place_[i] = event.to;
    f_[i] = event.to == Place::Upper ? hi_[i] : lo_[i];
  }
}

/// Takes i, whose a is 0, into the factor; if it depends on the free ones it stays out of it.
void Dantzig::join(int i) {
  const int m = factor_.size();
  for (int k = 0; k < m; ++k) column_[k] = A_(free_[k], i);
  if (factor_.append(column_, (1.0 + foot_) * A_(i, i), kPivot) > kPivot) {
    free_.push_back(i);
    place_[i] = Place::Free;
    return;
  }
  skip_[i] = true;
  stayOut(i);
}

/// The place of an index with a = 0 that is not in the factor.
void Dantzig::stayOut(int i) {
  place_[i] = f_[i] <= lo_[i] ? Place::Lower : f_[i] >= hi_[i] ? Place::Upper : Place::Held;
}

void Dantzig::leave(int i, Place to) {
  const auto at = std::find(free_.begin(), free_.end(), i);
  factor_.remove(static_cast<int>(at - free_.begin()));
  free_.erase(at);
  place_[i] = to;
  if (to == Place::Upper) f_[i] = hi_[i];
  if (to == Place::Lower) f_[i] = lo_[i];
}

/// Solves a = 0 for the free ones anew from A and b.
void Dantzig::refine() {
  for (int pass = 0; pass < 3; ++pass) {
    a_ = b_ + A_ * f_;
    for (int k = 0; k < factor_.size(); ++k) column_[k] = -a_[free_[k]];
    factor_.solveInPlace(column_);
    for (int k = 0; k < factor_.size(); ++k) f_[free_[k]] += column_[k];
  }
  a_ = b_ + A_ * f_;
}

/// Brings free ones that stand outside their bounds back to them; where that is more than rounding
/// they stay there. Returns whether none had to.
bool Dantzig::clip() {
  bool within = true;
  const std::vector<int> moved = free_;
  for (int i : moved) {
    const double beyond = std::max(lo_[i] - f_[i], f_[i] - hi_[i]);
    if (beyond <= 0.0) continue;
    const Place bound = f_[i] < lo_[i] ? Place::Lower : Place::Upper;
    f_[i] = bound == Place::Lower ? lo_[i] : hi_[i];
    if (beyond * A_(i, i) <= noiseOf(i)) continue;
    leave(i, bound);
    within = false;
  }
  a_ = b_ + A_ * f_;
  return within;
}

/// What rounding may leave in a_i.
double Dantzig::noiseOf(int i) const {
  return kNoise * (std::abs(b_[i]) + A_.col(i).cwiseAbs().dot(f_.cwiseAbs()));
}

bool Dantzig::violated(int i) const {
  if (lo_[i] >= hi_[i]) return false;
  const double noise = std::min(2.0 * noiseOf(i), kExcuse * largest_ * scale_[i]);
  return (a_[i] < -noise && f_[i] < hi_[i]) || (a_[i] > noise && f_[i] > lo_[i]);
}

/// Whether f has grown along a direction that certifies that there is no solution: it may go on for
/// ever, moves nothing, and gains all the way,  A d = 0,  bᵀd < 0  (Farkas' lemma).
bool Dantzig::endless() const {
  VecX d = f_;
  for (int i = 0; i < n_; ++i)
    if ((f_[i] > 0.0 && hi_[i] < kInfinity) || (f_[i] < 0.0 && lo_[i] > -kInfinity)) d[i] = 0.0;
  const double size = d.lpNorm<Eigen::Infinity>(), gain = -b_.dot(d);
  return (A_ * d).lpNorm<Eigen::Infinity>() <= kPivot * size &&
         gain > kGain * b_.lpNorm<Eigen::Infinity>() * size;
}

LcpReport Dantzig::report() const {
  LcpReport report{.pivots = pivots_};
  const VecX a = a_.cwiseQuotient(scale_);
  for (int i = 0; i < n_; ++i) {
    const double wanted = a[i] > 0.0 ? std::min(a[i], (f_[i] - lo_[i]) * (A_(i, i) / scale_[i]))
                                     : std::min(-a[i], (hi_[i] - f_[i]) * (A_(i, i) / scale_[i]));
    if (wanted > report.residual) report.residual = wanted;
    // Where rounding could hide so much, an answer that looks right says nothing.
    const bool blind = noiseOf(i) > kExcuse * largest_ * scale_[i];
    if (violated(i) || blind) report.status = SolveStatus::NotConverged;
  }
  if (largest_ > 0.0) report.residual /= largest_;
  for (int i = 0; i < n_; ++i)
    if (hopeless_[i] && violated(i)) report.status = SolveStatus::Infeasible;
  if (report.status == SolveStatus::NotConverged && endless())
    report.status = SolveStatus::Infeasible;
  return report;
}

}  // namespace

LcpReport solveLcp(const MatX& A, const VecX& b, const VecX& lo, const VecX& hi, VecX& f) {
  LcpReport report;
  for (double foot : {kFoot, 0.0}) {
    const int pivots = report.pivots;
    Dantzig dantzig(A, b, lo, hi, foot);
    report = dantzig.solve();
    report.pivots += pivots;
    f = dantzig.result();
    if (report.status == SolveStatus::Solved) break;
  }
  return report;
}

}  // namespace tumble
