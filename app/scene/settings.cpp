#include "app/scene/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/scene/choices.h"
#include "app/scene/findings.h"
#include "sim/ode/integrator.h"
#include "sim/problem/problem.h"

namespace tumble {

namespace {

constexpr double kLongest = 1e6;  // [s] of a run

constexpr Range kStep{0.0, kLongest, true, "s"};

void readKeys(Section& section, CourseSettings& course) {
  section.read("integrator", course.integrator, integratorChoices());
  section.read("order", course.order, 1, kHighestOrder);
  section.read("tolerance", course.tolerance, {kLeastTolerance, 1.0, false, {}});
  section.read("attitude", course.attitude, attitudeChoices());
  section.read("step", course.step, kStep);
  section.read("plan", course.plan, planChoices());
  section.read("repair_steps", course.repairSteps, 1, 1'000'000);
  section.read("contact", course.contact, contactChoices());
  section.read("stiffness", course.stiffness, positive("N/m"));
  section.read("damping", course.damping, notNegative("N s/m"));
}

void readKeys(Section& section, SteppingSettings& stepping) {
  section.read("step", stepping.step, kStep);
  std::string preset = "auto";
  section.read("preset", preset, presetChoices());
  stepping.take(*findSolverPreset(preset));
  section.read("solver", stepping.solver, solverChoices());
  section.read("tolerance", stepping.tolerance, {0.0, 1.0, true, {}});
  if (section.find("solver") || section.find("tolerance")) stepping.treatCrowdsAlike();
  section.read("linearisations", stepping.linearisations, 1, 1000);
  section.read("points", stepping.points, pointPlanChoices());
}

/// Notes for each key of a method's table that it stands there.
template <class Settings>
void noteKeys(const std::string& table, Elsewhere& elsewhere) {
  const Node empty{{}, Table{}};
  Findings unheard({""});
  Section section(empty, table, unheard);
  Settings ignored;
  readKeys(section, ignored);
  for (const std::string_view key : section.asked()) {
    std::string& advice = elsewhere[std::string(key)];
    advice +=
        (advice.empty() ? "set " : ", or ") + section.path(key) + " for method '" + table + "'";
  }
}

/// One of the methods; whoever names an integrator instead is told where that belongs.
void readMethod(Section& section, std::string& method) {
  const std::vector<std::string> integrators = integratorChoices();
  const Node* node = section.find("method");
  const std::string* word = node ? node->as<std::string>() : nullptr;
  if (!word || std::find(integrators.begin(), integrators.end(), *word) == integrators.end())
    return section.read("method", method, methodChoices());
  section.complain("method", "'" + *word + "' is an integrator: set world.method = 'course' and " +
                                 "course.integrator = '" + *word + "'");
}

}  // namespace

void readTexts(Section& root, Scene& scene) {
  root.read("title", scene.title);
  root.read("subtitle", scene.subtitle);
  root.read("chapter", scene.chapter);
  root.read("claim", scene.claim);
  root.read("checks", scene.checks);
  root.read("slides", scene.slides);
  const Node* checks = root.find("checks");
  const Array* names = checks ? checks->as<Array>() : nullptr;
  for (std::size_t i = 0; names && i < names->size(); ++i)
    root.findings().note("checks[" + std::to_string(i) + "]", (*names)[i].spot);
}

void readWorld(Section& root, Scene& scene) {
  const Node* node = root.find("world");
  if (!node) return root.complain("world", "missing; a scene needs a [world] table");
  WorldDef& world = scene.world;
  Section section(*node, "world", root.findings(), "");
  section.read("gravity", world.gravity, any("m/s²"));
  readMethod(section, world.method);
  section.read("impact", world.impact, impactChoices());
  section.read("duration", world.duration, {0.0, kLongest, true, "s"});
  if (const Node* seed = section.find("seed")) {
    const std::int64_t* number = seed->as<std::int64_t>();
    if (number && *number >= 0)
      scene.seed = static_cast<std::uint64_t>(*number);
    else
      section.complain("seed", "expected a whole number >= 0, found " + describe(*seed));
  }
  Elsewhere methods;
  noteKeys<CourseSettings>("course", methods);
  noteKeys<SteppingSettings>("stepping", methods);
  section.finish(methods);
}

void readCourse(Section& root, CourseSettings& course) {
  const Node* node = root.find("course");
  if (!node) return;
  Section section(*node, "course", root.findings(), "course");
  readKeys(section, course);
  section.finish();
}

void readStepping(Section& root, WorldDef& world) {
  constexpr double kLeast = 24.0;  // steps in a run
  SteppingSettings& stepping = world.stepping;
  stepping.step = std::min(stepping.step, world.duration / kLeast);
  const Node* node = root.find("stepping");
  if (!node) return;
  Section section(*node, "stepping", root.findings(), "stepping");
  readKeys(section, stepping);
  section.finish();
}

void readImage(Section& root, ImageFormat& image) {
  const Node* node = root.find("image");
  if (!node) return;
  Section section(*node, "image", root.findings());
  double size[2] = {static_cast<double>(image.width), static_cast<double>(image.height)};
  section.read("size", size, 2, {16.0, 8192.0, false, "pixels"});
  image.width = static_cast<int>(size[0]);
  image.height = static_cast<int>(size[1]);
  if (image.width != size[0] || image.height != size[1])
    section.complain("size",
                     fmt::format("expected whole numbers, found {:g} and {:g}", size[0], size[1]));
  section.read("rate", image.rate, {0.0, 1e5, true, "1/s"});
  section.read("still", image.still, notNegative("s"));
  section.read("antialias", image.antialias, {"none", "msaa4", "ssaa2x2"});
  section.read("quality", image.quality, {"low", "normal", "high"});
  std::string background = "page";
  section.read("background", background, {"page", "transparent"});
  image.transparent = background == "transparent";
  section.finish();
}

constexpr int kDeepestTree = 100;

void readShow(Section& root, ShowFlags& show) {
  const Node* node = root.find("show");
  if (!node) return;
  Section section(*node, "show", root.findings());
  section.read("floor", show.floor);
  section.read("ruler", show.ruler);
  section.read("title", show.title);
  section.read("path", show.path);
  section.read("theory", show.theory);
  section.read("contact_forces", show.contact_forces);
  section.read("ladder", show.ladder);
  section.read("matrix", show.matrix);
  section.read("either_or", show.either_or);
  section.read("joint_forces", show.joint_forces);
  section.read("force_scale", show.force_scale, positive("m/N"));
  section.read("normals", show.normals);
  section.read("velocities", show.velocities);
  section.read("forces", show.forces);
  section.read("impacts", show.impacts);
  section.read("labels", show.labels);
  section.read("boxes", show.boxes);
  section.read("tree", show.tree, 0, kDeepestTree);
  section.read("samples", show.samples);
  section.read("planes", show.planes);
  section.read("energy", show.energy);
  section.read("glass", show.glass);
  section.read("ellipsoid", show.ellipsoid);
  section.read("polhode", show.polhode);
  section.read("body_box", show.body_box);
  section.read("speed", show.speed);
  section.read("strain", show.strain);
  section.read("momenta", show.momenta);
  section.read("missteps", show.missteps);
  section.read("motion", show.motion);
  section.read("field", show.field);
  section.read("axes", show.axes);
  section.read("tensors", show.tensors);
  section.read("centres", show.centres);
  section.read("resultant", show.resultant);
  section.read("contact_velocities", show.contact_velocities);
  section.read("impulses", show.impulses);
  section.read("springs", show.springs);
  section.read("gel", show.gel, notNegative("m"));
  std::string diagram = show.diagram.empty() ? "none" : show.diagram;
  section.read("diagram", diagram, {"none", "state", "solver", "flow"});
  show.diagram = diagram == "none" ? "" : diagram;
  section.read("slots", show.slots);
  const std::vector<std::string> slots = {"x", "v", "R", "P", "L", "?"};
  for (const std::string& slot : show.slots)
    if (std::find(slots.begin(), slots.end(), slot) == slots.end())
      section.complain("slots", "found '" + slot + "'" + hint(slot, slots));
  section.read("strobe", show.strobe, positive("s"));
  section.finish();
}

void readColour(Section& section, std::string_view key, std::optional<Rgb>& colour) {
  if (!section.find(key)) return;
  Rgb rgb{-1.0, 0.0, 0.0};
  section.read(key, rgb.data(), 3, kShare);
  if (rgb[0] >= 0.0) colour = rgb;
}

}  // namespace tumble
