// tumble check: scenes against their closed forms.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/claim/verdict.h"
#include "app/command/command.h"
#include "app/command/options.h"
#include "app/command/run.h"
#include "app/command/state.h"
#include "app/scene/demos.h"

namespace tumble::command {

namespace {

void printTable(const Verdict& verdict) {
  std::size_t width = 46;
  for (const ClaimRow& row : verdict.rows)
    if (!row.silent) width = std::max(width, row.label.size());
  fmt::print("  {:<{}}{:>18}{:>20}{:>11}{:>11}\n", "", width, "measured", "exact", "error",
             "allowed");
  for (const ClaimRow& row : verdict.rows) {
    if (row.silent) {
      fmt::print("  {}  FAILED\n", row.label);
      continue;
    }
    const std::string exact = fmt::format("{}{:.10g}", signOf(row.relation), row.exact);
    fmt::print("  {:<{}}{:>18.10g}{:>20}{:>11.2g}{:>11.2g}  {}\n", row.label, width, row.measured,
               exact, row.error, row.allowed, row.holds() ? "ok" : "FAILED");
  }
}

using Json = nlohmann::ordered_json;

Json rowsOf(const Verdict& verdict) {
  Json rows = Json::array();
  for (const ClaimRow& row : verdict.rows) {
    Json one = {{"label", row.label}, {"holds", row.holds()}};
    if (!row.silent)
      one.update({{"measured", row.measured},
                  {"exact", row.exact},
                  {"error", row.error},
                  {"allowed", row.allowed}});
    rows.push_back(std::move(one));
  }
  return rows;
}

// Whether all samples show the bodies where the first has them, to what no picture shows.
bool nothingMoved(const Recording& recording) {
  constexpr double kUnseen = 1e-9;  // [m], and of a turn [rad]
  for (const Sample& sample : recording.samples)
    for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
      const BodySample &now = sample.bodies[i], &start = recording.samples.front().bodies[i];
      if ((now.x - start.x).norm() > kUnseen) return false;
      if ((now.q.coeffs() - start.q.coeffs()).norm() > kUnseen) return false;
    }
  return true;
}

// Whether the scene's claims hold; a run that stopped on the way throws none, but fails as
// kPhysics. `rows` counts them. What the audit of a run disagrees with fails in any scene, with
// claims or without.
int checkScene(const Scene& scene, Json* json, std::size_t& rows) {
  makeWorld(scene);
  const std::string claim = scene.claim.empty() ? scene.title : scene.claim;
  if (!json) fmt::print("{}: {}\n", scene.name, claim);
  if (scene.checks.empty() && scene.expects.empty() && !json) fmt::print("  no checks\n");
  const Recording recording = recordWithProgress(scene);
  if (const int stopped = exitOf(recording)) return stopped;
  const Verdict verdict = judge(scene, recording);
  rows += verdict.rows.size();
  const bool still = nothingMoved(recording);
  if (json)
    json->push_back({{"scene", scene.name},
                     {"claim", claim},
                     {"holds", verdict.failed == 0},
                     {"moved", !still},
                     {"rows", rowsOf(verdict)}});
  else if (!verdict.rows.empty())
    printTable(verdict);
  if (still && !json) fmt::print("  nothing moved: this is a scene at rest\n");
  return verdict.failed > 0 ? kFailed : kOk;
}

}  // namespace

int check(int argc, char** argv) {
  std::vector<std::string> names, overrides;
  std::string folder;
  bool state = false, json = false;
  CommandLine line("check", "Holds scenes to the closed forms that they claim.",
                   {"                # every demo", "path-of-brick my-scene.toml",
                    "stacked-boxes --set world.gravity=[0,-1.62,0]",
                    "--state my-scene.toml -o out/mine # is its start legal? state.png shows it"});
  line.option("SCENE", names, "demos or TOML files [every demo]");
  addOverrides(line, overrides);
  line.flag("--state", state,
            "instead: are positions, velocities and accelerations of the start legal?");
  line.option("-o,--output", folder, "folder for state.png [none]", {.needs = "--state"});
  line.flag("--json", json, "what came of it as JSON");
  if (!line.read(argc, argv)) return kOk;

  if (names.empty()) names = demoNames();
  int worst = kOk;
  Json scenes = Json::array();
  if (state) {
    for (const std::string& name : names) {
      const Scene scene = load({name, overrides});
      const bool several = !folder.empty() && names.size() > 1;
      worst = std::max(worst, checkState(scene, several ? folder + "/" + scene.name : folder,
                                         json ? &scenes : nullptr));
    }
    if (json) fmt::print("{}\n", scenes.dump(2));
    return worst;
  }
  std::size_t claims = 0, rows = 0;
  for (const std::string& name : names) {
    const Scene scene = load({name, overrides});
    claims += scene.checks.size() + scene.expects.size();
    worst = std::max(worst, checkScene(scene, json ? &scenes : nullptr, rows));
    std::fflush(stdout);
  }
  if (json)
    fmt::print("{}\n", scenes.dump(2));
  else if (claims > 0)
    fmt::print("{}\n", worst != kOk
                           ? (rows == 1 ? "the claim does NOT hold" : "some claims do NOT hold")
                       : rows == 1 ? "the claim holds"
                                   : "all claims hold");
  else
    fmt::print(
        "nothing was checked: no scene names a claim in `checks` or makes one by [[expect]]\n");
  return worst;
}

}  // namespace tumble::command
