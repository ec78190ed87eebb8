#include "sim/joined.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/contact/contact.h"
#include "sim/joint/joint_rows.h"

namespace tumble {
namespace {

constexpr double kTurn = 3.14159265358979323846;  // [rad] the widest limit of a hinge
constexpr double kSame = 1e-6;  // of the size: anchors of so many digits are a particle's position

void need(bool holds, const std::string& where, const std::string& what) {
  if (!holds) throw Refusal(where, what);
}

std::string pathOf(std::size_t k, const char* field = "") {
  return "joints[" + std::to_string(k) + "]" + field;
}

/// `joint "arm" of "plank" and the world`
std::string titleOf(const WorldDef& def, const JointDef& joint) {
  const auto end = [&](int body) -> std::string {
    if (body == kNoBody) return "the world";
    const bool there = body >= 0 && body < static_cast<int>(def.bodies.size());
    return there ? "\"" + def.bodies[body].name + "\"" : "no body";
  };
  return "joint \"" + joint.name + "\" of " + end(joint.a) + " and " + end(joint.b);
}

/// The bodies of a joint, and what of a joint they can have.
void checkBodies(const Model& model, std::span<const RigidBody> bodies, std::size_t k) {
  const JointDef& def = model.def.joints[k];
  const std::string name = titleOf(model.def, def);
  const int count = model.count();
  need(def.a >= 0 && def.a < count, pathOf(k, ".a"), name + " names a body that is not there");
  need(def.b >= kNoBody && def.b < count, pathOf(k, ".b"),
       name + " names a body that is not there");
  need(def.a != def.b, pathOf(k, ".b"), name + " joins a body to itself");
  const bool fixedB = def.b == kNoBody || model.fixed(def.b);
  need(!(model.fixed(def.a) && fixedB), pathOf(k), name + " joins nothing that moves");
  for (const int body : {def.a, def.b}) {
    if (body == kNoBody) continue;
    const char* field = body == def.a ? ".a" : ".b";
    const std::string who = name + ": \"" + model.def.bodies[body].name + "\"";
    need(!model.def.bodies[body].pivot_B, pathOf(k, field),
         who + " has a pivot; leave it out, a ball joint to the world holds the same point");
    if (!bodies[body].particle) continue;
    const bool point = def.kind == JointKind::Ball || def.kind == JointKind::Distance;
    need(point, pathOf(k, field),
         who + " is a particle, which does not turn: \"ball\" or \"distance\" can hold it");
    const Vec3 off = bodies[body].x - (body == def.a ? def.anchorA : def.anchorB);
    need(off.norm() <= kSame * model.size, pathOf(k, ".anchor"),
         who + " is a particle, so the anchor must be its position: move it by [" +
             shortNumber(off.x()) + ", " + shortNumber(off.y()) + ", " + shortNumber(off.z()) +
             "] m");
  }
}

/// Anchors on a particle, which does not turn, stand where it is to the last bit.
void seatAnchors(JointDef& def, std::span<const RigidBody> bodies) {
  const auto particle = [&](int body) { return body != kNoBody && bodies[body].particle; };
  if (particle(def.a)) def.anchorA = bodies[def.a].x;
  if (particle(def.b)) def.anchorB = bodies[def.b].x;
  if (def.kind != JointKind::Ball) return;
  if (particle(def.a))
    def.anchorB = def.anchorA;
  else
    def.anchorA = def.anchorB;
}

/// Anchors, axis and limits are numbers that make a joint.
void checkNumbers(const Model& model, std::size_t k) {
  const JointDef& def = model.def.joints[k];
  const std::string name = titleOf(model.def, def) + ": ";
  const JointName& row = jointName(def.kind);
  need(def.anchorA.allFinite() && def.anchorB.allFinite(), pathOf(k, ".anchor"),
       name + "an anchor must be a finite point");
  need(def.axis.allFinite() && (!row.axis || def.axis.norm() > 0.0), pathOf(k, ".axis"),
       name + "an axis must be three numbers that are not all zero");
  const bool limits = std::isfinite(def.lo) || std::isfinite(def.hi);
  need(row.limits || !limits, pathOf(k), name + "a joint of this kind has no limits");
  need(def.lo <= def.hi, pathOf(k, ".min"), name + "the lower limit lies above the upper one");
  need(
      !limits || def.lo < def.hi, pathOf(k, ".min"),
      name +
          "two limits that are one leave nothing free: leave them out of a distance, which is then "
          "rigid, or take a joint that holds it");
  if (def.kind == JointKind::Hinge) {
    need(!std::isfinite(def.lo) || def.lo > -kTurn, pathOf(k, ".min"),
         name + "a hinge tells turns from -180 to 180 degrees");
    need(!std::isfinite(def.hi) || def.hi < kTurn, pathOf(k, ".max"),
         name + "a hinge tells turns from -180 to 180 degrees");
  }
  const double apart = (def.anchorA - def.anchorB).norm();
  need(def.kind == JointKind::Distance || apart == 0.0, pathOf(k, ".anchor"),
       name + "both bodies of such a joint share one anchor");
  need(def.kind != JointKind::Distance || limits || apart > 0.0, pathOf(k, ".anchor"),
       name + "a rod needs two anchors apart; for one point take \"ball\"");
}

/// Nothing at the start is beyond a limit, or moves as a joint does not let it.
void checkStart(const Model& model, std::span<const RigidBody> bodies, std::size_t k) {
  constexpr double kRounding = 1e-9;  // [m], [m/s], and of the speeds
  const std::string name = titleOf(model.def, model.def.joints[k]);
  const Joint& joint = model.joints[k];
  const double touch = ContactTolerance::forSize(model.size).touch;
  double speed = 1.0;
  for (const int body : {joint.a, joint.b})
    if (body < model.count())
      speed = std::max(speed, bodies[body].v.norm() + joint.arm * bodies[body].omega.norm());
  std::vector<JointRow> rows;
  jointRows(bodies, joint, rows);
  double squares = 0.0;  // [m²/s²]
  for (const JointRow& row : rows)
    if (row.limit < 0) squares += row.arm * row.rate * row.arm * row.rate;
  need(std::sqrt(squares) <= kRounding * speed, pathOf(k),
       name + " does not let its bodies begin as they do: they part at " +
           shortNumber(std::sqrt(squares)) + " m/s there; give both velocities that agree");
  for (const JointRow& row : rows) {
    need(row.limit < 0 || row.arm * row.gap >= -touch, pathOf(k, row.limit == 0 ? ".min" : ".max"),
         name + " begins beyond its " + (row.limit == 0 ? "lower" : "upper") + " limit, by " +
             (joint.kind == JointKind::Hinge ? shortNumber(-row.gap * 180.0 / kTurn) + " degrees"
                                             : shortNumber(-row.gap) + " m"));
  }
}

/// The farthest point [m] of the bodies of a joint that move, from its anchor.
double armOf(const Model& model, std::span<const RigidBody> bodies, const JointDef& def) {
  double arm = 0.0;
  for (const int body : {def.a, def.b}) {
    if (body == kNoBody || model.fixed(body)) continue;
    const double radius = boundingRadius(model.shapes[body]);
    arm = std::max(arm,
                   (bodies[body].x - def.anchorA).norm() + (std::isfinite(radius) ? radius : 0.0));
  }
  return arm > 0.0 ? arm : 1.0;
}

}  // namespace

void joinBodies(Model& model, std::span<const RigidBody> bodies) {
  const std::vector<JointDef>& defs = model.def.joints;
  for (std::size_t k = 0; k < defs.size(); ++k) {
    checkBodies(model, bodies, k);
    checkNumbers(model, k);
    seatAnchors(model.def.joints[k], bodies);
    model.joints.push_back(makeJoint(defs[k], bodies, armOf(model, bodies, defs[k])));
    checkStart(model, bodies, k);
    if (!defs[k].collide && defs[k].b != kNoBody)
      model.partners.push_back(std::minmax(defs[k].a, defs[k].b));
  }
  std::sort(model.partners.begin(), model.partners.end());
}

}  // namespace tumble
