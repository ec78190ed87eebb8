// tumble converge: halved steps and all methods, for scenes without a closed form.
#include <fmt/core.h>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/command/progress.h"
#include "app/file/file.h"
#include "app/report/convergence.h"
#include "app/report/machine.h"
#include "app/report/plot.h"

namespace tumble::command {

namespace {

std::vector<MethodRuns> runAll(const Scene& scene, const HalvingPlan& plan) {
  Progress progress("converging");
  const double methods = static_cast<double>(methodNames().size()) - 1.0;  // without "auto"
  double done = 0.0;
  return runHalved(scene, plan, [&] { progress.show(++done / methods); });
}

// The figure and its numbers: speed against error at the last instant. The numbers are what was
// asked for, so that it is no failure if gnuplot is missing.
void drawSpeed(const Convergence& convergence, const std::string& folder) {
  Study study = speedOf(convergence);
  study.name = "speed";
  writeFile(folder + "/speed.csv", studyCsv(study));
  writeFile(folder + "/speed.gp",
            plotScript(study, labelsOf(std::span<const Study>(&study, 1)), machineLine()));
  if (!drawable(study)) {
    fmt::print("no figure: no run has an error that is known\n");
    return;
  }
  try {
    runGnuplot(folder, study.name);
    fmt::print("{0}/speed.svg, speed.png\n", folder);
  } catch (const NoGnuplot&) {
    fmt::print(
        "no {0}/speed.svg: gnuplot draws it and is not here; install gnuplot-nox, then "
        "`gnuplot speed.gp` in {0}\n",
        folder);
  }
}

}  // namespace

int converge(int argc, char** argv) {
  SceneOptions options;
  std::string folder, at;
  double budget = 60.0;
  CommandLine line(
      "converge", "Runs a scene at h, h/2, h/4 and h/8 by every method that takes it.",
      {"path-of-brick              # differences, order, error and cost after each quarter of it",
       "my-scene.toml --at 0.5,2 -o out/mine",
       "dominoes --at 1 --set stepping.step=0.01   # h is the step of the scene",
       "pile --budget 10           # no run beyond 10 CPU seconds"});
  addSceneOptions(line, options);
  line.option("--at", at, "instants to compare at, in s [each quarter of the duration]",
              {.type = "T,T,..."});
  line.option("-o,--output", folder,
              "folder for converge.csv and the figure speed.svg [out/<scene>]");
  line.option("--budget", budget, "CPU seconds that a run may take [60]",
              {.type = "S", .range = {{1.0, 1e6}}});
  if (!line.read(argc, argv)) return kOk;

  const Scene scene = load(options);
  const double duration = scene.world.duration;
  const HalvingPlan plan{at.empty() ? quarters(duration) : parseInstants(at, duration), budget};
  makeWorld(scene);  // what its own method refuses is refused
  const Convergence convergence = convergenceOf(scene, plan, runAll(scene, plan));
  fmt::print("{}\n", convergenceText(convergence));

  if (folder.empty()) folder = "out/" + scene.name;
  makeFolder(folder);
  writeFile(folder + "/converge.csv", convergenceCsv(convergence));
  fmt::print("{}/converge.csv\n", folder);
  drawSpeed(convergence, folder);
  return kOk;
}

}  // namespace tumble::command
