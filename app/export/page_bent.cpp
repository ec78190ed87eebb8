#include "app/export/page_bent.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "app/export/pack.h"
#include "app/present/bent.h"
#include "app/present/palette.h"
#include "app/present/strands.h"

namespace tumble {

namespace {

using Json = nlohmann::ordered_json;
using Series = std::vector<std::vector<std::uint16_t>>;

Json rgb(const Colour& c) {
  return {c[0], c[1], c[2]};
}

// The points of it that are drawn, as bodies of the scene.
std::vector<std::size_t> drawnPoints(const BentDef& bent) {
  std::vector<std::size_t> points;
  for (int p = 0; p < bent.count; ++p)
    if (bent.strand == 0 || p % bent.strand > 0)
      points.push_back(static_cast<std::size_t>(bent.first + p));
  return points;
}

// Rows of so many numbers each, column by column, the low halves of all before the high ones.
template <class Rows>
std::string packedRows(const Rows& rows, std::size_t width) {
  Series columns(2 * width);
  const auto add = [&](std::size_t column, int number) {
    columns[column].push_back(static_cast<std::uint16_t>(number & 65535));
    columns[width + column].push_back(static_cast<std::uint16_t>(number >> 16));
  };
  for (const auto& row : rows)
    std::apply([&, k = std::size_t{0}](auto... number) mutable { (add(k++, number), ...); }, row);
  return packed(differences(columns));
}

// How the surface goes through its points.
Json weaveOf(const BentDef& own, const std::vector<Colour>& colours) {
  const int parts = drawnParts(own);
  const BentDef bent = parts > 1 ? finer(own, parts) : own;
  const Colour front = colours[static_cast<std::size_t>(own.first)];
  Json weave = {
      {"count", drawnPoints(own).size()},      {"columns", own.columns},      {"parts", parts},
      {"strand", std::max(0, own.strand - 1)}, {"half", 0.5 * own.thickness}, {"skin", own.skin}};
  if (own.strand > 0) {
    for (const Colour& shade : shadesOfStrands(front)) weave["colours"].push_back(rgb(shade));
    weave["parts"] = kPartsOfStrands;
    return weave;
  }
  weave["colours"] = {rgb(front), rgb(backOf(own, front))};
  weave["triangles"] = packedRows(bent.triangles, 3);
  weave["rim"] = packedRows(rimOf(bent.triangles), 2);
  weave["sides"] = packed(std::string(own.sides.begin(), own.sides.end()));
  return weave;
}

// All that is drawn in the course of the run.
Eigen::AlignedBox3d roomOf(const Recording& recording, const std::vector<std::size_t>& points) {
  Eigen::AlignedBox3d room;
  for (const Sample& sample : recording.samples)
    for (const std::size_t p : points) room.extend(sample.bodies[p].x);
  return room;
}

// In grains; of a strand from the second point on how far it is from the one before, which goes
// nearly as it does.
void addPlaces(const Recording& recording, const BentDef& bent, const Vec3& low, double grain,
               Series& series) {
  const std::vector<std::size_t> points = drawnPoints(bent);
  const auto inGrains = [&](std::size_t p, int axis, const Sample& sample) {
    return static_cast<std::uint16_t>(std::lround((sample.bodies[p].x[axis] - low[axis]) / grain));
  };
  for (std::size_t n = 0; n < points.size(); ++n)
    for (int axis = 0; axis < 3; ++axis) {
      const bool follows = bent.strand > 0 && n % static_cast<std::size_t>(bent.strand - 1) > 0;
      std::vector<std::uint16_t>& one = series.emplace_back();
      for (const Sample& sample : recording.samples) {
        const int before = follows ? inGrains(points[n - 1], axis, sample) : 0;
        one.push_back(static_cast<std::uint16_t>(inGrains(points[n], axis, sample) - before));
      }
    }
}

// Point by point; strands have none.
std::string strainsOf(const Scene& scene, const Recording& recording, double top) {
  Series series;
  for (const BentDef& bent : scene.bent) {
    const std::size_t first = series.size();
    series.resize(first + drawnPoints(bent).size());
    for (const Sample& sample : recording.samples) {
      const std::vector<double> strains =
          bent.strand > 0 ? std::vector<double>() : strainsAt(scene, bent, sample);
      for (std::size_t p = first; p < series.size(); ++p)
        series[p].push_back(strains.empty()
                                ? 0
                                : static_cast<std::uint16_t>(std::lround(
                                      255.0 * std::min(1.0, strains[p - first] / (2.0 * top)))));
    }
  }
  return packed(differences(series));
}

}  // namespace

Json bentJson(const Scene& scene, const Recording& recording, double radius) {
  const std::vector<Colour> colours = bodyColours(scene);
  Eigen::AlignedBox3d room;
  for (const BentDef& bent : scene.bent) room.extend(roomOf(recording, drawnPoints(bent)));
  const double grain = std::max(radius / kGrainsToRadius, room.sizes().maxCoeff() / 65535.0);
  Json weaves = Json::array();
  Series places;
  for (const BentDef& bent : scene.bent) {
    weaves.push_back(weaveOf(bent, colours));
    addPlaces(recording, bent, room.min(), grain, places);
  }
  Json json = {{"grain", grain},
               {"low", {room.min().x(), room.min().y(), room.min().z()}},
               {"places", packed(differences(places))},
               {"weaves", std::move(weaves)}};
  const double top = scene.show.strain ? usualStrain(scene, recording) : 0.0;
  if (top == 0.0) return json;
  json["strains"] = strainsOf(scene, recording, top);
  json["top"] = top;
  for (int band = 0; band < kStrainBands; ++band) json["bands"].push_back(rgb(colourOfBand(band)));
  return json;
}

}  // namespace tumble
