// Chapter 3, body: three ways to the inertia tensor (slides SF25–SF27).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "sim/body/mass_properties.h"
#include "sim/body/samples.h"

namespace tumble {

/// A row of the table. All take the mass [kg] as known and give the tensor about the centre of mass
/// that they find themselves.
struct InertiaMethod {
  std::string_view name, summary;
  std::optional<Spread> spread;  ///< of the points of a method that takes samples
  MassProperties (*weigh)(const Shape& shape, double mass, int samples, std::uint64_t seed);
};

/// surface: exact, `solidMass`. box: that of the box around the shape, as if it were full. grid,
/// random, quasi: equal masses at the points of that spread that are inside; they throw
/// std::invalid_argument if these are too few to turn.
std::span<const InertiaMethod> inertiaMethods();

/// The row of that name, or null.
const InertiaMethod* findInertiaMethod(std::string_view name);

}  // namespace tumble
