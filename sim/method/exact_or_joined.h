// Chapter 9, method: what the row "exact" of the table of methods does.
#pragma once

#include <span>
#include <vector>

#include "sim/method/model.h"
#include "sim/method/report.h"
#include "sim/method/state.h"

namespace tumble {

/// Bodies go from event to event (`exact/exact.h`). Bodies with joints fly in no closed form: a
/// scene that has joints goes on in steps of the course with an adaptive integrator.
/// @throws Refusal as the method that does it
void checkExactOrJoined(const Model& model, std::span<const RigidBody> bodies);
void advanceExactOrJoined(const Model& model, State& state, double t_end, Report& report);
void lookExactOrJoined(const Model& model, const State& state, double t,
                       std::vector<RigidBody>& bodies, std::vector<Contact>& contacts,
                       std::vector<JointForce>& joints);

}  // namespace tumble
