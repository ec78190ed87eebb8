// Chapter 7, contact. Painlevé's paradox: friction turns sliding bodies against their supports so
// that no forces, however large, keep them apart. The contacts jam: an impulse without collision
// ends a slip.
#pragma once

#include "sim/contact/impact.h"

namespace tumble {

/// Residual of forces that are no solution: contact problems that have one are solved to better.
inline constexpr double kNoForces = 1e-8;
/// Jams of one instant: slips that end in turns shrink from one to the next.
inline constexpr int kJams = 100;
/// What is told of a jam that ended.
inline constexpr const char* kJamNote =
    "a sliding contact jammed (Painleve): an impulse without collision ended its slip";

/// Whether a contact that slides has no force, of those that are their pair's only one: it
/// approaches, and of its push friction leaves nothing, see `pushLeft`. Bodies carry their outer
/// forces.
bool jams(std::span<const RigidBody> bodies, std::span<const Contact> contacts);

/// Gives contacts that last, but have no forces, impulses that end a slip. Where Coulomb's law has
/// no forces, it has impulses: those of a step h whose friction obeys the slip that is left at its
/// end. A step always has some (Stewart, Rigid-Body Dynamics with Friction and Impact, 2000, §5),
/// and where there are no forces they do not vanish with h → 0; Génot and Brogliato 1999. Where
/// they are more than one, the longest step decides.
/// @param impact  bodies carry their outer forces; bonds with bias J̇ v, as of accelerations
/// @param kinetic  [J] largest kinetic energy of the run
/// @return false, and nothing changes, if there is no jam, or its end would give energy
bool endJam(const Impact& impact, double kinetic, ImpulseEnergy& energy);

}  // namespace tumble
