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
#include "app/panel/variant_run.h"
#include "app/report/bends.h"
#include "app/report/headline.h"
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
  bool quick = false, convergence = false;
  std::vector<std::string> overrides;
};

// How much is measured.
struct Extent {
  std::size_t every;  // point of a curve: all, or each second one …
  double budget;      // [s] of CPU time a point
  int instants;       // of each demo at which the solvers are asked
  double demo;        // [s] of each demo at most
  int bodies, crowd;  // at most, of the broad phase and of a crowd
};

Extent extentOf(const Options& options) {
  if (options.quick) return {4, std::min(options.budget, 0.005), 2, 0.25, 3000, 50};
  return {1, options.budget, 30, 1e9, 100000, 400};
}

// The report's own scenes, in the order of their names.
std::vector<std::string> reportScenes() {
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(dataFolder("report")))
    if (entry.path().extension() == ".toml") paths.push_back(entry.path().string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

// The first of each so many values of every curve.
void thin(std::size_t every, ChartDef& chart) {
  for (CurveDef& curve : chart.curves) {
    auto& values = curve.along.values;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < values.size(); k += every) values[kept++] = values[k];
    values.resize(kept);
  }
}

std::size_t pointsOf(const ChartDef& chart) {
  std::size_t points = 0;
  for (const CurveDef& curve : chart.curves) points += curve.along.values.size();
  return points;
}

// Numbers first: they stay if gnuplot is missing.
template <class Figure>
void write(const Options& options, const Figure& figure, const std::string& csv,
           const std::string& script) {
  writeFile(options.folder + "/" + figure.name + ".csv", csv);
  writeFile(options.folder + "/" + figure.name + ".gp", script);
}

// Runs every chart of every scene and writes its numbers.
std::vector<Study> study(const Options& options, const std::string& machine) {
  std::vector<Study> studies;
  for (const std::string& path : options.scenes) {
    Scene scene = load({path, options.overrides});
    if (scene.charts.empty())
      throw SceneError(
          {{{scene.file}, "there is no [[chart]] in it, so there is nothing to report"}});
    makeFolder(options.folder);  // a scene that is refused, or given up meanwhile, leaves none
    for (std::size_t k = 0; k < scene.charts.size(); ++k) {
      thin(extentOf(options).every, scene.charts[k]);
      Progress progress(scene.charts[k].variant.title);
      const double points = static_cast<double>(pointsOf(scene.charts[k]));
      double done = 0.0;
      Study now =
          runStudy(scene, k, extentOf(options).budget, [&] { progress.show(++done / points); });
      now.name = freeName(scene.name, studies);
      studies.push_back(std::move(now));
    }
  }
  for (const Study& one : studies)
    write(options, one, studyCsv(one), plotScript(one, labelsOf(studies), machine));
  const std::vector<HeadlineRow> rows = headlineRows(studies);
  writeFile(options.folder + "/table.csv", headlineCsv(rows));
  writeFile(options.folder + "/table.md", headlineMarkdown(rows));
  fmt::print("{}", headlineMarkdown(rows));
  return studies;
}

// Who is within a factor of the fastest method how often: of several that come to some accuracy.
std::vector<Profile> methodProfiles(const Options& options, const std::vector<Study>& studies,
                                    const std::string& machine) {
  Profile profile = methodProfile(studies);
  if (profile.curves.size() < 2) return {};
  write(options, profile, profileCsv(profile), plotScript(profile, machine));
  return {std::move(profile)};
}

// What grows with size.
std::vector<Scaling> growth(const Options& options, const std::string& machine) {
  const Extent extent = extentOf(options);
  std::vector<Scaling> scalings;
  Progress progress("Growth");
  scalings.push_back(broadPhaseScaling(extent.bodies));
  progress.show(0.3);
  scalings.push_back(searchScaling());
  progress.show(0.5);
  scalings.push_back(crowdScaling(extent.crowd));
  for (const Scaling& one : scalings)
    write(options, one, scalingCsv(one), plotScript(one, machine));
  return scalings;
}

// What scenes cost that differ by one thing.
std::vector<Price> prices(const Options& options) {
  const Scene ladder = readScene(dataFolder("report") + "/parts/rungs.toml");
  std::vector<Scene> rungs;
  for (const PanelDef& panel : ladder.panels) {
    rungs.push_back(sceneOf(ladder, panel.variant));
    rungs.back().title = panel.variant.title;
  }
  std::vector<Price> prices = pricesOf(rungs, extentOf(options).budget);
  writeFile(options.folder + "/prices.csv", priceCsv(prices));
  return prices;
}

