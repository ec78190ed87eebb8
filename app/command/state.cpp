#include "app/command/state.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

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
    fmt::print("      forces at {} contact point{} hold what would close at up to {:.4g} m/s²",
               check.resting, check.resting == 1 ? "" : "s", -check.unheld);
  fmt::print("\n");
  for (const StateFault& fault : check.faults)
    if (fault.layer == layer) fmt::print("    {}\n", faultText(scene, fault));
}

void print(const Scene& scene, const StartCheck& check) {
  fmt::print("{}: the state at its start\n", scene.name);
  for (const StateLayer layer :
       {StateLayer::Positions, StateLayer::Velocities, StateLayer::Accelerations})
    printLayer(scene, check, layer);
}

nlohmann::ordered_json jsonOf(const Scene& scene, const StartCheck& check) {
  nlohmann::ordered_json faults = nlohmann::ordered_json::array();
  for (const StateFault& fault : check.faults)
    faults.push_back({{"layer", layerName(fault.layer)},
                      {"a", scene.world.bodies[fault.a].name},
                      {"b", scene.world.bodies[fault.b].name},
                      {"amount", fault.amount},
                      {"text", faultText(scene, fault)}});
  return {{"scene", scene.name},
          {"holds", check.faults.empty()},
          {"resting", check.resting},
          {"unheld", check.unheld},
          {"faults", std::move(faults)}};
}

}  // namespace

int checkState(const Scene& scene, const std::string& folder, nlohmann::ordered_json* json) {
  const StartCheck check = checkedStart(scene);
  if (json)
    json->push_back(jsonOf(scene, check));
  else
    print(scene, check);
  if (!folder.empty()) {
    makeFolder(folder);
    Studio studio;
    Image image = studio.draw(statePicture(scene, check), scene.image);
    if (!check.faults.empty()) redden(image);
    writePng(folder + "/state.png", image);
    if (!json) fmt::print("{}/state.png\n", folder);
  }
  return check.faults.empty() ? kOk : kFailed;
}

}  // namespace tumble
