#include "app/present/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/claim/free_body.h"
#include "app/present/bent.h"
#include "render/camera.h"

namespace tumble {

namespace {

constexpr std::array<double, 2> kBeside = {8.0, 5.0};  // [px] from what a text goes with

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

// What bends has one name, beside its point furthest to the right.
void addNamesOfBent(const Scene& scene, const Sample& sample, const Vec3& right, Picture& picture) {
  for (const BentDef& bent : scene.bent) {
    const auto first = sample.bodies.begin() + bent.first;
    const auto furthest = std::max_element(
        first, first + bent.count,
        [&](const BodySample& a, const BodySample& b) { return right.dot(a.x) < right.dot(b.x); });
    Label& label = picture.labels.emplace_back();
    label.anchor = furthest->x;
    label.apart = true;
    label.offset = {kBeside[0], kBeside[1]};
    label.text = bent.name;
  }
}

}  // namespace

std::string labelOf(const Scene& scene, int index) {
  const std::size_t i = static_cast<std::size_t>(index);
  const BodyDef& body = scene.world.bodies[i];
  std::string text = i < scene.labels.size() ? scene.labels[i] : "";
  if (text.empty() && scene.show.labels && moves(body) && !isPoint(scene, index)) text = body.name;
  if (text.find('{') == std::string::npos) return text;

  replaceAll(text, "{name}", body.name);
  const Surface surface = actingSurface(scene.world, index);
  replaceAll(text, "{restitution}", fmt::format("{:.3g}", surface.restitution));
  replaceAll(text, "{friction}", fmt::format("{:.3g}", surface.friction));
  if (body.density) replaceAll(text, "{density}", fmt::format("{:.4g}", *body.density));
  if (moves(body)) replaceAll(text, "{mass}", fmt::format("{:.4g}", bodyMass(body)));
  return text;
}

void addLabels(const Scene& scene, const Sample& sample, Picture& picture) {
  const Vec3 right = Projection(picture.camera, 1.0, 1.0).right();
  for (int i = 0; i < static_cast<int>(sample.bodies.size()); ++i) {
    const std::string text = labelOf(scene, i);
    if (text.empty()) continue;
    const BodySample& body = sample.bodies[static_cast<std::size_t>(i)];
    const BodyDef& def = scene.world.bodies[static_cast<std::size_t>(i)];
    Label label;
    label.anchor = body.x + reach(def.shape, body.q, right) * right;
    label.apart = true;
    if (text == def.name) label.names = body.x;
    label.offset = {kBeside[0], kBeside[1]};
    label.text = text;
    picture.labels.push_back(label);
  }
  if (scene.show.labels) addNamesOfBent(scene, sample, right, picture);
}

void addTexts(const Scene& scene, const Sample& sample, Picture& picture) {
  const Vec3 right = Projection(picture.camera, 1.0, 1.0).right();
  for (const TextDef& def : scene.texts) {
    if (sample.t < def.from || sample.t > def.until) continue;
    Label label;
    label.anchor = def.point;
    for (std::size_t i = 0; i < sample.bodies.size() && !def.body.empty(); ++i) {
      const BodyDef& body = scene.world.bodies[i];
      if (body.name != def.body) continue;
      label.anchor = sample.bodies[i].x;
      if (def.offset || std::holds_alternative<HalfSpace>(body.shape)) continue;
      // Beside it: where its silhouette ends.
      *label.anchor += reach(body.shape, sample.bodies[i].q, right) * right;
      label.apart = true;
    }
    const std::array<double, 2> place = label.anchor ? def.offset.value_or(kBeside) : def.page;
    label.offset = {place[0], place[1]};
    label.text = def.text;
    label.size = static_cast<float>(def.size);
    label.bold = def.bold;
    if (def.colour) std::copy(def.colour->begin(), def.colour->end(), label.colour.begin());
    picture.labels.push_back(label);
  }
}

}  // namespace tumble
