// Bodies in joints that hang still: what rounding leaves of forces that cancel is no force.
#include "sim/method/course/course.h"

namespace tumble {
namespace {

/// [1] Forces on a body that leave less than this part of their sum cancel: solvers leave 1e-11 of
/// a load of a million links, and a chain bent by this angle [rad] would swing no wider.
constexpr double kCancels = 1e-10;

}  // namespace

// Light links under a heavy load would be shaken by what is left, faster than it can be followed.
bool Course::rests() {
  const bool bare = state_.lasting.empty() && state_.limits.empty() && model_.def.forces.empty();
  if (model_.joints.empty() || !bare) return false;
  for (const RigidBody& body : state_.bodies)
    if (!body.v.isZero(0.0) || !body.omega.isZero(0.0)) return false;
  trial_ = state_.bodies;
  system_.findForces(trial_);
  std::vector<double> pull(trial_.size() + 1, 0.0);  // [N] on each body; the last is the world
  for (std::size_t i = 0; i < trial_.size(); ++i) pull[i] = trial_[i].M * model_.def.gravity.norm();
  for (const JointForce& joint : system_.jointForces(trial_)) {
    pull[joint.a] += joint.force.norm();
    pull[joint.b] += joint.force.norm();
  }
  for (std::size_t i = 0; i < trial_.size(); ++i) {
    const RigidBody& body = trial_[i];
    if (body.fixed()) continue;
    const double allowed = kCancels * pull[i];
    if (body.force.norm() > allowed) return false;
    if (body.torque.norm() > boundingRadius(model_.shapes[i]) * allowed) return false;
  }
  return true;
}

}  // namespace tumble
