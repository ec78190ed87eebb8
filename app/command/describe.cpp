// tumble describe: what a scene contains and what it uses.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/command/command.h"
#include "app/command/options.h"
#include "app/command/run.h"
#include "app/record/recording.h"
#include "sim/body/principal_axes.h"
#include "sim/shape/pieces.h"

namespace tumble::command {

namespace {

std::string join(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
  return line.empty() ? "none" : line;
}

// "11 sphere, 11 box, 1 half-space"
std::string countShapes(const Scene& scene) {
  std::map<std::string_view, int> counts;
  for (const BodyDef& body : scene.world.bodies) ++counts[shapeName(body.shape)];
  std::vector<std::string> words;
  for (const auto& [name, count] : counts) words.push_back(fmt::format("{} {}", count, name));
  return join(words);
}

// "course, rk4 at 0.00416667 s, 5 s"
// What differs from going back to collisions and giving impulses.
std::string strategyOf(const CourseSettings& course) {
  if (course.contact == "penalty")
    return fmt::format(", penalty springs of {:g} N/m, {:g} N s/m", course.stiffness,
                       course.damping);
  return course.plan == "backstep" ? "" : ", plan " + course.plan;
}

std::string strategyOf(const SteppingSettings& stepping) {
  return stepping.points == SteppingSettings().points ? "" : ", points by " + stepping.points;
}

std::string methodLine(const WorldDef& world, const World& running) {
  std::string steps;
  if (running.runs() == "course")
    steps = fmt::format(", {} at {:g} s{}", world.course.integrator, world.course.step,
                        strategyOf(world.course));
  if (running.runs() == "exact" && !world.joints.empty())
    steps = ", all bodies in steps of extrapolation: those with joints fly in no closed form";
  if (running.runs() == "stepping")
    steps = fmt::format(", {} at {:g} s{}", world.stepping.solver, world.stepping.step,
                        strategyOf(world.stepping));
  return fmt::format("{}{}, {:g} s", running.method(), steps, world.duration);
}

// "bends     cloth: 361 points, 1083 unknowns, 2016 energies (spring, cloth shear), 0.2 kg"
void printBent(const Scene& scene) {
  for (const BentDef& bent : scene.bent) {
    double mass = 0.0;
    int moving = 0;
    for (int i = bent.first; i < bent.first + bent.count; ++i) {
      mass += bodyMass(scene.world.bodies[i]);
      moving += !scene.world.bodies[i].fixed;
    }
    std::size_t energies = 0;
    std::set<std::size_t> kinds;
    for (const Force& force : scene.world.forces) {
      const Bending* bending = std::get_if<Bending>(&force);
      const int first = bending ? bending->body->bodies.front() : -1;
      if (first < bent.first || first >= bent.first + bent.count) continue;
      energies += bending->body->elements.size();
      for (const Element& element : bending->body->elements) kinds.insert(element.energy.index());
    }
    std::vector<std::string> names;
    for (const std::size_t kind : kinds) names.emplace_back(energyKinds()[kind].name);
    const std::string strands =
        bent.strand > 0 ? fmt::format("{} strands, ", bent.count / bent.strand) : "";
    fmt::print("bends     {}: {}{} points, {} unknowns, {} energies ({}), {:g} kg\n", bent.name,
               strands, bent.count, 3 * moving, energies, join(names), mass);
  }
}

// "pieces    ring: 58 convex, 1.2e-06 m out of the mesh at most, 3.4e-06 m over each other"; of a
// long list the beginning.
void printPieces(const WorldDef& world) {
  constexpr int kMost = 12;
  int count = 0;
  for (const BodyDef& body : world.bodies) {
    const Mesh* mesh = std::get_if<Mesh>(&body.shape);
    if (!mesh || ++count > kMost) continue;
    fmt::print("pieces    {}: {} convex, {:.2g} m out of the mesh, {:.2g} m over each other\n",
               body.name, mesh->pieces->hulls.size(), mesh->pieces->excess, mesh->pieces->slack);
  }
  if (count > kMost) fmt::print("pieces    and {} more meshes\n", count - kMost);
}

// Three numbers; beside `scale` rounding is nothing.
std::string numbers(const Vec3& v, double scale) {
  std::string line;
  for (const double x : v) line += fmt::format(" {:>12.6g}", std::abs(x) < 1e-13 * scale ? 0.0 : x);
  return line;
}

// "joint     hinge: a hinge of plank on the world, from -30 to 60 degrees"; of a long list the
// beginning.
void printJoints(const WorldDef& world) {
  constexpr std::size_t kMost = 12;
  constexpr double kDegrees = 180.0 / 3.14159265358979323846;
  for (std::size_t k = 0; k < std::min(kMost, world.joints.size()); ++k) {
    const JointDef& joint = world.joints[k];
    const bool turns = joint.kind == JointKind::Hinge;
    const double unit = turns ? kDegrees : 1.0;
    std::string limits;
    if (std::isfinite(joint.lo)) limits += fmt::format(" from {:g}", unit * joint.lo);
    if (std::isfinite(joint.hi)) limits += fmt::format(" to {:g}", unit * joint.hi);
    if (!limits.empty()) limits = "," + limits + (turns ? " degrees" : " m");
    fmt::print("joint     {}: {}, {} on {}{}{}\n", joint.name, jointName(joint.kind).name,
               world.bodies[joint.a].name,
               joint.b == kNoBody ? "the world" : world.bodies[joint.b].name, limits,
               joint.collide ? ", they may touch" : "");
  }
  if (world.joints.size() > kMost)
    fmt::print("joint     and {} more\n", world.joints.size() - kMost);
}

// What each body weighs, in the order of the scene; of a long list the beginning.
void printMasses(const Scene& scene) {
  constexpr int kMost = 12;
  int count = 0;
  for (const BodyDef& body : scene.world.bodies) {
    const bool solid = !std::holds_alternative<HalfSpace>(body.shape) &&
                       !std::holds_alternative<Particle>(body.shape);
    if (!solid || bodyMass(body) == 0.0) continue;
    if (++count > kMost) continue;
    if (count == 1)
      fmt::print("weighs    mass / kg; inertia / (kg m²) about the centre of mass, body frame\n");
    const MassProperties found = massOf(body);
    const Mat3& I = found.inertia;
    const double size = I.norm();
    fmt::print("  {}: {:g} kg, by {}\n", body.name, found.mass,
               body.inertia ? "the scene" : body.inertiaBy);
    fmt::print("    Ixx Iyy Izz  {}\n", numbers(I.diagonal(), size));
    const Vec3 products(I(0, 1), I(0, 2), I(1, 2));
    if (products.norm() < 1e-13 * size) continue;
    const PrincipalAxes principal = principalAxes(I);
    fmt::print("    Ixy Ixz Iyz  {}\n", numbers(products, size));
    fmt::print("    principal    {}\n", numbers(principal.moments, size));
    for (int axis = 0; axis < 3; ++axis)
      fmt::print("    axis {}       {}\n", axis + 1, numbers(principal.axes.col(axis), 1.0));
  }
  if (count > kMost) fmt::print("  and {} more\n", count - kMost);
}

}  // namespace

int describe(int argc, char** argv) {
  SceneOptions options;
  CommandLine line("describe", "What a scene contains, uses and claims.",
                   {"path-of-brick", "my-scene.toml --set world.method=stepping"});
  addSceneOptions(line, options);
  if (!line.read(argc, argv)) return kOk;

  const Scene scene = load(options);
  const WorldDef& world = scene.world;
  fmt::print("{}: {}\n", scene.name, scene.title);
  if (!scene.claim.empty()) fmt::print("claim     {}\n", scene.claim);
  fmt::print("checks    {}\n", join(scene.checks));
  fmt::print("bodies    {}: {}\n", world.bodies.size(), countShapes(scene));
  fmt::print("forces    {}\n", world.forces.size());
  printJoints(world);
  fmt::print("gravity   {:g} {:g} {:g} m/s²\n", world.gravity.x(), world.gravity.y(),
             world.gravity.z());
  const World running = makeWorld(scene);
  fmt::print("method    {}\n", methodLine(world, running));
  noteUnused(scene, running.runs());
  fmt::print("uses      {}\n", join(running.features()));
  fmt::print("without   {}\n", join(running.features(false)));
  printPieces(world);
  printBent(scene);
  printMasses(scene);
  for (const PanelDef& panel : scene.panels) fmt::print("panel     {}\n", panel.variant.title);
  for (const GraphDef& graph : scene.graphs)
    fmt::print("graph     {}: {}{}, {} curves\n", graph.variant.title, graph.shows,
               graph.body.empty() ? "" : " of " + graph.body, graph.curves.size());
  for (const ChartDef& chart : scene.charts)
    fmt::print("chart     {}: {} along {}, {} curves\n", chart.variant.title, chart.error,
               chart.along.parameter, chart.curves.size());
  if (scene.sweep)
    fmt::print("sweep     {} over {}\n", scene.sweep->parameter, join(scene.sweep->values));
  return kOk;
}

}  // namespace tumble::command
