// What inertia looks like: ellipsoids, and the way of the angular velocity on them.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// See-through, the solid ellipsoid of a body's mass that turns like it, at a sample of the body;
/// nothing for what cannot spin.
std::optional<Instance> inertiaEllipsoid(const BodyDef& body, const BodySample& sample);

/// In each moving body, see-through, the solid ellipsoid of its mass that turns like it:
///   aₓ² = 5/(2m) (I_y + I_z − I_x) and so on, principal axes.
void addInertiaEllipsoids(const Scene& scene, const Sample& sample, Picture& picture);

/// About each moving body Poinsot's ellipsoid ω·Iω = 2T in its principal axes, angular velocities
/// drawn as lengths; on it the polhode, the way that ω goes in the body through the whole
/// recording, among the closed curves of other momenta and the separatrix.
///   Landau and Lifshitz, Mechanics, §37.
void addPolhodes(const Scene& scene, const Recording& recording, const Sample& sample,
                 Picture& picture);

/// Arrows at each moving body: linear momentum, angular momentum and angular velocity, each kind's
/// largest of the run as long as kMomentaReach says of the largest body; none where a momentum is
/// only rounding of the other.
void addMomenta(const Scene& scene, const Recording& recording, const Sample& sample,
                Picture& picture);

/// Numbers of the inertia tensor of the first body that turns, on a page of that many pixels:
///   I = R Ibody Rᵀ   [kg m²], below Ibody.   Slides SF23–SF24.
void addTensors(const Scene& scene, const Sample& sample, const Eigen::Vector2d& page,
                Picture& picture);

}  // namespace tumble
