// What claims ask of a body alone: its acceleration in free flight, how far its shape reaches,
// until when nothing touches it.
#pragma once

#include <optional>
#include <vector>

#include "app/record/bodies.h"

namespace tumble {

/// Acceleration [m/s²] of the centre of mass in free flight: gravity + Σ uniform forces / mass.
/// Empty if a drag, a spring, a joint or a force off the centre acts, whose motion has no parabola.
std::optional<Vec3> freeAcceleration(const WorldDef& world, int body);

/// max n·R(q) p over the points p of the shape [m]: how far it reaches from its centre along unit
/// n.
double reach(const Shape& shape, const Quat& q, const Vec3& n);

/// Angular momentum R I Rᵀ ω [kg m²/s] about the centre of mass, world frame.
Vec3 angularMomentum(const Mat3& inertia, const Quat& q, const Vec3& omega);

/// The relative error that rounding of the angular momentum and the attitude makes of ω: a unit in
/// the last place times the largest moment over the smallest. No method can mend it.
double spinRounding(const Mat3& inertia);

/// The first event [s] that the body takes part in, or the end of the run.
double untouchedUntil(const Scene& scene, const Recording& recording, int body);

/// The body without all others, their forces, joints and rules.
WorldDef aloneOf(const Scene& scene, int body);

/// Restitution and friction that the scene's rules give a pair of bodies.
Surface surfaceOf(const WorldDef& world, int a, int b);

/// Restitution and friction with which the body meets what is fixed, each where all of that agrees;
/// its own where it does not, or where nothing is fixed.
Surface actingSurface(const WorldDef& world, int body);

}  // namespace tumble
