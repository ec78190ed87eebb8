// peers: what the same scenes cost other engines, and how far off they end.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/command/progress.h"
#include "app/file/file.h"
#include "app/report/machine.h"
#include "app/report/plot.h"
#include "tests/peers/page.h"
#include "tests/peers/table.h"

namespace {

using namespace tumble;
using namespace tumble::peers;

struct Options {
  std::string folder = "out/report";
  std::vector<std::string> scenes, engines;
  Plan plan;
  bool quick = false, resume = false;
};

Options readOptions(int argc, char** argv) {
  Options options;
  CLI::App line("Speed against error of other engines on tests/peers/scenes.", "peers");
  line.add_option("-o,--output", options.folder, "folder for numbers and figures [out/report]");
  line.add_option("--scene", options.scenes, "only these, by their names in the table");
  line.add_option("--engine", options.engines, "only these: tumble, Bullet, ODE, ...");
  line.add_option("--repeats", options.plan.repeats, "runs for the clock, of each point [5]")
      ->check(CLI::Range(1, 1000));
  line.add_option("--most", options.plan.most, "CPU seconds that a run may take [30]")
      ->check(CLI::Range(1.0, 1e4));
  line.add_flag("--quick", options.quick,
                "three repeats, the three coarsest steps, 20 CPU s a run");
  line.add_flag("--resume", options.resume, "keep the scenes that peers.csv in the folder has");
  try {
    line.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(line.exit(error) == 0 ? 0 : 2);
  }
  return options;
}

// Whether a list of names has one, or is empty.
bool wanted(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<Trial> chosenTrials(const Options& options) {
  constexpr std::size_t kQuick = 3;
  std::vector<Trial> chosen;
  for (Trial trial : trials()) {
    if (!wanted(options.scenes, trial.name)) continue;
    if (options.quick) trial.rates.resize(std::min(trial.rates.size(), kQuick));
    chosen.push_back(std::move(trial));
  }
  return chosen;
}

std::vector<EngineSetup> chosenSetups(const Options& options) {
  std::vector<EngineSetup> chosen = allSetups();
  std::erase_if(chosen, [&](const EngineSetup& s) { return !wanted(options.engines, s.engine); });
  return chosen;
}

std::string gapsCsv(const std::vector<Gap>& gaps) {
  std::string csv = "scene,engine,setting,why\n";
  for (const Gap& gap : gaps)
    csv += fmt::format("{},{},\"{}\",\"{}\"\n", gap.scene, gap.engine, gap.setting, gap.why);
  return csv;
}

// Table, page and figures of what was measured, with what was recorded elsewhere.
void show(const std::string& folder, const std::vector<Trial>& trials,
          const std::vector<EngineSetup>& setups, std::vector<Point> points) {
  const std::vector<Outcome> all = outcomes(points);
  writeFile(folder + "/peers-duels.csv", duelsCsv(all));
  writeFile(folder + "/peers.md", tableMarkdown(all));
  fmt::print("{}", tableMarkdown(all));
  for (Point& point : recordedPoints(PEERS_FOLDER "/recorded.csv")) points.push_back(point);
  writeFile(folder + "/peers.csv", pointsCsv(points));
  const std::vector<Study> studies = figures(trials, points);
  const std::string machine = machineLine();
  for (const Study& study : studies) {
    writeFile(folder + "/" + study.name + ".csv", studyCsv(study));
    writeFile(folder + "/" + study.name + ".gp", plotScript(study, labelsOf(studies), machine));
  }
  // Without gnuplot the page stays, with the numbers alone.
  writeFile(folder + "/peers.html", peersPage(all, studies, setups, machine, ""));
  for (const Study& study : studies) runGnuplot(folder, study.name);
  writeFile(folder + "/peers.html", peersPage(all, studies, setups, machine, folder));
  fmt::print("{}/peers.html\n", folder);
}

void compare(Options options) {
  if (options.quick) {
    options.plan.repeats = std::min(options.plan.repeats, 3);
    options.plan.most = std::min(options.plan.most, 20.0);
  }
  makeFolder(options.folder);
  const std::vector<EngineSetup> setups = chosenSetups(options);
  std::vector<Point> points;
  std::vector<Gap> gaps;
  const std::vector<Trial> trials = chosenTrials(options);
  const std::string file = options.folder + "/peers.csv";
  if (options.resume && std::filesystem::exists(file)) points = readPoints(readFile(file));
  for (const Trial& trial : trials) {
    if (std::any_of(points.begin(), points.end(),
                    [&](const Point& point) { return point.scene == trial.name; }))
      continue;
    const Scene scene =
        readScene(std::string(PEERS_FOLDER "/scenes/") + trial.file + ".toml", trial.overrides);
    Progress progress(trial.title);
    for (Point& point : runTrial(trial, scene, setups, options.plan, gaps,
                                 [&](double share) { progress.show(share); }))
      points.push_back(std::move(point));
    // What is there so far stays if a later scene is stopped.
    writeFile(file, pointsCsv(points));
    writeFile(options.folder + "/peers-left-out.csv", gapsCsv(gaps));
  }
  show(options.folder, trials, setups, std::move(points));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    compare(readOptions(argc, argv));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "peers: %s\n", error.what());
    return 5;
  }
}
