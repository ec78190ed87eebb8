// tumble report: speed against error, as numbers, figures and a table.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/file/data.h"
#include "app/file/file.h"
#include "app/report/machine.h"
#include "app/report/page.h"
#include "app/report/plot.h"
#include "app/scene/demos.h"

namespace tumble::command {

namespace {

struct Options {
  std::vector<std::string> scenes;
  std::string folder = "out/report";
  double budget = 0.1;  // [s] of CPU time a point
  bool convergence = false;
  std::vector<std::string> overrides;
};

// The report's own scenes, in the order of their names.
std::vector<std::string> reportScenes() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(dataFolder("report")))
    if (entry.path().extension() == ".toml") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::size_t pointsOf(const ChartDef& chart) {
  std::size_t points = 0;
  for (const CurveDef& curve : chart.curves) points += curve.along.values.size();
  return points;
}

// Runs every chart of every scene and writes its numbers.
std::vector<Study> study(const Options& options) {
  std::vector<Study> studies;
  for (const std::string& path : options.scenes) {
    const Scene scene = load({path, options.overrides});
    if (scene.charts.empty())
      throw SceneError(
          {{{scene.file}, "there is no [[chart]] in it, so there is nothing to report"}});
    for (std::size_t k = 0; k < scene.charts.size(); ++k) {
      Progress progress(scene.charts[k].variant.title);
      const double points = static_cast<double>(pointsOf(scene.charts[k]));
      double done = 0.0;
      Study now = runStudy(scene, k, options.budget, [&] { progress.show(++done / points); });
      now.name = freeName(scene.name, studies);
      writeFile(options.folder + "/" + now.name + ".csv", studyCsv(now));
      studies.push_back(std::move(now));
    }
  }
  return studies;
}

// What finding contacts costs: the chapter of the report that has no scene.
std::vector<Scaling> detection(const Options& options) {
  std::vector<Scaling> scalings;
  Progress progress("Detection");
  for (Scaling (*measure)() : {broadPhaseScaling, searchScaling}) {
    scalings.push_back(measure());
    writeFile(options.folder + "/" + scalings.back().name + ".csv", scalingCsv(scalings.back()));
    progress.show(static_cast<double>(scalings.size()) / 2.0);
  }
  return scalings;
}

// How the solvers of the contact problem do on what the demos ask of them.
std::vector<Profile> contact(const Options& options) {
  constexpr int kInstants = 30;
  constexpr double kStep = 1.0 / 240.0;  // s
  Progress progress("Contact");
  std::vector<Problem> problems;
  const std::vector<std::string> names = demoNames();
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (Problem& problem : contactProblems(load({names[i], {}}), kInstants, kStep))
      problems.push_back(std::move(problem));
    progress.show(0.5 * static_cast<double>(i + 1) / static_cast<double>(names.size()));
  }
  std::vector<Profile> profiles;
  for (const double goal : {1e-4, 1e-8, 1e-12}) {
    profiles.push_back(solverProfile(problems, goal));
    writeFile(options.folder + "/" + profiles.back().name + ".csv", profileCsv(profiles.back()));
    progress.show(0.5 + static_cast<double>(profiles.size()) / 6.0);
  }
  return profiles;
}

// What halved steps say of the demos: numbers and scripts.
std::vector<SpeedOfScene> convergence(const Options& options, const std::string& machine) {
  Progress progress("Convergence");
  std::vector<SpeedOfScene> demos;
  std::string csv;
  const std::vector<std::string> names = demoNames();
  for (const std::string& name : names) {
    const Scene scene = load({name, options.overrides});
    const HalvingPlan plan{quarters(std::min(scene.world.duration, kDemoSpan)), kDemoBudget};
    SpeedOfScene& demo = demos.emplace_back();
    demo.convergence = convergenceOf(scene, plan, runHalved(scene, plan));
    demo.speed = speedOf(demo.convergence);
    demo.speed.name = "converge-" + name;
    const std::string file = options.folder + "/" + demo.speed.name;
    writeFile(file + ".csv", studyCsv(demo.speed));
    writeFile(file + ".gp",
              plotScript(demo.speed, labelsOf(std::span<const Study>(&demo.speed, 1)), machine));
    // One table for all of them: the scene's name before each row.
    std::istringstream rows(convergenceCsv(demo.convergence));
    std::string row;
    std::getline(rows, row);
    if (csv.empty()) csv = "demo," + row + "\n";
    while (std::getline(rows, row)) csv += name + "," + row + "\n";
    progress.show(static_cast<double>(demos.size()) / static_cast<double>(names.size()));
  }
  writeFile(options.folder + "/convergence.csv", csv);
  return demos;
}

