// Chapter 9, method: what every method tells of an impact.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/impact.h"
#include "sim/method/model.h"
#include "sim/method/report.h"
#include "sim/method/state.h"

namespace tumble {

/// Where the energy of an impact went, for the certificate.
void bookImpact(const ImpactReport& impact, Report& report);

/// The impacts of time t [s], one for each pair and normal. What fixed bodies gave is added to the
/// impulse from outside.
/// @param contacts  those of one pair stand together
/// @param vrel      [m/s] per contact, before
/// @param impulse   [N·s] per contact, on a
std::vector<Event> impactEvents(const Model& model, State& state, double t,
                                std::span<const Contact> contacts, std::span<const double> vrel,
                                std::span<const Vec3> impulse);

/// Whether an impact gives a pair no more than the rounding of a contact that lasts.
bool leansOn(const Event& impact, std::span<const RigidBody> bodies, double keep);

}  // namespace tumble
