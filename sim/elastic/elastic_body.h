// Chapter 2, elastic: points and the energies that join them.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "sim/elastic/element.h"

namespace tumble {

/// An energy and the points that it joins, by their numbers; those it does not join are 0.
struct Element {
  std::array<int, kElementPoints> points = {};
  int count = 0;  ///< how many
  Energy energy;
};

/// Something that bends: bodies of the world that are points of mass, joined by energies.
struct ElasticBody {
  std::string name;
  std::vector<int> bodies;                     ///< of the world, in ascending order
  std::vector<Element> elements;               ///< by numbers of bodies of the world
  std::vector<std::array<int, 3>> sheet = {};  ///< triangles of a cloth, by the same
};

/// How many points an energy joins.
int pointsOf(const Energy& energy);

/// Whether it resists velocities too.
bool damps(const Energy& energy);

}  // namespace tumble
