// The comparison as text: a row for each decade of error that a peer reaches, losses first.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tests/peers/cheapest.h"
#include "tests/peers/run.h"

namespace tumble::peers {

/// scene, engine, setting, steps_per_second, error, cost median, cost of each repeat, source: a row
/// for each point.
std::string pointsCsv(std::span<const Point> points);

/// Points of such rows, without those that were recorded.
/// @throws std::runtime_error for a row that cannot be read
std::vector<Point> readPoints(const std::string& csv);

/// A row for each duel, with both ratios and their intervals.
std::string duelsCsv(std::span<const Outcome> outcomes);

/// The cells of the table, its header first: of each decade of error the duel that goes worst for
/// us as it comes.
std::vector<std::vector<std::string>> tableCells(std::span<const Outcome> outcomes);

std::string tableMarkdown(std::span<const Outcome> outcomes);

/// "lost", "even" or "won".
std::string_view verdictName(Verdict verdict);

}  // namespace tumble::peers
