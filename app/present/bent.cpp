#include "app/present/bent.h"

#include <algorithm>
#include <limits>
#include <map>

#include "app/present/bands.h"
#include "app/present/curve.h"
#include "app/present/palette.h"
#include "app/present/strands.h"
#include "sim/elastic/cloth.h"
#include "sim/elastic/strain.h"

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

std::vector<Vec3> placesOf(const BentDef& bent, const Sample& sample) {
  std::vector<Vec3> places;
  for (int p = 0; p < bent.count; ++p)
    places.push_back(sample.bodies[static_cast<std::size_t>(bent.first + p)].x);
  return places;
}

Shell shellOf(const BentDef& bent, std::vector<Vec3> places) {
  Shell shell;
  shell.places = std::move(places);
  for (const Vec3& place : shell.places) shell.middle += place / bent.count;
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

// Triangles, and the point that each of their corners goes with.
struct Side {
  Facets facets;
  std::vector<int> points;
};

void addCorner(int point, const Vec3& place, const Vec3& normal, Side& surface) {
  surface.facets.corners.push_back(
      {place.cast<float>(), normal.cast<float>(), Eigen::Vector3f::Constant(kNoEdge)});
  surface.facets.reach = std::max(surface.facets.reach, place.norm());
  surface.points.push_back(point);
}

// One face, `offset` [m] from the points along their normals; turned over if that is negative.
void addFace(const BentDef& bent, const Shell& shell, double offset, Side& surface) {
  const double side = offset < 0.0 ? -1.0 : 1.0;
  for (std::size_t n = 0; n < bent.triangles.size(); ++n)
    for (int k = 0; k < 3; ++k) {
      const int p = bent.triangles[n][side > 0.0 ? k : 2 - k];
      const Vec3& normal = shell.normals[cornerOf(bent, n, p)];
      addCorner(p, shell.places[p] + offset * normal, side * normal, surface);
    }
}

// A skin off the points of a solid, along the normals of all sides that meet there.
void putOnSkin(const BentDef& bent, Shell& shell) {
  std::vector<Vec3> out(static_cast<std::size_t>(bent.count), Vec3::Zero());
  for (std::size_t n = 0; n < shell.normals.size(); ++n)
    out[n % static_cast<std::size_t>(bent.count)] += shell.normals[n];
  for (std::size_t p = 0; p < out.size(); ++p) shell.places[p] += bent.skin * out[p];
}

void addRim(const BentDef& bent, const Shell& shell, Side& surface) {
  const double half = 0.5 * bent.thickness;
  for (const auto& [p, q] : rimOf(bent.triangles)) {
    const Vec3 along = shell.places[q] - shell.places[p];
    const Vec3 out = along.cross(shell.normals[p] + shell.normals[q]).normalized();
    const auto corner = [&](int i, double side) {
      addCorner(i, shell.places[i] + side * half * shell.normals[i], out, surface);
    };
    corner(p, 1.0), corner(p, -1.0), corner(q, -1.0);
    corner(p, 1.0), corner(q, -1.0), corner(q, 1.0);
  }
}

Colour colourOf(const Rgb& rgb) {
  return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
}

Instance instanceOf(const Shell& shell, Facets facets, const Colour& colour) {
  Instance instance;
  instance.form = Form::Facets;
  instance.position = shell.middle;
  instance.colour = colour;
  instance.facets = std::make_shared<const Facets>(std::move(facets));
  return instance;
}

// The surface in the colours of the strains of its points.
void addStrained(const Shell& shell, const Side& surface, const std::vector<double>& strains,
                 double top, std::vector<Instance>& surfaces) {
  std::vector<double> values;
  for (const int point : surface.points) values.push_back(strains[static_cast<std::size_t>(point)]);
  int band = 0;
  for (Facets& part : inBands(surface.facets, values, top, kStrainBands)) {
    const Colour colour = colourOfBand(band++);
    if (!part.corners.empty()) surfaces.push_back(instanceOf(shell, std::move(part), colour));
  }
}

}  // namespace

std::vector<Vec3> surfacePlaces(const BentDef& bent, const Sample& sample) {
  std::vector<Vec3> places = placesOf(bent, sample);
  if (bent.skin == 0.0) return places;
  Shell shell = shellOf(bent, std::move(places));
  putOnSkin(bent, shell);
  for (Vec3& place : shell.places) place += shell.middle;
  return std::move(shell.places);
}

std::vector<bool> partsOfSurfaces(const Scene& scene) {
  std::vector<bool> parts(scene.world.bodies.size(), false);
  for (const BentDef& bent : scene.bent) std::fill_n(parts.begin() + bent.first, bent.count, true);
  return parts;
}

