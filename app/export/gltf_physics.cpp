#include "app/export/gltf_physics.h"

#include <algorithm>
#include <cmath>

#include "app/record/bodies.h"
#include "sim/body/principal_axes.h"

namespace tumble {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kShapes = "KHR_implicit_shapes";
constexpr const char* kBodies = "KHR_physics_rigid_bodies";

Json list(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

// The shape as KHR_implicit_shapes has it; null for what it has none for.
Json implicitShape(const Shape& shape) {
  if (const Sphere* sphere = std::get_if<Sphere>(&shape))
    return {{"type", "sphere"}, {"sphere", {{"radius", sphere->r}}}};
  if (const Particle* particle = std::get_if<Particle>(&shape)) {
    if (particle->radius > 0.0)
      return {{"type", "sphere"}, {"sphere", {{"radius", particle->radius}}}};
  }
  if (const Box* box = std::get_if<Box>(&shape))
    return {{"type", "box"}, {"box", {{"size", list(2.0 * box->half)}}}};
  if (const Cylinder* cylinder = std::get_if<Cylinder>(&shape))
    return {{"type", "cylinder"},
            {"cylinder",
             {{"height", cylinder->h}, {"radiusTop", cylinder->r}, {"radiusBottom", cylinder->r}}}};
  if (const Capsule* capsule = std::get_if<Capsule>(&shape))
    return {{"type", "capsule"},
            {"capsule",
             {{"height", capsule->h}, {"radiusTop", capsule->r}, {"radiusBottom", capsule->r}}}};
  return nullptr;
}

// Mass, principal moments and the velocities at the start.
Json motionOf(const BodyDef& body) {
  if (!moves(body)) return {{"isKinematic", true}, {"linearVelocity", list(body.velocity)}};
  Json motion = {{"mass", bodyMass(body)}};
  if (!std::holds_alternative<Particle>(body.shape)) {
    const PrincipalAxes principal = principalAxes(massOf(body).inertia);
    const Quat axes(principal.axes);
    motion["inertiaDiagonal"] = list(principal.moments);
    motion["inertiaOrientation"] = {axes.x(), axes.y(), axes.z(), axes.w()};
  }
  motion["linearVelocity"] = list(body.velocity);
  motion["angularVelocity"] = list(body.angularVelocity);
  return motion;
}

}  // namespace

int Physics::number(Json& table, Json row) {
  const auto known = std::find(table.begin(), table.end(), row);
  const auto place = static_cast<int>(known - table.begin());
  if (known == table.end()) table.push_back(std::move(row));
  return place;
}

void Physics::add(const DrawnBody& drawn, int shown, Json& node) {
  const BodyDef& body = scene_.world.bodies[drawn.body];
  Json extension = Json::object();
  if (moves(body) || drawn.moves) extension["motion"] = motionOf(body);
  Json geometry;
  if (Json shape = implicitShape(body.shape); !shape.is_null())
    geometry = {{"shape", number(shapes_, std::move(shape))}};
  else if (std::holds_alternative<Hull>(body.shape))
    geometry = {{"node", shown}, {"convexHull", true}};
  else if (!std::holds_alternative<Particle>(body.shape))
    geometry = {{"node", shown}};
  if (!geometry.is_null()) {
    const double friction = std::sqrt(body.friction);
    extension["collider"] = {
        {"geometry", std::move(geometry)},
        {"physicsMaterial", number(materials_, {{"staticFriction", friction},
                                                {"dynamicFriction", friction},
                                                {"restitution", body.restitution},
                                                {"frictionCombine", "multiply"},
                                                {"restitutionCombine", "maximum"}})}};
  }
  if (!extension.empty()) node["extensions"] = {{kBodies, std::move(extension)}};
}

void Physics::tell(Json& json) const {
  json["extensionsUsed"] = {kShapes, kBodies};
  if (!shapes_.empty()) json["extensions"][kShapes] = {{"shapes", shapes_}};
  if (!materials_.empty()) json["extensions"][kBodies] = {{"physicsMaterials", materials_}};
}

}  // namespace tumble
