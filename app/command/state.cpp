#include "app/command/state.h"

#include <fmt/core.h>

#include <algorithm>

#include "app/command/command.h"
#include "app/command/studio.h"
#include "app/file/file.h"
#include "app/present/state_picture.h"

namespace tumble {

namespace {

void printLayer(const Scene& scene, const StartCheck& check, StateLayer layer) {
  const auto count = std::count_if(check.faults.begin(), check.faults.end(),
                                   [&](const StateFault& fault) { return fault.layer == layer; });
  fmt::print("  {:<14}{}", layerName(layer), count > 0 ? "NOT OK" : "ok");
  if (layer == StateLayer::Accelerations && count == 0 && check.resting > 0)
    fmt::print("      forces at {} contact points hold what would close at up to {:.4g} m/s²",
               check.resting, -check.unheld);
  fmt::print("\n");
  for (const StateFault& fault : check.faults)
    if (fault.layer == layer) fmt::print("    {}\n", faultText(scene, fault));
}

}  // namespace

int checkState(const Scene& scene, const std::string& folder) {
  const StartCheck check = checkedStart(scene);
  fmt::print("{}: the state at its start\n", scene.name);
  for (const StateLayer layer :
       {StateLayer::Positions, StateLayer::Velocities, StateLayer::Accelerations})
    printLayer(scene, check, layer);
  if (!folder.empty()) {
    makeFolder(folder);
    Studio studio;
    Image image = studio.draw(statePicture(scene, check), scene.image);
    if (!check.faults.empty()) redden(image);
    writePng(folder + "/state.png", image);
    fmt::print("{}/state.png\n", folder);
  }
  return check.faults.empty() ? kOk : kFailed;
}

}  // namespace tumble
