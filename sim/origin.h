// Chapter 11: where a world counts its places from. Numbers round by their size, so a scene that
// stands far from the origin is simulated as one that stands there.
#pragma once

#include "sim/world.h"

namespace tumble {

/// A place [m] near what moves, in numbers of few bits; zero where the scene stands no farther from
/// the origin than a few times its own extent, or where nothing that moves could meet anything.
/// What is added far away can move it, and rounding with it; while it stays, that changes no bit of
/// the motion here.
Vec3 originOf(const WorldDef& def);

/// The same scene with all its places shifted.
WorldDef shifted(WorldDef def, const Vec3& shift);

/// The same instant of the scene shifted, all of whose moving bodies weigh so much [N].
Sample shifted(Sample sample, const Vec3& shift, const Vec3& weight);

/// What the run of the scene shifted would tell.
Report shifted(Report report, const Vec3& shift, const Vec3& weight);

}  // namespace tumble
