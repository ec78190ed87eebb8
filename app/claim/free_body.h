// What claims ask of a body alone: its mass, its acceleration in free flight, how far its shape
// reaches.
#pragma once

#include <optional>

#include "sim/method/model.h"

namespace tumble {

/// Whether forces move the body: neither fixed nor a half-space.
bool moves(const BodyDef& body);

/// Acceleration [m/s²] of the centre of mass in free flight: gravity + Σ uniform forces / mass.
/// Empty if a drag, a spring or a force off the centre acts, whose motion has no parabola.
std::optional<Vec3> freeAcceleration(const WorldDef& world, int body);

/// max n·R(q) p over the points p of the shape [m]: how far it reaches from its centre along unit
/// n.
double reach(const Shape& shape, const Quat& q, const Vec3& n);

/// Angular momentum R I Rᵀ ω [kg m²/s] about the centre of mass, world frame.
Vec3 angularMomentum(const Mat3& inertia, const Quat& q, const Vec3& omega);

/// Restitution and friction that the scene's rules give a pair of bodies.
Surface surfaceOf(const WorldDef& world, int a, int b);

}  // namespace tumble
