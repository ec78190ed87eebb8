#include "sim/method/exact_or_joined.h"

#include "sim/method/course/course.h"
#include "sim/method/exact/exact.h"

namespace tumble {

void checkExactOrJoined(const Model& model, std::span<const RigidBody> bodies) {
  return model.joints.empty() ? checkExact(model, bodies) : checkCourse(model, bodies);
}

void advanceExactOrJoined(const Model& model, State& state, double t_end, Report& report) {
  if (model.joints.empty()) return advanceExact(model, state, t_end, report);
  report.note("bodies with joints fly in no closed form: all go on in steps of extrapolation");
  advanceCourse(model, state, t_end, report);
}

void lookExactOrJoined(const Model& model, const State& state, double t,
                       std::vector<RigidBody>& bodies, std::vector<Contact>& contacts,
                       std::vector<JointForce>& joints) {
  joints.clear();
  if (model.joints.empty())
    lookExact(model, state, t, bodies, contacts);
  else
    lookCourse(model, state, t, bodies, contacts, joints);
}

}  // namespace tumble