// What bends, by preset and step.
std::vector<Study> bends(const Options& options, const std::string& machine) {
  std::vector<double> steps = {1.0 / 30.0, 1.0 / 60.0, 1.0 / 120.0};
  if (options.quick) steps.pop_back();
  Progress progress("What bends");
  std::vector<Study> studies;
  for (const char* name : kBendingScenes) {
    const Scene scene = readScene(fmt::format("{}/parts/{}.toml", dataFolder("report"), name));
    studies.push_back(bendingStudy(scene, steps, extentOf(options).budget));
    progress.show(static_cast<double>(studies.size()) / std::size(kBendingScenes));
  }
  for (const Study& one : studies)
    write(options, one, studyCsv(one), plotScript(one, labelsOf(studies), machine));
  return studies;
}

// How the solvers of the contact problem do on what the demos ask of them.
std::vector<Profile> contact(const Options& options, const std::string& machine) {
  constexpr double kStep = 1.0 / 240.0;  // s
  Progress progress("Contact");
  std::vector<Problem> problems;
  const std::vector<std::string> names = demoNames();
  for (std::size_t i = 0; i < names.size(); ++i) {
    Scene demo = load({names[i], {}});
    demo.world.duration = std::min(demo.world.duration, extentOf(options).demo);
    for (Problem& problem : contactProblems(demo, extentOf(options).instants, kStep))
      problems.push_back(std::move(problem));
    progress.show(0.5 * static_cast<double>(i + 1) / static_cast<double>(names.size()));
  }
  std::vector<Profile> profiles;
  for (const double goal : {1e-4, 1e-8, 1e-12}) {
    profiles.push_back(solverProfile(problems, goal));
    write(options, profiles.back(), profileCsv(profiles.back()),
          plotScript(profiles.back(), machine));
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

// The page with all chapters: without figures first, so that it stays if gnuplot is missing.
void writePage(const Options& options, const std::string& name, const std::string& machine,
               const std::vector<Chapter>& chapters) {
  const std::string file = options.folder + "/" + name, title = "Speed against error";
  writeFile(file, reportPage(title, machine, chapters, ""));
  for (const Chapter& chapter : chapters)
    for (const PageFigure& figure : chapter.figures) runGnuplot(options.folder, figure.name);
  writeFile(file, reportPage(title, machine, chapters, options.folder));
  fmt::print("{}\n", file);
}

}  // namespace

int report(int argc, char** argv) {
  Options options;
  CommandLine line(
      "report", "Measures speed against error: CSV, figures, a table, a page.",
      {"             # charts of assets/report, solvers, growth, prices, convergence of all demos",
       "--quick      # a quarter of the points, without convergence: a minute",
       "path/to/scene.toml -o out/mine   # the charts of a scene of your own"});
  line.option("SCENE", options.scenes,
              "scenes with [[chart]]s [those of assets/report, and chapters that have no scene]");
  line.option("-o,--output", options.folder, "folder for numbers and figures [out/report]");
  line.option("--budget", options.budget, "CPU seconds for the cost of each point [0.1]",
              {.type = "S", .range = {{0.0, 100.0}}});
  line.flag("--quick", options.quick,
            "fewer points, sizes and instants, no halved steps: a minute");
  line.flag("--convergence", options.convergence,
            "instead: only the page on halved steps of the demos, convergence.html");
  addOverrides(line, options.overrides);
  if (!line.read(argc, argv)) return kOk;
  const bool whole = options.scenes.empty();
  if (whole) options.scenes = reportScenes();

  const std::string machine = machineLine();
  if (options.convergence) {
    makeFolder(options.folder);
    writePage(options, "convergence.html", machine,
              {convergenceChapter(convergence(options, machine))});
    return kOk;
  }
  const std::vector<Study> studies = study(options, machine);
  std::vector<Chapter> chapters = chaptersOf(studies, methodProfiles(options, studies, machine));
  if (whole) {
    chapters.push_back(bendingChapter(bends(options, machine)));
    chapters.push_back(solverChapter(contact(options, machine)));
    chapters.push_back(growthChapter(growth(options, machine)));
    chapters.push_back(priceChapter(prices(options)));
    if (!options.quick) chapters.push_back(convergenceChapter(convergence(options, machine)));
  }
  writePage(options, "index.html", machine, chapters);
  return kOk;
}

}  // namespace tumble::command
