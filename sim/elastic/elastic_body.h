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

/// What is flat of a cloth.
struct Sheet {
  std::vector<std::array<int, 3>> triangles;  ///< by numbers of bodies of the world
  std::vector<Eigen::Vector2d> flat = {};     ///< [m] per body: where it lies when flat
  double thickness = 0.0;                     ///< [m] 0: it passes through cloth
  double stiffness = 0.0;  ///< [N/m] with which a point that presses on it is kept off
};

/// Something that bends: bodies of the world that are points of mass, joined by energies.
struct ElasticBody {
  std::string name;
  std::vector<int> bodies;        ///< of the world, in ascending order
  std::vector<Element> elements;  ///< by numbers of bodies of the world
  Sheet sheet = {};               ///< of a cloth
};

/// How many points an energy joins.
int pointsOf(const Energy& energy);

/// Whether it resists velocities too.
bool damps(const Energy& energy);

}  // namespace tumble
