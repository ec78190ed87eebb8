#include "app/present/state_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/present/arrows.h"
#include "app/present/bodies.h"
#include "app/present/named.h"
#include "app/present/palette.h"
#include "app/present/present.h"
#include "app/record/bodies.h"

namespace tumble {

namespace {

constexpr std::size_t kMostRings = 6;

std::string heading(const std::vector<StateFault>& faults) {
  if (faults.empty()) return "positions, velocities and accelerations are ok";
  std::string layer = layerName(faults.front().layer);
  std::transform(layer.begin(), layer.end(), layer.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return layer + " NOT OK";
}

Label pageLabel(double y, const std::string& text, float size, const Colour& colour) {
  Label label;
  label.offset = {32.0, y};
  label.text = text;
  label.size = size;
  label.bold = true;
  label.colour = colour;
  return label;
}

// The points, and as much room again around them, for arrows.
std::vector<Eigen::Vector3d> withRoom(std::vector<Eigen::Vector3d> points) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) middle += point / static_cast<double>(points.size());
  for (Eigen::Vector3d& point : points) point = middle + 1.8 * (point - middle);
  return points;
}

// One ring for faults at the same place.
void addRing(const StateFault& fault, Picture& picture) {
  for (Mark& mark : picture.marks)
    if ((mark.position - fault.p).isZero(0.0)) {
      mark.lines.emplace_back(layerName(fault.layer));
      return;
    }
  picture.marks.push_back({fault.p, {layerName(fault.layer)}, colour::kForce});
}

// Weights on the scale of the contact forces, which they hold in balance, and the names of these.
void addWeights(const Scene& scene, const Recording& recording, Picture& picture) {
  const double metres = 1.3 * typicalHeight(scene) / largestContactForce(recording);
  for (const ContactSample& contact : recording.samples.front().contacts)
    addNamedArrow(contact.p, metres * contact.force, colour::kForce, "f n", picture);
  for (std::size_t i = 0; i < scene.world.bodies.size(); ++i)
    if (const BodyDef& body = scene.world.bodies[i]; moves(body))
      addNamedArrow(recording.samples.front().bodies[i].x,
                    metres * bodyMass(body) * scene.world.gravity, colour::kInk, "m g", picture);
}

}  // namespace

StartCheck checkedStart(const Scene& scene) {
  try {
    return World::checkStart(scene.world);
  } catch (const Refusal& refusal) {
    throw SceneError({locate(scene, refusal)});
  }
}

std::string faultText(const Scene& scene, const StateFault& fault) {
  const std::string &a = scene.world.bodies[fault.a].name, &b = scene.world.bodies[fault.b].name;
  if (fault.layer == StateLayer::Positions)
    return fmt::format("\"{}\" is {:.4g} m inside \"{}\"", a, -fault.amount, b);
  if (fault.layer == StateLayer::Velocities)
    return fmt::format("\"{}\" moves into \"{}\" at {:.4g} m/s", a, b, -fault.amount);
  return fmt::format("\"{}\" accelerates into \"{}\" at {:.4g} m/s²", a, b, -fault.amount);
}

Picture statePicture(const Scene& scene, const StartCheck& check, double top) {
  Recording recording;
  recording.samples = {check.sample};
  recording.rate = scene.image.rate;
  Scene plain = scene;
  plain.subtitle = "The state at its start.";
  // Claims are about motions.
  plain.checks.clear();
  plain.expects.clear();
  const bool held = check.faults.empty() && check.resting > 0;
  plain.show.contact_forces = false;
  const std::vector<Eigen::Vector3d> points = withRoom(motionPoints(plain, recording));
  Picture picture = Presenter(plain, recording, framingOf(plain, points)).image(0);
  if (!plain.show.contact_velocities)
    addVelocities(plain, check.sample, fastestOf(plain, recording), 0.6 * typicalHeight(plain),
                  picture);
  if (held) addWeights(plain, recording, picture);
  picture.labels.push_back(pageLabel(top, heading(check.faults), 20.0f,
                                     check.faults.empty() ? colour::kInk : colour::kForce));
  double y = top + 24.0;
  for (std::size_t i = 0; i < std::min(check.faults.size(), kMostRings); ++i, y += 22.0) {
    Label line = pageLabel(y, faultText(scene, check.faults[i]), 14.0f, colour::kInk);
    line.bold = false;
    picture.labels.push_back(line);
    addRing(check.faults[i], picture);
  }
  return picture;
}

void redden(Image& image) {
  constexpr int kRed = 0xD5, kGreen = 0x40, kBlue = 0x1A;
  const int frame = std::max(4, image.height / 90);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      std::uint8_t* pixel = &image.rgb[3u * (static_cast<std::size_t>(y) * image.width + x)];
      const bool border =
          x < frame || y < frame || x >= image.width - frame || y >= image.height - frame;
      const std::array<int, 3> red = {kRed, kGreen, kBlue};
      // A tenth of red over everything, the border all of it.
      for (int c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>(border ? red[c] : (9 * pixel[c] + red[c] + 5) / 10);
    }
}

}  // namespace tumble
