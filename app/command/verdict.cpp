#include "app/command/verdict.h"

#include <limits>

#include "app/scene/findings.h"

namespace tumble {

Verdict judge(const Scene& scene, const Recording& recording) {
  Verdict verdict;
  for (const std::string& name : scene.checks)
    if (const Check* check = findCheck(name))
      for (ClaimRow& row : check->rows(scene, recording)) verdict.rows.push_back(std::move(row));
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

void requireKnownChecks(const Scene& scene) {
  std::vector<std::string> known;
  for (const Check& check : checks()) known.emplace_back(check.name);
  std::vector<Diagnostic> diagnostics;
  for (const std::string& name : scene.checks) {
    if (findCheck(name)) continue;
    const auto place = scene.places.find("checks");
    diagnostics.push_back({place != scene.places.end() ? place->second : Place{scene.file},
                           "checks: unknown check '" + name + "'" + hint(name, known)});
  }
  if (!diagnostics.empty()) throw SceneError(std::move(diagnostics));
}

}  // namespace tumble
