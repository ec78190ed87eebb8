#include "tests/peers/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <sstream>

#include "app/record/output.h"

namespace tumble::peers {

namespace {

constexpr const char* kMeasured = "measured";

// The cells of a row; commas between quotes part none.
std::vector<std::string> cellsOf(const std::string& row) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : row) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::string settingText(const Point& point) {
  return fmt::format("{} {}, {:g}/s", point.engine, point.setting, point.rate);
}

std::string ratioText(const std::optional<Point>& ours, const Ratio& ratio) {
  if (!ours) return "out of reach";
  return fmt::format("{:.2g} [{:.2g}, {:.2g}] {}", ratio.middle, ratio.low, ratio.high,
                     verdictName(verdict(ours, ratio)));
}

// Of each decade the duel with the least ratio as it comes, out of reach first.
std::vector<Duel> worstOfDecades(const std::vector<Duel>& duels) {
  std::map<int, Duel, std::greater<>> worst;
  const auto badness = [](const Duel& duel) {
    return std::pair(duel.byDefault ? duel.defaultRatio.middle : -1.0,
                     duel.atBest ? duel.bestRatio.middle : -1.0);
  };
  for (const Duel& duel : duels) {
    const int decade = static_cast<int>(std::ceil(std::log10(duel.peer.error)));
    const auto [place, first] = worst.try_emplace(decade, duel);
    if (!first && badness(duel) < badness(place->second)) place->second = duel;
  }
  std::vector<Duel> all;
  for (const auto& [decade, duel] : worst) all.push_back(duel);
  return all;
}

}  // namespace

std::string_view verdictName(Verdict verdict) {
  return verdict == Verdict::Lost ? "lost" : verdict == Verdict::Even ? "even" : "won";
}

std::string pointsCsv(std::span<const Point> points) {
  std::string csv =
      "scene,engine,setting,as_it_comes,steps_per_second,error,cpu_seconds_per_second,repeats,"
      "source\n";
  for (const Point& point : points)
    csv += fmt::format("{},{},{},{:d},{:g},{:.6g},{:.6g},{:.4g},{}\n", point.scene, point.engine,
                       csvQuoted(point.setting), point.asItComes, point.rate, point.error,
                       median(point.costs), fmt::join(point.costs, " "),
                       point.recorded ? "recorded on another machine" : kMeasured);
  return csv;
}

std::vector<Point> readPoints(const std::string& csv) {
  std::istringstream rows(csv);
  std::vector<Point> points;
  std::string row;
  std::getline(rows, row);
  while (std::getline(rows, row)) {
    const std::vector<std::string> cells = cellsOf(row);
    if (cells.size() != 9) throw std::runtime_error("not a row of points: " + row);
    Point point{cells[0],
                cells[1],
                cells[2],
                cells[3] == "1",
                false,
                std::stod(cells[4]),
                std::stod(cells[5]),
                {}};
    std::istringstream costs(cells[7]);
    for (double cost; costs >> cost;) point.costs.push_back(cost);
    if (cells[8] == kMeasured) points.push_back(std::move(point));
  }
  return points;
}

std::string duelsCsv(std::span<const Outcome> outcomes) {
  std::string csv =
      "scene,error,peer,peer_cost,default,default_cost,ratio,low,high,best,best_cost,best_ratio,"
      "best_low,best_high\n";
  const auto side = [](const std::optional<Point>& ours, const Ratio& ratio) {
    return ours ? fmt::format(",{},{:.6g},{:.4g},{:.4g},{:.4g}", csvQuoted(settingText(*ours)),
                              median(ours->costs), ratio.middle, ratio.low, ratio.high)
                : std::string(",,,,,");
  };
  for (const Outcome& outcome : outcomes)
    for (const Duel& duel : outcome.duels)
      csv +=
          fmt::format("{},{:.6g},{},{:.6g}{}{}\n", outcome.scene, duel.peer.error,
                      csvQuoted(settingText(duel.peer)), median(duel.peer.costs),
                      side(duel.byDefault, duel.defaultRatio), side(duel.atBest, duel.bestRatio));
  return csv;
}

std::vector<std::vector<std::string>> tableCells(std::span<const Outcome> outcomes) {
  std::vector<std::vector<std::string>> rows = {
      {"scene", "error", "cheapest peer", "its CPU s per s", "times tumble's cost, as it comes",
       "at its best", "best setting"}};
  for (const Outcome& outcome : outcomes)
    for (const Duel& duel : worstOfDecades(outcome.duels))
      rows.push_back({outcome.scene, fmt::format("{:.1e}", duel.peer.error), settingText(duel.peer),
                      fmt::format("{:.2g}", median(duel.peer.costs)),
                      ratioText(duel.byDefault, duel.defaultRatio),
                      ratioText(duel.atBest, duel.bestRatio),
                      duel.atBest ? settingText(*duel.atBest).substr(7) : "–"});
  return rows;
}

std::string tableMarkdown(std::span<const Outcome> outcomes) {
  const auto rows = tableCells(outcomes);
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    text += fmt::format("| {} |\n", fmt::join(rows[i], " | "));
    if (i > 0) continue;
    text += "|";
    for (std::size_t k = 0; k < rows[i].size(); ++k) text += "---|";
    text += "\n";
  }
  return text;
}

}  // namespace tumble::peers