bool isPoint(const Scene& scene, int body) {
  return std::any_of(scene.bent.begin(), scene.bent.end(), [&](const BentDef& bent) {
    return body >= bent.first && body < bent.first + bent.count;
  });
}

int drawnParts(const BentDef& bent) {
  constexpr int kAcross = 40;  // of a whole cloth: finer than its outline shows
  if (bent.columns == 0) return 1;
  return std::max(1, kAcross / std::max({1, bent.columns - 1, bent.count / bent.columns - 1}));
}

BentDef finer(const BentDef& bent, int parts) {
  BentDef fine = bent;
  fine.columns = parts * (bent.columns - 1) + 1;
  const int rows = parts * (bent.count / bent.columns - 1) + 1;
  fine.count = fine.columns * rows;
  fine.triangles = clothTriangles({.columns = fine.columns, .rows = rows});
  return fine;
}

std::vector<std::pair<int, int>> rimOf(const std::vector<Triangle>& triangles) {
  std::map<std::pair<int, int>, int> seen;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++seen[{t[k], t[(k + 1) % 3]}];
  std::vector<std::pair<int, int>> rim;
  for (const auto& [edge, count] : seen)
    if (!seen.contains({edge.second, edge.first})) rim.push_back(edge);
  return rim;
}

Colour backOf(const BentDef& bent, const Colour& front) {
  return bent.back ? colourOf(*bent.back) : backOfCloth(front);
}

std::vector<double> strainsAt(const Scene& scene, const BentDef& bent, const Sample& sample) {
  const std::vector<Vec3> places = placesOf(bent, sample);
  for (const Force& force : scene.world.forces)
    if (const Bending* bending = std::get_if<Bending>(&force))
      if (bending->body->bodies.front() == bent.first) return strainsOf(*bending->body, places);
  return std::vector<double>(places.size(), 0.0);
}

double usualStrain(const Scene& scene, const Recording& recording) {
  constexpr double kUsual = 0.98;    // of all points and samples
  constexpr double kNothing = 1e-6;  // strains that are rounding
  std::vector<double> strains;
  for (const BentDef& bent : scene.bent)
    for (const Sample& sample : recording.samples)
      if (bent.strand == 0)
        for (const double strain : strainsAt(scene, bent, sample)) strains.push_back(strain);
  if (strains.empty()) return 0.0;
  const auto usual = strains.begin() +
                     static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(strains.size() - 1));
  std::nth_element(strains.begin(), usual, strains.end());
  return *usual > kNothing ? *usual : 0.0;
}

std::span<const Colour> strainStops() {
  static constexpr std::array kHeat = {hex(0xF3ECDD), hex(0xEBCB8B), hex(0xE39A50), hex(0xC9542F),
                                       hex(0x7D1F2A)};
  return kHeat;
}

Colour colourOfBand(int band) {
  return ramp(strainStops(), (band + 0.5) / kStrainBands);
}

std::vector<Instance> bentSurfaces(const Scene& scene, const Sample& sample,
                                   const std::vector<Colour>& colours, double top) {
  std::vector<Instance> surfaces;
  for (const BentDef& own : scene.bent) {
    const Colour front = colours[static_cast<std::size_t>(own.first)];
    if (own.strand > 0) {
      for (Instance& tube : strandTubes(own, sample, front)) surfaces.push_back(std::move(tube));
      continue;
    }
    std::vector<Vec3> places = placesOf(own, sample);
    std::vector<double> strains = top > 0.0 ? strainsAt(scene, own, sample) : std::vector<double>();
    BentDef bent = own;
    if (const int parts = drawnParts(own); parts > 1) {
      bent = finer(own, parts);
      places = sheetThrough(places, own.columns, parts);
      if (!strains.empty()) strains = sheetThrough(strains, own.columns, parts);
    }
    Shell shell = shellOf(bent, std::move(places));
    const auto add = [&](Side surface, double thickness, const Colour& colour) {
      surface.facets.thickness = thickness;
      if (top > 0.0) return addStrained(shell, surface, strains, top, surfaces);
      surfaces.push_back(instanceOf(shell, std::move(surface.facets), colour));
    };
    const double half = 0.5 * bent.thickness;
    Side outside;
    if (half == 0.0) {
      putOnSkin(bent, shell);
      addFace(bent, shell, 0.0, outside);
      const double reach = outside.facets.reach;
      add(std::move(outside), reach, front);
      continue;
    }
    addFace(bent, shell, half, outside);
    addRim(bent, shell, outside);
    add(std::move(outside), half, front);
    Side back;
    addFace(bent, shell, -half, back);
    add(std::move(back), half, backOf(bent, front));
  }
  return surfaces;
}

}  // namespace tumble
