// This program itself, through the same door.
#include <cmath>

#include "app/record/recording.h"
#include "sim/problem/problem.h"
#include "tests/peers/engine.h"

namespace tumble::peers {

namespace {

class Tumble : public Engine {
 public:
  Tumble(const Scene& scene, double h) : world_(makeWorld(scene)), h_(h) {}

  void step() override { world_.advance(++steps_ * h_); }
  void read(std::vector<BodySample>& bodies) const override {
    bodies = world_.sample(steps_ * h_).bodies;
  }

 private:
  World world_;
  double h_;
  long steps_ = 0;
};

// A method with its own clock, asked 60 times a second, or once for the end.
EngineSetup asked(const std::string& method, bool once) {
  EngineSetup setup{"tumble", method + (once ? ", once" : "")};
  setup.why = once ? "asked for the end alone" : "nothing is set; asked 60 times a second";
  setup.asItComes = method == "auto" && !once;
  // In crowds events have no end, and a look more or less costs nothing.
  if (method == "exact" || once) setup.meant = Meant::FewMove;
  setup.stepless = true;
  setup.askedOnce = once;
  setup.make = [method](const Scene& scene, double h) {
    Scene own = scene;
    own.world.method = method;
    return std::make_unique<Tumble>(own, h);
  };
  return setup;
}

EngineSetup stepping(const SolverPreset& preset) {
  EngineSetup setup{"tumble", "stepping " + std::string(preset.name), std::string(preset.summary)};
  setup.make = [&preset](const Scene& scene, double h) {
    Scene own = scene;
    own.world.method = "stepping";
    own.world.stepping.step = h;
    own.world.stepping.take(preset);
    return std::make_unique<Tumble>(own, h);
  };
  return setup;
}

}  // namespace

std::vector<EngineSetup> tumbleSetups() {
  std::vector<EngineSetup> setups = {asked("auto", false), asked("auto", true),
                                     asked("exact", false), asked("exact", true)};
  for (const SolverPreset& preset : solverPresets()) setups.push_back(stepping(preset));
  return setups;
}

}  // namespace tumble::peers
