// A world whose audit is told made-up states.
#pragma once

#include <optional>
#include <vector>

#include "sim/audit/audit.h"
#include "sim/body/mass_properties.h"
#include "tests/world/scenes.h"

namespace tumble::scenes {

inline RigidBody bodyOf(const BodyDef& def) {
  if (def.fixed)
    return makeFixedBody({def.position, def.orientation}, def.velocity, def.angularVelocity);
  RigidBody body =
      std::holds_alternative<Particle>(def.shape) ? makeParticle(*def.mass) : makeBody(massOf(def));
  body.x = def.position;
  body.q = def.orientation;
  updateDerived(body);
  setVelocity(body, def.velocity, def.angularVelocity);
  return body;
}

/// A world that is audited from states that a test makes up.
struct Told {
  explicit Told(const WorldDef& def) : world(def) {
    for (const BodyDef& body : def.bodies) bodies.push_back(bodyOf(body));
    audit.emplace(world.model(), bodies);
  }
  Certificate figures(double t) const {
    State state;
    state.t = t;
    Report report;
    audit->report(state, report);
    return report.certificate;
  }
  std::size_t disagreements() const {
    State state;
    state.t = world.model().def.duration;
    Report report;
    audit->report(state, report);
    return report.disagreements.size();
  }

  World world;
  std::vector<RigidBody> bodies;
  std::optional<Audit> audit;
};

}  // namespace tumble::scenes
