// Chapter 9, method: fixed bodies that move on come what may, and what they crush.
#pragma once

#include <span>
#include <string>
#include <utility>

#include "sim/contact/contact.h"
#include "sim/method/model.h"

namespace tumble {

/// Whether a body is fixed and moves.
bool drives(const Model& model, const RigidBody& body, int number);

/// Who is crushed by whom at t [s], in words.
/// @param pairs  the two bodies of each contact; one may be the number of bodies, the world
/// @param push   λ of each, as `endlessPush` has it
std::string crushWords(const Model& model, double t, std::span<const std::pair<int, int>> pairs,
                       std::span<const double> push);

/// The same for contacts that touch: empty unless a fixed body that moves is among them and no
/// velocities obey their normals.
std::string findCrushed(const Model& model, double t, std::span<const RigidBody> bodies,
                        std::span<const Contact> contacts);

/// The same after an impact that left this residual: empty unless no impulses were found, and
/// friction holds what is between them.
std::string findLocked(const Model& model, double t, std::span<const RigidBody> bodies,
                       std::span<const Contact> contacts, double residual);

}  // namespace tumble