// The page on convergence, without figures first: it stays if gnuplot is missing.
void writeConvergence(const Options& options, const std::string& machine) {
  const std::vector<SpeedOfScene> demos = convergence(options, machine);
  const std::string page = options.folder + "/convergence.html";
  writeFile(page, convergencePage(demos, machine, false));
  for (const SpeedOfScene& demo : demos)
    if (drawable(demo.speed)) runGnuplot(options.folder, demo.speed.name);
  writeFile(page, convergencePage(demos, machine, true));
  fmt::print("{}\n", page);
}

}  // namespace

int report(int argc, char** argv) {
  Options options;
  CommandLine line(
      "report", "Measures speed against error: CSV, figures, a table, a page.",
      {"             # charts of assets/report, detection, solvers, into out/report/index.html",
       "path/to/scene.toml -o out/mine   # the charts of a scene of your own"});
  line.option(
      "SCENE", options.scenes,
      "scenes with [[chart]]s [those of assets/report, and what detection and contact cost]");
  line.option("-o,--output", options.folder, "folder for numbers and figures [out/report]");
  line.option("--budget", options.budget, "CPU seconds for the cost of each point [0.1]",
              {.type = "S", .range = {{0.0, 100.0}}});
  line.flag("--convergence", options.convergence,
            "instead: only the page on halved steps of the demos, convergence.html");
  addOverrides(line, options.overrides);
  if (!line.read(argc, argv)) return kOk;
  const bool whole = options.scenes.empty();
  if (whole) options.scenes = reportScenes();

  // Numbers first: they stay if gnuplot is missing.
  makeFolder(options.folder);
  const std::string machine = machineLine();
  if (options.convergence) {
    writeConvergence(options, machine);
    return kOk;
  }
  const std::vector<Study> studies = study(options);
  const std::vector<Scaling> scalings = whole ? detection(options) : std::vector<Scaling>{};
  const std::vector<Profile> profiles = whole ? contact(options) : std::vector<Profile>{};
  const std::vector<HeadlineRow> rows = headlineRows(studies);
  writeFile(options.folder + "/table.csv", headlineCsv(rows));
  writeFile(options.folder + "/table.md", headlineMarkdown(rows));
  writeFile(options.folder + "/index.html",
            reportPage(studies, machine, false, scalings, profiles));
  for (const Study& one : studies)
    writeFile(options.folder + "/" + one.name + ".gp", plotScript(one, labelsOf(studies), machine));
  for (const Scaling& one : scalings)
    writeFile(options.folder + "/" + one.name + ".gp", plotScript(one, machine));
  for (const Profile& one : profiles)
    writeFile(options.folder + "/" + one.name + ".gp", plotScript(one, machine));
  fmt::print("{}", headlineMarkdown(rows));
  for (const Study& one : studies) runGnuplot(options.folder, one.name);
  for (const Scaling& one : scalings) runGnuplot(options.folder, one.name);
  for (const Profile& one : profiles) runGnuplot(options.folder, one.name);
  writeFile(options.folder + "/index.html", reportPage(studies, machine, true, scalings, profiles));
  fmt::print("{}/index.html\n", options.folder);
  if (whole) writeConvergence(options, machine);
  return kOk;
}

}  // namespace tumble::command
