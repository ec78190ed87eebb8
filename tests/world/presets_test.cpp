// Worlds that step with each preset of the table of solvers.
#include "sim/problem/problem.h"
#include "tests/catch.h"
#include "tests/world/scenes.h"

using namespace tumble;
using namespace tumble::scenes;

// Oracle: closed form, ½ a t²: only the first step errs by more than the square of a step; and the
// certificate is held to what the preset says of contacts at rest.
// Measured: way 8.7e-7 m, allowed 1e-6; 2.1e-4 if the velocities of the ends of steps moved it.
// Momentum below 1e-12.
TEST_CASE("a stack is pulled along by every preset, and the certificate has what each leaves") {
  constexpr double kPull = 0.1;  // m/s²
  for (const SolverPreset& preset : solverPresets()) {
    WorldDef def = stackOf(3, 4, 3, true, 0.0, kPull);
    def.duration = 1.0;
    def.stepping.take(preset);
    World world(def);
    const Sample end = run(world);
    const Report& report = world.report();
    const double worst = report.certificate.max_complementarity;
    CAPTURE(preset.name, worst);
    CHECK_FALSE(report.stopped);
    CHECK(worst <= preset.settings.tolerance);
    CHECK(report.notes.empty());
    CHECK(report.certificate.momentum_error < 1e-12);
    const Vec3 due(0.5 * kPull * def.duration * def.duration, 0.0, 0.0);
    double way = 0.0;
    for (std::size_t i = 1; i < end.bodies.size(); ++i)
      way = std::max(way, (end.bodies[i].x - def.bodies[i].position - due).norm());
    CHECK(way < 1e-6);
  }
}
