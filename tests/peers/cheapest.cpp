#include "tests/peers/cheapest.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace tumble::peers {

namespace {

bool ours(const Point& point) {
  return point.engine == "tumble";
}

double costOf(const Point& point) {
  return median(point.costs);
}

// The cheapest of those that are as exact.
template <class Of>
std::optional<Point> cheapest(std::span<const Point> points, double error, Of of) {
  std::optional<Point> best;
  for (const Point& point : points)
    if (of(point) && point.error <= error && (!best || costOf(point) < costOf(*best))) best = point;
  return best;
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

Ratio costRatio(std::span<const double> a, std::span<const double> b) {
  constexpr int kDraws = 2000;
  std::mt19937_64 lots(1);
  const auto drawn = [&](std::span<const double> from) {
    std::vector<double> values;
    for (std::size_t i = 0; i < from.size(); ++i) values.push_back(from[lots() % from.size()]);
    return median(values);
  };
  std::vector<double> ratios;
  for (int k = 0; k < kDraws; ++k) {
    const double over = drawn(a);
    ratios.push_back(over / drawn(b));
  }
  std::sort(ratios.begin(), ratios.end());
  return {median({a.begin(), a.end()}) / median({b.begin(), b.end()}), ratios[kDraws / 40],
          ratios[kDraws - 1 - kDraws / 40]};
}

std::vector<Point> settled(std::vector<Point> points) {
  const std::vector<Point> raw = points;
  for (Point& point : points) {
    const Point* finer = nullptr;
    for (const Point& other : raw)
      if (other.scene == point.scene && other.engine == point.engine &&
          other.setting == point.setting && other.recorded == point.recorded &&
          other.rate > point.rate && (!finer || other.rate < finer->rate))
        finer = &other;
    if (finer && !point.recorded) point.error = std::max(point.error, finer->error);
    point.error = std::max(point.error, kRounding);
  }
  return points;
}

std::vector<Point> front(std::span<const Point> points) {
  std::vector<Point> sorted(points.begin(), points.end()), kept;
  std::sort(sorted.begin(), sorted.end(), [](const Point& a, const Point& b) {
    return std::pair(costOf(a), a.error) < std::pair(costOf(b), b.error);
  });
  for (const Point& point : sorted)
    if (kept.empty() || point.error < kept.back().error) kept.push_back(point);
  return kept;
}

Verdict verdict(const std::optional<Point>& ours, const Ratio& ratio) {
  if (!ours || ratio.high < 1.0) return Verdict::Lost;
  return ratio.low > 1.0 ? Verdict::Won : Verdict::Even;
}

std::vector<Duel> duels(std::span<const Point> points) {
  std::vector<Point> peers;
  for (const Point& point : points)
    if (!ours(point) && !point.recorded) peers.push_back(point);
  std::vector<Duel> all;
  for (const Point& peer : front(peers)) {
    Duel duel{peer, {}, {}, {}, {}};
    duel.byDefault =
        cheapest(points, peer.error, [](const Point& p) { return ours(p) && p.asItComes; });
    duel.atBest = cheapest(points, peer.error, ours);
    if (duel.byDefault) duel.defaultRatio = costRatio(peer.costs, duel.byDefault->costs);
    if (duel.atBest) duel.bestRatio = costRatio(peer.costs, duel.atBest->costs);
    all.push_back(duel);
  }
  return all;
}

std::vector<Outcome> outcomes(std::span<const Point> points) {
  std::vector<std::string> scenes;
  for (const Point& point : points)
    if (std::find(scenes.begin(), scenes.end(), point.scene) == scenes.end())
      scenes.push_back(point.scene);
  std::vector<Outcome> all;
  for (const std::string& scene : scenes) {
    std::vector<Point> own;
    for (const Point& point : points)
      if (point.scene == scene) own.push_back(point);
    Outcome outcome{scene, duels(settled(own))};
    for (const Duel& duel : outcome.duels) {
      outcome.lostByDefault += verdict(duel.byDefault, duel.defaultRatio) == Verdict::Lost;
      outcome.lostAtBest += verdict(duel.atBest, duel.bestRatio) == Verdict::Lost;
    }
    all.push_back(std::move(outcome));
  }
  std::stable_sort(all.begin(), all.end(), [](const Outcome& a, const Outcome& b) {
    return std::pair(a.lostAtBest, a.lostByDefault) > std::pair(b.lostAtBest, b.lostByDefault);
  });
  return all;
}

}  // namespace tumble::peers
