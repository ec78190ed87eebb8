// Where events crowd: how closely the exact method still looks at them.
#pragma once

namespace tumble {

/// Hits of unlike bodies, and contacts that stick and slip in turns, may come faster than any run
/// could follow: without end in finite time, or as fast as rounding lets them. After kMany events
/// within kSpan, kMore times as many at each further level, bounces that count as nothing grow by
/// kCoarser, and contacts that last are crossed in steps, with kSlacker times the overlap at each
/// further level; one level is taken back after every kCalm without another. So a unit of time
/// holds a bounded number of events.
struct Pace {
  static constexpr double kSpan = 1.0 / 64.0, kCalm = 1.0 / 8.0;  ///< [s]
  static constexpr long kMany = 1000, kMore = 4, kCoarsest = 4;
  static constexpr double kCoarser = 30.0, kSlacker = 10.0;
  /// [s] a step at the first level, and its growth.
  static constexpr double kStretch = 3e-4, kLonger = 2.0;

  double t0 = 0.0;    ///< [s]
  double calm = 0.0;  ///< [s] since when the level has not risen
  long events = 0;    ///< since t0
  int level = 0;

  /// Counts an event at t [s] that is worth `weight` of the cheapest.
  void see(double t, long weight) {
    for (; level > 0 && t - calm >= kCalm; calm += kCalm) --level;
    if (t - t0 >= kSpan) t0 = t, events = 0;
    events += weight;
    if (events <= most()) return;
    ++level;
    t0 = calm = t;
    events = 0;
  }
  /// Events that kSpan may hold.
  long most() const {
    long count = kMany;
    for (int k = 0; k < level; ++k) count *= kMore;
    return count;
  }
  /// Whether there are too many events even for the coarsest level.
  bool lost() const { return level > kCoarsest; }
  /// By how much lengths that count as nothing have grown.
  double coarseness() const {
    double factor = 1.0;
    for (int k = 0; k < level; ++k) factor *= kCoarser;
    return factor;
  }
  /// By how much the overlap has grown that a step across events may leave to be mended.
  double slackness() const {
    double factor = 1.0;
    for (int k = 1; k < level; ++k) factor *= kSlacker;
    return factor;
  }
  /// [s] to cross at once.
  double stretch() const {
    double length = kStretch;
    for (int k = 1; k < level; ++k) length *= kLonger;
    return length;
  }
};

}  // namespace tumble
