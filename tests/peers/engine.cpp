#include "tests/peers/engine.h"

#include <algorithm>

namespace tumble::peers {

Surface commonSurface(const WorldDef& world) {
  if (!world.forces.empty() || !world.joints.empty() || !world.pairs.empty())
    throw CannotExpress("forces, joints or pairs");
  const BodyDef& first = world.bodies.front();
  for (const BodyDef& body : world.bodies) {
    if (!std::holds_alternative<Sphere>(body.shape) && !std::holds_alternative<Box>(body.shape) &&
        !std::holds_alternative<HalfSpace>(body.shape))
      throw CannotExpress("a " + std::string(shapeName(body.shape)));
    if (body.restitution != first.restitution || body.friction != first.friction)
      throw CannotExpress("more than one material");
  }
  return {first.restitution, first.friction};
}

bool meantFor(const EngineSetup& setup, const WorldDef& world) {
  const auto moving = std::count_if(world.bodies.begin(), world.bodies.end(), [](const auto& body) {
    return !body.fixed && !std::holds_alternative<HalfSpace>(body.shape);
  });
  switch (setup.meant) {
    case Meant::OneMoves:
      return moving == 1;
    case Meant::ManyMove:
      return moving > 1;
    case Meant::FewMove:
      return moving <= 50;
    default:
      return true;
  }
}

std::vector<EngineSetup> allSetups() {
  std::vector<EngineSetup> all = tumbleSetups();
  [[maybe_unused]] const auto add = [&](std::vector<EngineSetup> setups) {
    std::move(setups.begin(), setups.end(), std::back_inserter(all));
  };
#ifdef PEERS_BULLET
  add(bulletSetups());
#endif
#ifdef PEERS_ODE
  add(odeSetups());
#endif
#ifdef PEERS_MUJOCO
  add(mujocoSetups());
#endif
#ifdef PEERS_DART
  add(dartSetups());
#endif
#ifdef PEERS_SIMBODY
  add(simbodySetups());
#endif
  return all;
}

}  // namespace tumble::peers
