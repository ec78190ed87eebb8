#include "app/export/scene_json.h"

#include <nlohmann/json.hpp>

#include "app/claim/free_body.h"
#include "app/present/palette.h"
#include "sim/math/frames.h"

namespace tumble {

namespace {

using Json = nlohmann::ordered_json;

Json list(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Json list(const Quat& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

Json list(const Mat3& m) {
  return {list(Vec3(m.row(0))), list(Vec3(m.row(1))), list(Vec3(m.row(2)))};
}

// Points about the body origin, and faces of their numbers.
Json surfaceOf(const Polyhedron& solid, const Vec3& origin) {
  Json points = Json::array();
  for (const Vec3& p : solid.points) points.push_back(list(Vec3(p - origin)));
  return {{"points", std::move(points)}, {"faces", solid.faces}};
}

Json jsonOf(const Shape& shape);

struct ShapeJson {
  Json operator()(const Sphere& sphere) const { return {{"radius", sphere.r}}; }
  Json operator()(const Box& box) const { return {{"edges", list(Vec3(2.0 * box.half))}}; }
  Json operator()(const Cylinder& c) const { return {{"radius", c.r}, {"height", c.h}}; }
  Json operator()(const Capsule& c) const { return {{"radius", c.r}, {"height", c.h}}; }
  Json operator()(const Ellipsoid& e) const { return {{"semi_axes", list(e.half)}}; }
  Json operator()(const Hull& hull) const { return surfaceOf(*hull.solid, hull.origin); }
  Json operator()(const Mesh& mesh) const { return surfaceOf(*mesh.solid, mesh.origin); }
  Json operator()(const HalfSpace& plane) const {
    return {{"normal", list(plane.n)}, {"d", plane.d}};
  }
  Json operator()(const Particle& particle) const { return {{"radius", particle.radius}}; }
  Json operator()(const Compound& compound) const {
    Json parts = Json::array();
    for (const Part& part : compound.parts) {
      Json one = jsonOf(shapeOf(part));
      const Pose pose = poseInBody(compound, part);
      one["position"] = list(pose.x);
      one["orientation"] = list(pose.q);
      parts.push_back(std::move(one));
    }
    return {{"parts", std::move(parts)}};
  }
};

Json jsonOf(const Shape& shape) {
  Json json = {{"type", shapeName(shape)}};
  json.update(std::visit(ShapeJson{}, shape));
  return json;
}

Json jsonOf(const BodyDef& body, const Colour& colour) {
  Json json = {{"name", body.name},
               {"shape", jsonOf(body.shape)},
               {"material", body.material},
               {"colour", {colour[0], colour[1], colour[2]}},
               {"restitution", body.restitution},
               {"friction", body.friction},
               {"moves", moves(body)},
               {"position", list(body.position)},
               {"orientation", list(body.orientation)},
               {"velocity", list(body.velocity)},
               {"angular_velocity", list(body.angularVelocity)}};
  if (!moves(body)) return json;
  json["mass"] = bodyMass(body);
  if (!std::holds_alternative<Particle>(body.shape)) json["inertia"] = list(massOf(body).inertia);
  return json;
}

}  // namespace

std::string sceneJson(const Scene& scene) {
  const WorldDef& world = scene.world;
  const std::vector<Colour> colours = bodyColours(scene);
  Json bodies = Json::array(), joints = Json::array();
  for (std::size_t i = 0; i < world.bodies.size(); ++i)
    bodies.push_back(jsonOf(world.bodies[i], colours[i]));
  for (const JointDef& joint : world.joints)
    joints.push_back({{"name", joint.name},
                      {"kind", jointName(joint.kind).name},
                      {"a", world.bodies[joint.a].name},
                      {"b", joint.b == kNoBody ? Json() : Json(world.bodies[joint.b].name)},
                      {"anchor_a", list(joint.anchorA)},
                      {"anchor_b", list(joint.anchorB)},
                      {"axis", list(joint.axis)}});
  const Json json = {{"version", TUMBLE_VERSION},      {"scene", scene.line},
                     {"title", scene.title},           {"claim", scene.claim},
                     {"gravity", list(world.gravity)}, {"duration", world.duration},
                     {"method", world.method},         {"bodies", std::move(bodies)},
                     {"joints", std::move(joints)}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tumble
