#include "app/export/drawn.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "app/present/bodies.h"
#include "app/present/facets.h"
#include "app/present/palette.h"
#include "app/present/present.h"

namespace tumble {

std::vector<DrawnBody> drawnBodies(const Scene& scene, const Recording& recording) {
  const Framing framing = framingOf(scene, motionPoints(scene, recording));
  const std::vector<Colour> colours = bodyColours(scene);
  const auto facets = facetsOfBodies(scene.world.bodies);
  const std::vector<BodySample>& start = recording.samples.front().bodies;
  std::vector<DrawnBody> drawn;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const BodyDef& body = scene.world.bodies[i];
    if (isFloor(body)) continue;
    DrawnBody& one = drawn.emplace_back();
    one.body = static_cast<int>(i);
    one.instance = instanceOf(body, start[i].x, start[i].q, colours[i], framing.centre,
                              3.0 * framing.radius, facets[i]);
    one.moves =
        std::any_of(recording.samples.begin(), recording.samples.end(), [&](const Sample& sample) {
          const BodySample& now = sample.bodies[i];
          return now.x != start[i].x || now.q.coeffs() != start[i].q.coeffs();
        });
  }
  return drawn;
}

IndexedMesh meshOf(const Instance& instance) {
  std::shared_ptr<const Facets> facets = instance.facets;
  if (instance.form == Form::Box) facets = facetsOf(Box{Vec3::Ones()}, Mat3::Identity());
  if (instance.form == Form::Cylinder) facets = facetsOf(Cylinder{1.0, 2.0}, Mat3::Identity());
  if (!facets) facets = facetsOf(Sphere{1.0}, Mat3::Identity());

  IndexedMesh mesh;
  std::map<std::array<float, 6>, std::uint32_t> known;
  for (const Facets::Corner& corner : facets->corners) {
    const Eigen::Vector3f &p = corner.position, n = corner.normal.normalized();
    const std::array<float, 6> key = {p.x(), p.y(), p.z(), n.x(), n.y(), n.z()};
    const auto [place, isNew] =
        known.emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) {
      mesh.positions.push_back(p);
      mesh.normals.push_back(n);
    }
    mesh.indices.push_back(place->second);
  }
  return mesh;
}

}  // namespace tumble
