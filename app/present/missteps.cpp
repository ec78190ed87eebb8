#include "app/present/missteps.h"

#include <algorithm>
#include <set>

#include "app/claim/free_body.h"
#include "app/present/bodies.h"
#include "app/present/digits.h"
#include "app/present/facets.h"
#include "app/present/palette.h"

namespace tumble {

namespace {

// A hair larger than the body, so that it covers a ghost in the same place and layer.
constexpr double kCover = 1.002;
// The arrow passes the body on its left, this many of its reaches from the centre.
constexpr double kAside = 1.3;

Instance ghostOf(const BodyDef& body, const Pose& pose, const Colour& colour, int layer) {
  Instance ghost =
      instanceOf(body, pose.x, pose.q, colour, Vec3::Zero(), 1.0, facetsOf(body.shape));
  ghost.scale *= kCover;
  ghost.finish = Finish::Ghost;
  ghost.alpha = 0.85f;
  ghost.layer = layer;
  ghost.banded = false;  // it is no body that spins
  return ghost;
}

// The point beside a body, some of its own reaches away along X.
Vec3 beside(const BodyDef& body, const Pose& pose, double share) {
  return pose.x + Vec3(share * reach(body.shape, pose.q, Vec3::UnitX()), 0.0, 0.0);
}

Label labelAt(const Vec3& anchor, Align align, const std::string& text, const Colour& colour) {
  Label label;
  label.anchor = anchor;
  label.offset = {align == Align::Left ? 8.0 : -8.0, 5.0};
  label.align = align;
  label.text = text;
  label.colour = colour;
  return label;
}

// The layer of a ghost that stands at this pose, as where a run went on from it; 0 if none does.
int layerAt(const Picture& picture, const Vec3& x) {
  constexpr double kSame = 1e-9;  // m
  int layer = 0;
  for (const Instance& one : picture.instances)
    if (one.finish == Finish::Ghost && (one.position - x).norm() < kSame)
      layer = std::max(layer, one.layer);
  return layer;
}

std::string mendedText(const Misstep& misstep) {
  if (misstep.mendedAt < misstep.t) return "back to t = " + fourDigits(misstep.mendedAt) + " s";
  if (misstep.mendedAt > misstep.t) return "free at t = " + fourDigits(misstep.mendedAt) + " s";
  return "moved out";
}

}  // namespace

void addMissteps(const Scene& scene, const Recording& recording, double t, Picture& picture) {
  std::set<int> shown;
  int layer = 0;
  for (const Misstep& misstep : recording.report.missteps) {
    if (misstep.t > t || !shown.insert(misstep.body).second) continue;
    const BodyDef& body = scene.world.bodies[misstep.body];
    layer = std::max(layer + 1, layerAt(picture, misstep.pose.x));
    picture.instances.push_back(ghostOf(body, misstep.pose, colour::kForce, layer));
    picture.labels.push_back(labelAt(beside(body, misstep.pose, 1.0), Align::Left,
                                     "t = " + fourDigits(misstep.t) + " s: " +
                                         fourDigits(-1e3 * misstep.separation) + " mm too deep",
                                     colour::kInk));
    picture.labels.back().offset = {16.0, -10.0};  // above the ruler, which passes the body
    if (misstep.mendedAt > t) continue;
    layer = std::max(layer + 1, layerAt(picture, misstep.mended.x));
    picture.instances.push_back(ghostOf(body, misstep.mended, hex(0x3F9C8C), layer));
    const Vec3 tip = beside(body, misstep.mended, -kAside);
    const bool later = misstep.mendedAt > misstep.t;
    picture.labels.push_back(labelAt(later ? beside(body, misstep.mended, 1.0) : tip,
                                     later ? Align::Left : Align::Right, mendedText(misstep),
                                     colour::kInk));
    picture.arrows.push_back({beside(body, misstep.pose, -kAside), tip, colour::kInk, 1.9f});
  }
}

}  // namespace tumble
