// Chapter 11: what a World is made of.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/audit/audit.h"
#include "sim/method/method.h"
#include "sim/world.h"

namespace tumble {

/// All of a world that changes: state with each method's memory, books, audit. A value; copies
/// share only what is worked with and then forgotten.
struct Changing {
  State state;
  Report report;
  std::optional<Audit> audit;
  double lastAdvance = 0.0;  ///< [s]
};

struct World::Parts {
  /// Everything but the rules for neighbours and the books.
  /// @throws Refusal
  void build(const WorldDef& def);
  /// The same, in numbers that count from an origin near the scene.
  void place(const WorldDef& def);

  Vec3 weight() const;             ///< [N] of all that moves
  Sample told(Sample here) const;  ///< in the numbers of the scene
  Sample here(Sample told) const;  ///< in those of the model
  void tellAnew();                 ///< brings `seenReport` up to date, if it was asked for

  Vec3 origin = Vec3::Zero();  ///< [m] what the scene calls the place where the model has zero
  std::shared_ptr<Model> made = std::make_shared<Model>();  ///< what was saved knows it again
  Model& model = *made;
  const Method* method = nullptr;
  std::unique_ptr<Changing> now = std::make_unique<Changing>();
  std::vector<RigidBody> seen;  ///< scratch of `sample`, so that looking does not allocate
  std::vector<Contact> seenContacts;
  std::vector<JointForce> seenJoints;
  std::optional<Report> seenReport;  ///< in the numbers of the scene
};

struct SavedWorld::Held {
  std::shared_ptr<const Model> of;
  Changing moment;
};

}  // namespace tumble
