#include "app/scene/settings.h"

#include <cmath>

#include "app/scene/choices.h"
#include "sim/ode/integrator.h"

namespace tumble {

namespace {

constexpr double kLongest = 1e6;             // [s] of a run
constexpr std::size_t kMostValues = 10'000;  // of a sweep

constexpr Range kStep{0.0, kLongest, true, "s"};

}  // namespace

void readTexts(Section& root, Scene& scene) {
  root.read("title", scene.title);
  root.read("subtitle", scene.subtitle);
  root.read("chapter", scene.chapter);
  root.read("claim", scene.claim);
  const Node* checks = root.find("checks");
  if (!checks) return;
  const Array* names = checks->as<Array>();
  if (!names) return root.complain("checks", "expected a list of strings");
  for (const Node& name : *names) {
    std::string text;
    if (readText(name, "checks", root.findings(), text)) scene.checks.push_back(text);
  }
}

void readWorld(Section& root, Scene& scene) {
  const Node* node = root.find("world");
  if (!node) return root.complain("world", "missing; a scene needs a [world] table");
  WorldDef& world = scene.world;
  Section section(*node, "world", root.findings(), "");
  section.read("gravity", world.gravity, any("m/s²"));
  section.read("method", world.method, methodChoices());
  section.read("impact", world.impact, impactChoices());
  section.read("duration", world.duration, {0.0, kLongest, true, "s"});
  if (const Node* seed = section.find("seed")) {
    const std::int64_t* number = seed->as<std::int64_t>();
    if (number && *number >= 0)
      scene.seed = static_cast<std::uint64_t>(*number);
    else
      section.complain("seed", "expected a whole number >= 0, found " + describe(*seed));
  }
  section.finish();
}

void readCourse(Section& root, CourseSettings& course) {
  const Node* node = root.find("course");
  if (!node) return;
  Section section(*node, "course", root.findings(), "course");
  section.read("integrator", course.integrator, integratorChoices());
  section.read("order", course.order, 1, kHighestOrder);
  section.read("attitude", course.attitude, attitudeChoices());
  section.read("step", course.step, kStep);
  section.read("plan", course.plan, planChoices());
  section.read("contact", course.contact, contactChoices());
  section.finish();
}

void readStepping(Section& root, SteppingSettings& stepping) {
  const Node* node = root.find("stepping");
  if (!node) return;
  Section section(*node, "stepping", root.findings(), "stepping");
  section.read("step", stepping.step, kStep);
  section.read("solver", stepping.solver, solverChoices());
  section.read("tolerance", stepping.tolerance, {0.0, 1.0, true, {}});
  section.finish();
}

void readCamera(Section& root, CameraView& camera) {
  const Node* node = root.find("camera");
  if (!node) return;
  Section section(*node, "camera", root.findings());
  section.read("eye", camera.eye, any("m"));
  section.read("target", camera.target, any("m"));
  section.read("azimuth", camera.azimuth, any("deg"));
  section.read("elevation", camera.elevation, {-89.0, 89.0, false, "deg"});
  double fov = camera.fov;
  section.read("fov", fov, any("deg"));
  if (fov > 1.0 && fov < 170.0)
    camera.fov = fov;
  else
    section.complain("fov", "expected an angle [deg] between 1 and 170");
  if (camera.eye && camera.target && (*camera.eye - *camera.target).norm() < 1e-9)
    section.complain("eye", "stands where the target is; move one of them");
  section.finish();
}

void readImage(Section& root, ImageFormat& image) {
  const Node* node = root.find("image");
  if (!node) return;
  Section section(*node, "image", root.findings());
  double size[2] = {static_cast<double>(image.width), static_cast<double>(image.height)};
  section.read("size", size, 2, {16.0, 16384.0, false, "pixels"});
  image.width = static_cast<int>(size[0]);
  image.height = static_cast<int>(size[1]);
  if (image.width != size[0] || image.height != size[1])
    section.complain("size", "expected whole numbers");
  section.read("rate", image.rate, {0.0, 1e5, true, "1/s"});
  section.read("antialias", image.antialias, {"none", "msaa4", "ssaa2x2"});
  section.finish();
}

void readShow(Section& root, ShowFlags& show) {
  const Node* node = root.find("show");
  if (!node) return;
  Section section(*node, "show", root.findings());
  section.read("path", show.path);
  section.read("theory", show.theory);
  section.read("contact_forces", show.contact_forces);
  section.read("normals", show.normals);
  section.read("velocities", show.velocities);
  section.read("forces", show.forces);
  section.read("impacts", show.impacts);
  section.read("labels", show.labels);
  section.read("boxes", show.boxes);
  section.read("samples", show.samples);
  section.read("planes", show.planes);
  section.read("energy", show.energy);
  section.read("glass", show.glass);
  section.read("strobe", show.strobe, positive("s"));
  section.finish();
}

void readSweep(Section& root, std::optional<Sweep>& sweep) {
  const Node* node = root.find("sweep");
  if (!node) return;
  Section section(*node, "sweep", root.findings());
  Sweep read;
  section.read("parameter", read.parameter);
  if (read.parameter.empty())
    section.complain("parameter", "expected a key, for example \"materials.rubber.restitution\"");
  const Node* values = section.find("values");
  const Array* list = values ? values->as<Array>() : nullptr;
  if (!list || list->empty() || list->size() > kMostValues)
    section.complain("values", "expected a list of 1 to 10000 values" +
                                   (values ? ", found " + describe(*values) : ""));
  section.finish();
  if (!section.good()) return;
  for (const Node& value : *list) read.values.push_back(toToml(value));
  sweep = read;
}

void readColour(Section& section, std::optional<Rgb>& colour) {
  if (!section.find("colour")) return;
  Rgb rgb{-1.0, 0.0, 0.0};
  section.read("colour", rgb.data(), 3, kShare);
  if (rgb[0] >= 0.0) colour = rgb;
}

}  // namespace tumble
