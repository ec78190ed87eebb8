// Chapter 9, method: the row "auto" of the table of methods, which leaves a scene to another row.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sim/method/model.h"
#include "sim/method/report.h"
#include "sim/method/state.h"

namespace tumble {

/// The row that runs a scene whose method is "auto", by what the scene holds, never by a clock:
///   `exact`, where its closed forms hold and few bodies can come to lie on each other;
///   else `stepping`, where bodies can touch, and `course`, where they cannot.
/// Joints and forces may leave no choice. With `exact` goes a count of evaluations after which it
/// gives up (kMostEffort in auto.cpp).
std::string_view chooseMethod(const Model& model, std::span<const RigidBody> bodies);

/// How much work the exact method may do in such a scene; see Effort.
long mostEffort(const Model& model);

/// @throws Refusal as the method that was chosen
void checkAuto(const Model& model, std::span<const RigidBody> bodies);
/// Where the exact method gives up, stepping goes on from that state, and a note says so.
void advanceAuto(const Model& model, State& state, double t_end, Report& report);
void lookAuto(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
              std::vector<Contact>& contacts, std::vector<JointForce>& joints);

}  // namespace tumble
