// Chapter 2, elastic: by how much what bends is longer or shorter than at rest.
#pragma once

#include <span>
#include <vector>

#include "sim/elastic/elastic_body.h"

namespace tumble {

/// The strain of an element in the direction in which it is largest: |l/l₀ − 1| of a spring, of the
/// threads of a cloth, and of the stretches σ of a solid. 0 of what resists no stretch.
double strainOf(const Energy& energy, const ElementPlaces& x);

/// The largest strain of the elements that join each point, in the order of `bodies`.
/// @param places  [m] of the same points
std::vector<double> strainsOf(const ElasticBody& body, std::span<const Vec3> places);

}  // namespace tumble
