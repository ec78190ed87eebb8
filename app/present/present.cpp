#include "app/present/present.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/claim/free_body.h"
#include "app/present/arrows.h"
#include "app/present/bodies.h"
#include "app/present/marks.h"
#include "app/present/palette.h"

namespace tumble {

namespace {

double aspectOf(const Scene& scene) {
  return static_cast<double>(scene.image.width) / static_cast<double>(scene.image.height);
}

// Room for the title above, and for what stands beside the bodies.
Margins marginsOf(const Scene& scene) {
  const bool named =
      scene.show.labels || std::any_of(scene.labels.begin(), scene.labels.end(),
                                       [](const std::string& s) { return !s.empty(); });
  Margins margins{.left = 0.06, .right = named ? 0.10 : 0.06, .top = 0.14, .bottom = 0.14};
  if (scene.show.contact_forces)
    margins = {.left = 0.08, .right = 0.40, .top = 0.12, .bottom = 0.08};
  return margins;
}

Camera cameraOf(const Scene& scene, std::span<const Eigen::Vector3d> points) {
  const CameraView& view = scene.camera;
  Camera camera =
      frame(points, view.azimuth, view.elevation, view.fov, aspectOf(scene), marginsOf(scene));
  if (view.eye) camera.eye = *view.eye;
  if (view.target) camera.target = *view.target;
  return camera;
}

}  // namespace

Presenter::Presenter(const Scene& scene, const Recording& recording)
    : scene_(scene), recording_(recording), colours_(bodyColours(scene)) {
  const std::vector<Eigen::Vector3d> points = motionPoints(scene, recording);
  camera_ = cameraOf(scene, points);
  Eigen::Vector3d low = points.front(), high = points.front();
  for (const Eigen::Vector3d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  centre_ = 0.5 * (low + high);
  radius_ = 0.5 * (high - low).norm();
  if (!scene.show.theory) return;
  for (const std::string& name : scene.checks) {
    const Check* check = findCheck(name);
    if (!check || !check->expected) continue;
    for (Curve& curve : check->expected(scene, recording)) theory_.push_back(std::move(curve));
  }
}

int Presenter::count() const {
  return static_cast<int>(recording_.samples.size());
}

Picture Presenter::image(int k) const {
  const Sample& sample = recording_.samples[static_cast<std::size_t>(k)];
  Picture picture = blank();
  addBodies(sample, picture);
  addPaths(static_cast<std::size_t>(k), picture);
  addTheory(picture);
  addLabels(sample, picture);
  addAnnotations(sample, picture);
  picture.subtitle +=
      fmt::format("{}t = {:.2f} s", picture.subtitle.empty() ? "" : "   ", sample.t);
  if (scene_.show.energy)
    picture.subtitle += fmt::format("   energy {:.4g} J", sample.kinetic + sample.potential);
  return picture;
}

Picture Presenter::still(double t) const {
  const long k = std::lround(t * recording_.rate);
  return image(static_cast<int>(std::clamp<long>(k, 0, count() - 1)));
}

Picture Presenter::strobe() const {
  const Sample& last = recording_.samples.back();
  Picture picture = blank();
  addGhosts(picture);
  addBodies(last, picture);
  addPaths(recording_.samples.size() - 1, picture);
  addTheory(picture);
  addLabels(last, picture);
  addAnnotations(last, picture);
  picture.subtitle += fmt::format("{}Strobe every {:g} s over {:g} s.",
                                  picture.subtitle.empty() ? "" : "  ", scene_.show.strobe, last.t);
  return picture;
}

// Page, floor and camera, without anything on them.
Picture Presenter::blank() const {
  Picture picture;
  picture.camera = camera_;
  picture.centre = centre_;
  picture.radius = radius_;
  picture.title = scene_.title;
  picture.subtitle = scene_.subtitle;
  picture.floor.visible = false;
  for (const BodyDef& body : scene_.world.bodies) {
    if (!isFloor(body) || picture.floor.visible) continue;
    picture.floor.visible = true;
    picture.floor.height = std::get<HalfSpace>(body.shape).d;
  }
  picture.floor.grid = radius_ < 0.8 ? 0.1 : radius_ < 15.0 ? 1.0 : 10.0;
  picture.floor.fineGrid = 0.2 * picture.floor.grid;
  return picture;
}

void Presenter::addBodies(const Sample& sample, Picture& picture) const {
  const bool byTime = picture.bar.has_value();
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodyDef& body = scene_.world.bodies[i];
    if (isFloor(body)) continue;
    const Colour colour = byTime && moves(body) ? timeStops().back() : colours_[i];
    Instance instance =
        instanceOf(body, sample.bodies[i].x, sample.bodies[i].q, colour, centre_, 3.0 * radius_);
    if (scene_.show.glass && moves(body)) instance.finish = Finish::Glass;
    picture.instances.push_back(instance);
  }
}

// A single body is coloured by time, several keep their colours; all are paler the longer ago.
void Presenter::addGhosts(Picture& picture) const {
  const bool single = movingCount(scene_) == 1;
  const double end = recording_.samples.back().t;
  const long every = std::max(1L, std::lround(scene_.show.strobe * recording_.rate));
  for (std::size_t k = 0; k + 1 < recording_.samples.size(); k += static_cast<std::size_t>(every)) {
    const Sample& sample = recording_.samples[k];
    const double u = end > 0.0 ? sample.t / end : 1.0;
    for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
      const BodyDef& body = scene_.world.bodies[i];
      if (!moves(body)) continue;
      const Colour colour = single ? ramp(timeStops(), u) : colours_[i];
      Instance ghost =
          instanceOf(body, sample.bodies[i].x, sample.bodies[i].q, colour, centre_, radius_);
      ghost.finish = Finish::Ghost;
      ghost.alpha = static_cast<float>(single ? 0.55 + 0.35 * u : 0.22 + 0.48 * u);
      picture.instances.push_back(ghost);
    }
    if (scene_.show.forces && (k / static_cast<std::size_t>(every)) % 5 == 0)
      addForces(scene_, sample, typicalHeight(scene_), picture);
  }
  if (!single) return;
  ColourBar bar{"time / s", {timeStops().begin(), timeStops().end()}, 0.0, end, {}};
  const double tick = end > 20.0 ? 10.0 : end > 8.0 ? 2.0 : end > 1.5 ? 1.0 : 0.2;
  for (int n = 0; n * tick <= end; ++n) bar.ticks.push_back(n * tick);
  picture.bar = bar;
}

