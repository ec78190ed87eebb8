#include "sim/method/flights_and_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/method/course/course.h"
#include "sim/method/exact/exact.h"

namespace tumble {
namespace {

/// Steps before closed forms are tried again: the first time, and at most.
constexpr int kFirst = 8, kMost = 256;

/// One stretch of the course, from where the flights ended.
void goOneStep(const Model& model, State& state, Report& report) {
  if (!state.settled) {
    const double step = model.def.course.step;
    state.gridIndex = static_cast<long>(std::floor(state.t / step + 1e-9));
    state.patience = std::clamp(2 * state.patience, kFirst, kMost);
    state.stepsLeft = state.patience;
  }
  const double next = std::nextafter(state.t, std::numeric_limits<double>::infinity());
  const long whole = state.gridIndex;
  advanceCourse(model, state, next, report);
  if (state.gridIndex > whole) --state.stepsLeft;
  // Only where a whole step ended: stretches between events may be as short as time allows.
  if (state.lasting.empty()) state.patience = 0;
  if (state.gridIndex > whole && (state.stepsLeft <= 0 || state.lasting.empty()))
    state.inSteps = false;
}

}  // namespace

void checkFlightsAndSteps(const Model& model, std::span<const RigidBody> bodies) {
  if (model.joints.empty()) checkExact(model, bodies);
  checkCourse(model, bodies);
}

void advanceFlightsAndSteps(const Model& model, State& state, double t_end, Report& report) {
  if (!model.joints.empty()) {
    report.note("bodies with joints fly in no closed form: all go on in steps of dopri5");
    return advanceCourse(model, state, t_end, report);
  }
  for (;;) {
    if (!state.inSteps) advanceExact(model, state, t_end, report);
    if (state.t >= t_end || report.stopped) return;
    if (state.inSteps) goOneStep(model, state, report);
  }
}

void lookFlightsAndSteps(const Model& model, const State& state, double t,
                         std::vector<RigidBody>& bodies, std::vector<Contact>& contacts,
                         std::vector<JointForce>& joints) {
  joints.clear();
  const bool stepped = std::any_of(state.trail.begin(), state.trail.end(),
                                   [&](const Segment& s) { return s.t0 <= t && t < s.t1; });
  // At the end of a stretch of steps the bodies are where it left them: flights begin later.
  if (!model.joints.empty() || stepped || ((state.inSteps || state.settled) && t >= state.t))
    lookCourse(model, state, t, bodies, contacts, joints);
  else
    lookExact(model, state, t, bodies, contacts);
}

}  // namespace tumble
