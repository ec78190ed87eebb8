#include "app/present/boxes.h"

#include "app/present/palette.h"
#include "app/record/bodies.h"
#include "sim/collide/parts.h"
#include "sim/collide/polygon_pairs.h"

namespace tumble {

namespace {

// The box, carried from its own axes into the world by x + R p.
void addBox(const Aabb& box, const Vec3& x, const Mat3& R, const Colour& colour, float width,
            Picture& picture) {
  const auto corner = [&](bool right, bool up, bool near) -> Eigen::Vector3d {
    return x + R * Vec3(right ? box.hi.x() : box.lo.x(), up ? box.hi.y() : box.lo.y(),
                        near ? box.hi.z() : box.lo.z());
  };
  // The ring below, the ring above, and three of the four posts between them.
  Polyline rings, post;
  rings.colour = post.colour = colour;
  rings.width = post.width = width;
  for (const bool y : {false, true})
    for (const auto& [across, z] :
         {std::pair(false, false), {true, false}, {true, true}, {false, true}, {false, false}})
      rings.points.push_back(corner(across, y, z));
  picture.lines.push_back(rings);
  for (const auto& [across, z] : {std::pair(true, false), {true, true}, {false, true}}) {
    post.points = {corner(across, false, z), corner(across, true, z)};
    picture.lines.push_back(post);
  }
}

}  // namespace

void addBoundingBoxes(const Scene& scene, const Sample& sample, Picture& picture) {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    if (!moves(body)) continue;
    addBox(boundingBox(body.shape, {sample.bodies[i].x, sample.bodies[i].q}), Vec3::Zero(),
           Mat3::Identity(), colour::kQuiet, 1.0f, picture);
  }
}

void addBodyBoxes(const Scene& scene, const Sample& sample, Picture& picture) {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    if (!moves(body)) continue;
    const Aabb box = boundingBox(body.shape, {Vec3::Zero(), Quat::Identity()});
    addBox(box, sample.bodies[i].x, sample.bodies[i].q.toRotationMatrix(), colour::kForce, 2.0f,
           picture);
  }
}

namespace {

BoxTree treeOf(const Shape& shape) {
  if (const Mesh* mesh = std::get_if<Mesh>(&shape)) return PolygonSoup(*mesh).tree();
  if (const Compound* compound = std::get_if<Compound>(&shape)) return partsOf(*compound).tree;
  return {};
}

}  // namespace

void addTreeBoxes(const Scene& scene, const Sample& sample, int level, Picture& picture) {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodySample& body = sample.bodies[i];
    const BoxTree tree = treeOf(scene.world.bodies[i].shape);
    for (const BoxTree::Node& node : tree.nodes())
      if (node.level == level || (node.item >= 0 && node.level < level))
        addBox(node.box, body.x, body.q.toRotationMatrix(), colour::kForce, 1.0f, picture);
  }
}

}  // namespace tumble
