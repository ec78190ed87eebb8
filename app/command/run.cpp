#include "app/command/run.h"

#include <fmt/core.h>

#include <numeric>

#include "app/command/command.h"
#include "app/command/interrupt.h"
#include "app/command/progress.h"

namespace tumble {

namespace {

// Shows how far the run has come and ends it between two samples if the user asks for that.
std::function<void(double)> watch(Progress& progress) {
  return [&progress](double share) {
    progress.show(share);
    if (Interrupt::asked()) throw Interrupted("stopped while simulating; nothing is kept of it");
  };
}

}  // namespace

Recording recordWithProgress(const Scene& scene, double rate) {
  const Interrupt interrupt;
  Progress progress("simulating");
  return record(scene, rate > 0.0 ? rate : scene.image.rate, watch(progress));
}

Recording runWithProgress(const Scene& scene, double rate, const std::function<void(Sample&&)>& see,
                          bool timed) {
  const Interrupt interrupt;
  Progress progress("simulating");
  return run(scene, rate > 0.0 ? rate : scene.image.rate, see, watch(progress), timed);
}

void noteUnused(const Scene& scene, std::string_view runs) {
  if (scene.world.method != "auto") return;
  std::string keys;
  for (const auto& [key, place] : scene.places)
    for (const std::string_view table : {"course", "stepping"})
      if (table != runs && key.starts_with(std::string(table) + "."))
        keys += (keys.empty() ? "" : ", ") + key;
  if (!keys.empty())
    note(fmt::format("no part in this run, which `auto` gives to {}: {}; set world.method", runs,
                     keys));
}

void printCertificate(const Recording& recording) {
  if (quiet()) return;
  const Certificate& c = recording.report.certificate;
  fmt::print("steps {}   events {}   cpu {:.3g} s\n", c.steps, c.events, recording.cpuSeconds);
  fmt::print("penetration {:.2g} m   complementarity {:.2g}\n", c.max_penetration,
             c.max_complementarity);
  fmt::print("energy {:.6g} -> {:.6g} J   lost in impacts {:.6g} J   by friction {:.6g} J\n",
             c.energy_start, c.energy_end, c.energy_lost_impact, c.energy_lost_friction);
  fmt::print("energy balance error {:.2g}   momentum error {:.2g}\n", c.energy_balance_error,
             c.momentum_error);
  if (c.energy_added_repair != 0.0)
    fmt::print("energy added by repairs {:.6g} J\n", c.energy_added_repair);
  for (const std::string& note : recording.report.notes) fmt::print("note: {}\n", note);
}

void printTimes(const Recording& recording) {
  const auto& seconds = recording.times.seconds;
  const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  if (!(sum > 0.0)) return;
  fmt::print("{:<8} {:>9} {:>6}\n", "stage", "s", "share");
  for (std::size_t k = 0; k < kStageNames.size(); ++k)
    fmt::print("{:<8} {:>9.3g} {:>5.1f}%  {}\n", kStageNames[k].name, seconds[k],
               100.0 * seconds[k] / sum, kStageNames[k].summary);
}

int exitOf(const Recording& recording) {
  if (!recording.report.stopped) return kOk;
  tell(fmt::format("tumble: the physics could not go on: {}\n", recording.report.reason));
  return kPhysics;
}

}  // namespace tumble
