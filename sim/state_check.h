// Chapter 11: whether a state is legal – its positions, its velocities, its accelerations.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/method/model.h"

namespace tumble {

/// The layers of a state, each of which can be wrong while those before it are right (the three
/// "Problem" slides of the lecture on contact).
enum class StateLayer { Positions, Velocities, Accelerations };

/// "positions", "velocities" or "accelerations".
const char* layerName(StateLayer layer);

/// What is wrong between two bodies, at the worst of their contact points. World frame, SI.
struct StateFault {
  StateLayer layer = StateLayer::Positions;
  int a = 0, b = 0;
  Vec3 p = Vec3::Zero(), n = Vec3::UnitY();  ///< n out of b towards a
  double amount = 0.0;                       ///< < 0: separation [m], vrel [m/s] or n·p″ [m/s²]
};

/// All contact points within touching distance of each other, and those that overlap.
std::vector<Contact> touchingContacts(const Model& model, std::span<const RigidBody> bodies);

/// Pairs that overlap: separation < −tolerance.
std::vector<StateFault> overlapping(const Model& model, std::span<const Contact> contacts);

/// Pairs that approach where they touch: vrel < −tolerance (slide SD30).
std::vector<StateFault> approaching(const Model& model, std::span<const RigidBody> bodies,
                                    std::span<const Contact> contacts);

/// Pairs that rest where they touch, and whose forces do not hold n·p″ ≥ 0 (slide SD48).
/// @param bodies  with all forces, those of contacts too
std::vector<StateFault> sinking(const Model& model, std::span<const RigidBody> bodies,
                                std::span<const Contact> contacts);

/// Adds the forces of the scene's contact model to bodies that carry their outer forces, and to the
/// contacts that rest: those that hold n·p″ ≥ 0, or those of springs.
void addContactForces(const Model& model, std::span<RigidBody> bodies,
                      std::vector<Contact>& contacts);

}  // namespace tumble
