// Chapter 9, method: closed forms as long as there are any, steps in between.
#pragma once

#include <span>
#include <vector>

#include "sim/method/model.h"
#include "sim/method/report.h"
#include "sim/method/state.h"

namespace tumble {

/// What the row "exact" of the table of methods does: bodies go from event to event in closed form
/// (`exact/exact.h`); while contacts last that roll, tip or slide over an edge, all of them go on
/// in steps of the course (`course/course.h`), and closed forms are tried again after a while.
/// With joints all bodies go on in steps from the start.
/// @throws Refusal as both methods do
void checkFlightsAndSteps(const Model& model, std::span<const RigidBody> bodies);
void advanceFlightsAndSteps(const Model& model, State& state, double t_end, Report& report);
void lookFlightsAndSteps(const Model& model, const State& state, double t,
                         std::vector<RigidBody>& bodies, std::vector<Contact>& contacts,
                         std::vector<JointForce>& joints);

}  // namespace tumble
