// What bends, as surfaces that go with its points.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "app/record/recording.h"
#include "app/scene/scene.h"
#include "render/picture.h"

namespace tumble {

/// Per body whether it is drawn as part of such a surface, not as a ball.
std::vector<bool> partsOfSurfaces(const Scene& scene);

/// The same of one body.
bool isPoint(const Scene& scene, int body);

/// The surfaces of all that bends at a sample, smoothly shaded; a cloth has two sides half its
/// thickness from its points, each with its colour, and a rim.
/// @param colours  per body
/// @param top      0, or the strain of the last colour: then cloths and solids are coloured by it,
///                 as where it is larger
std::vector<Instance> bentSurfaces(const Scene& scene, const Sample& sample,
                                   const std::vector<Colour>& colours, double top = 0.0);

/// Where the points of one are at a sample; those of a solid a skin further out.
std::vector<Vec3> surfacePlaces(const BentDef& bent, const Sample& sample);

/// How that surface goes through the points: in how many parts each cell of a cloth is drawn along
/// each thread; the cloth with so many points between its own; edges that only one triangle has,
/// each as that triangle goes along it; the colour of a cloth's other side.
int drawnParts(const BentDef& bent);
BentDef finer(const BentDef& bent, int parts);
std::vector<std::pair<int, int>> rimOf(const std::vector<std::array<int, 3>>& triangles);
Colour backOf(const BentDef& bent, const Colour& front);

/// The strain at each point of a cloth or a soft solid at a sample.
std::vector<double> strainsAt(const Scene& scene, const BentDef& bent, const Sample& sample);

/// What 98 % of the strains of all points and samples stay below; strands of fur have none.
double usualStrain(const Scene& scene, const Recording& recording);

/// From pale, at rest, to dark red; the colour of each even part of what they span.
inline constexpr int kStrainBands = 24;
std::span<const Colour> strainStops();
Colour colourOfBand(int band);

}  // namespace tumble
