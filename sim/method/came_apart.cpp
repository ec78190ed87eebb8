#include "sim/method/came_apart.h"

#include "sim/joint/joint_rows.h"

namespace tumble {

std::string cameApart(const Model& model, std::span<const RigidBody> bodies,
                      std::string_view step) {
  const Joint* open = brokenJoint(bodies, model.joints);
  if (!open) return "";
  return "joint \"" + model.def.joints[open - model.joints.data()].name +
         "\" came apart; try a smaller " + std::string(step) +
         ", or slack if it is pulled straight between two points that stand: no force bears a "
         "load across that";
}

}  // namespace tumble
