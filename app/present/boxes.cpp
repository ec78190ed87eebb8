#include "app/present/boxes.h"

#include "app/claim/free_body.h"
#include "app/present/palette.h"

namespace tumble {

void addBoundingBoxes(const Scene& scene, const Sample& sample, Picture& picture) {
  for (std::size_t i = 0; i < sample.bodies.size(); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    if (!moves(body)) continue;
    const Aabb box = boundingBox(body.shape, {sample.bodies[i].x, sample.bodies[i].q});
    const auto corner = [&](bool x, bool y, bool z) -> Eigen::Vector3d {
      return {x ? box.hi.x() : box.lo.x(), y ? box.hi.y() : box.lo.y(),
              z ? box.hi.z() : box.lo.z()};
    };
    // The ring below, the ring above, and three of the four posts between them.
    Polyline rings, post;
    rings.colour = post.colour = colour::kQuiet;
    rings.width = post.width = 1.0f;
    for (const bool y : {false, true})
      for (const auto& [x, z] :
           {std::pair(false, false), {true, false}, {true, true}, {false, true}, {false, false}})
        rings.points.push_back(corner(x, y, z));
    picture.lines.push_back(rings);
    for (const auto& [x, z] : {std::pair(true, false), {true, true}, {false, true}}) {
      post.points = {corner(x, false, z), corner(x, true, z)};
      picture.lines.push_back(post);
    }
  }
}

}  // namespace tumble
