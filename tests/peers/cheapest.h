// Who is cheapest at each error that an engine reaches, and by what ratio.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tests/peers/run.h"

namespace tumble::peers {

/// A ratio of medians with its 95 % interval, by bootstrap over repeats (Efron, 1979).
struct Ratio {
  double middle = 0.0, low = 0.0, high = 0.0;
};

/// What a costs over what b costs.
Ratio costRatio(std::span<const double> a, std::span<const double> b);

double median(std::vector<double> values);

/// Errors below are rounding, and count as this [m, rad].
inline constexpr double kRounding = 1e-12;

/// Points of one scene with the error that counts: of each engine and setting the larger of a
/// step's and the next finer one's, since an error may be small by luck where it changes sign.
std::vector<Point> settled(std::vector<Point> points);

/// The points of which none that costs as little is as exact, by rising cost.
std::vector<Point> front(std::span<const Point> points);

/// One error that a peer reaches, the cheapest peer there, and ours.
struct Duel {
  Point peer;
  std::optional<Point> byDefault,
      atBest;                     ///< ours: as it comes, and of all settings; or out of reach
  Ratio defaultRatio, bestRatio;  ///< the peer's cost over ours: > 1 is ours to win
};

enum class Verdict { Lost, Even, Won };

/// Lost, if ours is out of reach or all of the interval is below 1; even, if 1 is in it.
Verdict verdict(const std::optional<Point>& ours, const Ratio& ratio);

/// A duel for each point of the peers' front, measured ones alone, by falling error.
/// @param points  of one scene, settled; ours are those of the engine "tumble"
std::vector<Duel> duels(std::span<const Point> points);

/// A scene's outcome: those with more lost by default stand before those with fewer.
struct Outcome {
  std::string scene;
  std::vector<Duel> duels;
  int lostByDefault = 0, lostAtBest = 0;
};
std::vector<Outcome> outcomes(std::span<const Point> points);

}  // namespace tumble::peers