// Through the samples, and through the centre of mass at each hit between them.
void Presenter::addPaths(std::size_t last, Picture& picture) const {
  if (!scene_.show.path) return;
  const bool single = movingCount(scene_) == 1;
  for (std::size_t i = 0; i < scene_.world.bodies.size(); ++i) {
    if (!moves(scene_.world.bodies[i])) continue;
    Polyline line;
    line.colour = single ? colour::kInk : shade(colours_[i], 0.8f);
    auto event = recording_.report.events.begin();
    for (std::size_t k = 0; k <= last; ++k) {
      const Sample& sample = recording_.samples[k];
      for (; event != recording_.report.events.end() && event->t <= sample.t; ++event) {
        if (k == 0 || (event->a != static_cast<int>(i) && event->b != static_cast<int>(i)))
          continue;
        const Sample& before = recording_.samples[k - 1];
        const double s = event->t - before.t;
        line.points.push_back(before.bodies[i].x + s * before.bodies[i].v +
                              0.5 * s * s * scene_.world.gravity);
        break;
      }
      while (event != recording_.report.events.end() && event->t <= sample.t) ++event;
      line.points.push_back(sample.bodies[i].x);
    }
    if (line.points.size() > 1) picture.lines.push_back(std::move(line));
  }
}

void Presenter::addTheory(Picture& picture) const {
  for (const Curve& curve : theory_) {
    Polyline line;
    line.points.assign(curve.points.begin(), curve.points.end());
    line.colour = colour::kForce;
    line.stroke = Stroke::Dotted;
    picture.lines.push_back(std::move(line));
  }
}

void Presenter::addLabels(const Sample& sample, Picture& picture) const {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodyDef& body = scene_.world.bodies[i];
    std::string text = i < scene_.labels.size() ? scene_.labels[i] : "";
    if (text.empty() && scene_.show.labels && moves(body)) text = body.name;
    if (text.empty()) continue;
    Label label;
    label.anchor = sample.bodies[i].x + Vec3(boundingRadius(body.shape), 0.0, 0.0);
    label.offset = {8.0, 5.0};
    label.text = text;
    picture.labels.push_back(label);
  }
}

void Presenter::addAnnotations(const Sample& sample, Picture& picture) const {
  const ShowFlags& show = scene_.show;
  const double height = typicalHeight(scene_);
  const double length = 0.44 * height;
  if (show.contact_forces) {
    addContactForces(sample, largestContactForce(recording_), length, picture);
    addForceLadder(scene_, sample, aspectOf(scene_), picture);
  }
  if (show.normals) addNormals(sample, length, picture);
  if (show.velocities) addVelocities(scene_, recording_, sample, 2.0 * height, picture);
  if (show.forces) addForces(scene_, sample, height, picture);
  if (show.impacts) addImpacts(recording_, sample.t, aspectOf(scene_), picture);
}

}  // namespace tumble
