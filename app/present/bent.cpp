#include "app/present/bent.h"

#include <algorithm>
#include <limits>
#include <map>

#include "app/present/palette.h"
#include "app/present/strands.h"

namespace tumble {

namespace {

constexpr float kNoEdge = 1e9f;  // [m] from an edge that is not drawn

using Triangle = std::array<int, 3>;

// Places of the points about their middle, and the normals of the surface there, side by side.
struct Shell {
  Vec3 middle = Vec3::Zero();
  std::vector<Vec3> places, normals;
};

std::size_t cornerOf(const BentDef& bent, std::size_t triangle, int point) {
  const int side = bent.sides.empty() ? 0 : bent.sides[triangle];
  return static_cast<std::size_t>(side * bent.count + point);
}

Shell shellOf(const BentDef& bent, const Sample& sample) {
  Shell shell;
  for (int p = 0; p < bent.count; ++p) {
    shell.places.push_back(sample.bodies[static_cast<std::size_t>(bent.first + p)].x);
    shell.middle += shell.places.back() / bent.count;
  }
  for (Vec3& place : shell.places) place -= shell.middle;
  const int sides =
      bent.sides.empty() ? 1 : 1 + *std::max_element(bent.sides.begin(), bent.sides.end());
  shell.normals.assign(static_cast<std::size_t>(sides * bent.count), Vec3::Zero());
  for (std::size_t n = 0; n < bent.triangles.size(); ++n) {
    const Triangle& t = bent.triangles[n];
    const Vec3 a = shell.places[t[1]] - shell.places[t[0]];
    const Vec3 b = shell.places[t[2]] - shell.places[t[0]];
    for (const int point : t) shell.normals[cornerOf(bent, n, point)] += a.cross(b);
  }
  for (Vec3& n : shell.normals)
    if (!n.isZero(0.0)) n.normalize();  // 0 where a point has no triangle on that side
  return shell;
}

void addCorner(const Vec3& place, const Vec3& normal, Facets& facets) {
  facets.corners.push_back(
      {place.cast<float>(), normal.cast<float>(), Eigen::Vector3f::Constant(kNoEdge)});
  facets.reach = std::max(facets.reach, place.norm());
}

// One face, `offset` [m] from the points along their normals; turned over if that is negative.
void addFace(const BentDef& bent, const Shell& shell, double offset, Facets& facets) {
  const double side = offset < 0.0 ? -1.0 : 1.0;
  for (std::size_t n = 0; n < bent.triangles.size(); ++n)
    for (int k = 0; k < 3; ++k) {
      const int p = bent.triangles[n][side > 0.0 ? k : 2 - k];
      const Vec3& normal = shell.normals[cornerOf(bent, n, p)];
      addCorner(shell.places[p] + offset * normal, side * normal, facets);
    }
}

// The surface of a solid: a skin off its points along the normals of all sides that meet there.
void addSkin(const BentDef& bent, Shell& shell, Facets& facets) {
  std::vector<Vec3> out(static_cast<std::size_t>(bent.count), Vec3::Zero());
  for (std::size_t n = 0; n < shell.normals.size(); ++n)
    out[n % static_cast<std::size_t>(bent.count)] += shell.normals[n];
  for (std::size_t p = 0; p < out.size(); ++p) shell.places[p] += bent.skin * out[p];
  addFace(bent, shell, 0.0, facets);
}

// Edges that only one triangle has, each as that triangle goes along it.
std::vector<std::pair<int, int>> rimOf(const std::vector<Triangle>& triangles) {
  std::map<std::pair<int, int>, int> seen;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++seen[{t[k], t[(k + 1) % 3]}];
  std::vector<std::pair<int, int>> rim;
  for (const auto& [edge, count] : seen)
    if (!seen.contains({edge.second, edge.first})) rim.push_back(edge);
  return rim;
}

void addRim(const BentDef& bent, const Shell& shell, Facets& facets) {
  const double half = 0.5 * bent.thickness;
  for (const auto& [p, q] : rimOf(bent.triangles)) {
    const Vec3 along = shell.places[q] - shell.places[p];
    const Vec3 out = along.cross(shell.normals[p] + shell.normals[q]).normalized();
    const auto corner = [&](int i, double side) {
      addCorner(shell.places[i] + side * half * shell.normals[i], out, facets);
    };
    corner(p, 1.0), corner(p, -1.0), corner(q, -1.0);
    corner(p, 1.0), corner(q, -1.0), corner(q, 1.0);
  }
}

Instance instanceOf(const Shell& shell, Facets facets, double thickness, const Colour& colour) {
  facets.thickness = thickness;
  Instance instance;
  instance.form = Form::Facets;
  instance.position = shell.middle;
  instance.colour = colour;
  instance.facets = std::make_shared<const Facets>(std::move(facets));
  return instance;
}

}  // namespace

std::vector<bool> partsOfSurfaces(const Scene& scene) {
  std::vector<bool> parts(scene.world.bodies.size(), false);
  for (const BentDef& bent : scene.bent) std::fill_n(parts.begin() + bent.first, bent.count, true);
  return parts;
}

std::vector<Instance> bentSurfaces(const Scene& scene, const Sample& sample,
                                   const std::vector<Colour>& colours) {
  constexpr float kShade = 0.72f;  // of the colour: a back that has none of its own
  std::vector<Instance> surfaces;
  for (const BentDef& bent : scene.bent) {
    const Colour front = colours[static_cast<std::size_t>(bent.first)];
    if (bent.strand > 0) {
      for (Instance& tube : strandTubes(bent, sample, front)) surfaces.push_back(std::move(tube));
      continue;
    }
    Shell shell = shellOf(bent, sample);
    const double half = 0.5 * bent.thickness;
    Facets facets;
    if (half == 0.0) {
      addSkin(bent, shell, facets);
      surfaces.push_back(instanceOf(shell, std::move(facets), facets.reach, front));
      continue;
    }
    addFace(bent, shell, half, facets);
    addRim(bent, shell, facets);
    surfaces.push_back(instanceOf(shell, std::move(facets), half, front));
    Facets back;
    addFace(bent, shell, -half, back);
    const Colour behind =
        bent.back ? Colour{static_cast<float>((*bent.back)[0]), static_cast<float>((*bent.back)[1]),
                           static_cast<float>((*bent.back)[2])}
                  : shade(front, kShade);
    surfaces.push_back(instanceOf(shell, std::move(back), half, behind));
  }
  return surfaces;
}

}  // namespace tumble
