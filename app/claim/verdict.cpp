#include "app/claim/verdict.h"

#include <fmt/format.h>

#include <limits>

#include "app/claim/expect.h"
#include "app/scene/findings.h"

namespace tumble {

Verdict judge(const Scene& scene, const Recording& recording) {
  Verdict verdict;
  const Scene ran = asRun(scene, recording);
  for (const std::string& name : scene.checks)
    if (const Check* check = findCheck(name))
      for (ClaimRow& row : check->rows(ran, recording)) {
        if (row.silent) row.label = name + " says nothing here: " + row.label;
        verdict.rows.push_back(std::move(row));
      }
  for (const Disagreement& d : recording.report.disagreements)
    verdict.rows.push_back(
        {"audit: " + std::string(d.what), d.found, d.stated, d.found - d.stated, d.allowed});
  for (Expectation& one : expectationsOf(ran, recording)) {
    verdict.rows.push_back(std::move(one.row));
    verdict.expects.push_back(one.index);
  }
  for (const ClaimRow& row : verdict.rows) {
    if (!row.holds()) ++verdict.failed;
    double share = row.error / row.allowed;
    if (!(row.allowed > 0.0)) share = row.holds() ? 0.0 : std::numeric_limits<double>::infinity();
    if (!verdict.worst.empty() && share <= verdict.worstShare) continue;
    verdict.worst = row.label;
    verdict.worstShare = share;
  }
  return verdict;
}

std::string toldOf(const Verdict& verdict) {
  const std::size_t count = verdict.rows.size();
  if (count == 0) return "";
  if (count == 1) return verdict.failed == 0 ? "its claim holds" : "its claim fails";
  if (verdict.failed > 0) return fmt::format("{} of {} claims fail", verdict.failed, count);
  return count == 2 ? "both claims hold" : fmt::format("all {} claims hold", count);
}

void requireKnownChecks(const Scene& scene) {
  std::vector<std::string> known;
  for (const Check& check : checks()) known.emplace_back(check.name);
  std::vector<Diagnostic> diagnostics = faultsOfFormulas(scene);
  const auto require = [&](const std::string& name, const std::string& key,
                           const std::string& where) {
    if (findCheck(name)) return;
    const auto place = scene.places.find(where);
    diagnostics.push_back({place != scene.places.end() ? place->second : Place{scene.file},
                           key + ": unknown check " + inQuotes(name) + hint(name, known)});
  };
  for (std::size_t i = 0; i < scene.checks.size(); ++i)
    require(scene.checks[i], "checks", "checks[" + std::to_string(i) + "]");
  for (std::size_t i = 0; i < scene.charts.size(); ++i) {
    const std::string index = std::to_string(i);
    require(scene.charts[i].error, "chart." + index + ".error", "chart[" + index + "].error");
  }
  if (!diagnostics.empty()) throw SceneError(std::move(diagnostics));
}

}  // namespace tumble
