#include "sim/method/auto.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "sim/method/method.h"

namespace tumble {
namespace {

/// Evaluations of the forces on one body that the exact method may spend, and in a second of the
/// scene: each costs 3 to 6 µs, in contact and with joints, so that its accuracy costs a few
/// seconds, or about as much time as the motion lasts. A step of stepping costs 13 µs a body. This
/// and what follows was measured by `tests/bench/sim/auto.cpp`.
constexpr long kMostEffort = 1'000'000;
constexpr double kEffortPerSecond = 300'000.0;
/// Bodies other than balls that can come to lie on each other. Half a second of four boxes that
/// tumble costs the exact method 1.1 s, of eight 5.6 s; stepping 15 and 21 ms.
constexpr int kMostSolids = 4;
/// Balls rest and roll on a floor in closed forms, at a quarter of what stepping costs; not so
/// between each other.
constexpr int kMostBalls = 16;
/// Parts of one body that cost as much as one more body: a nut of 48 on a bolt of 96 takes the
/// exact method 52 s for a quarter of a second, stepping 1.1.
constexpr std::size_t kParts = 16;
/// Rows of joints that an adaptive integrator follows cheaper than steps of stepping do.
constexpr std::size_t kMostJoints = 8;

bool serves(const Method& method, const Model& model, std::span<const RigidBody> bodies) {
  try {
    method.check(model, bodies);
    return true;
  } catch (const Refusal&) {
    return false;
  }
}

/// Bodies that move and can touch another one; of many parts, as many as these cost.
struct Counts {
  int balls = 0, solids = 0;
  int parts = 0;       ///< what stands in their way counts so much more
  bool fixed = false;  ///< something stands in their way

  bool few() const {
    return solids + (solids > 0 ? parts : 0) <= kMostSolids && balls <= kMostBalls;
  }
};

/// How many more bodies the parts of one count for.
int moreFor(const Shape& shape) {
  const Compound* compound = std::get_if<Compound>(&shape);
  return compound ? static_cast<int>(compound->parts.size() / kParts) : 0;
}

Counts countsOf(const Model& model) {
  Counts counts;
  for (const int i : model.solid) {
    const Shape& shape = model.shapes[i];
    const bool round =
        std::holds_alternative<Sphere>(shape) || std::holds_alternative<Particle>(shape);
    if (model.fixed(i)) {
      counts.fixed = true;
      counts.parts += moreFor(shape);
    } else {
      (round ? counts.balls : counts.solids) += 1 + moreFor(shape);
    }
  }
  return counts;
}

/// Whether bodies can come to lie on something: without that, hits are all that happens.
bool gathers(const Model& model, const Counts& counts) {
  return counts.fixed && !(model.def.gravity.isZero(0.0) && model.def.forces.empty());
}

/// Bodies as the exact method left them, for steps of the grid from here on.
void handOver(const Model& model, State& state, Report& report) {
  auto before = std::make_shared<const State>(std::move(state));
  state = State{};
  state.t = before->t;
  state.gridIndex = static_cast<long>(std::floor(before->t / model.def.stepping.step));
  state.bodies = before->bodies;
  state.externalImpulse = before->externalImpulse;
  state.momentumStart = before->momentumStart;
  state.momentumScale = before->momentumScale;
  state.kineticMax = before->kineticMax;
  state.energyLeast = before->energyLeast;
  state.momentumDrift = before->momentumDrift;
  state.load = before->load;
  state.loadPower = before->loadPower;
  for (const Contact& c : before->lasting)
    if (state.stepping.lasting.empty() || state.stepping.lasting.back().a != c.a ||
        state.stepping.lasting.back().b != c.b)
      state.stepping.lasting.push_back(lastingPair(c));
  state.before = std::move(before);
  report.stopped = false;
  report.note(("from t = " + shortNumber(state.t) + " s by stepping: " + report.reason).c_str());
  report.reason.clear();
}

}  // namespace

std::string_view chooseMethod(const Model& model, std::span<const RigidBody> bodies) {
  const Method &exact = *findMethod("exact"), &stepping = *findMethod("stepping");
  const Counts counts = countsOf(model);
  if (!model.bending.empty()) return "stepping";  // which says so where it cannot
  const bool few = !gathers(model, counts) || counts.few();
  if (few && model.joints.size() <= kMostJoints && serves(exact, model, bodies)) return "exact";
  if (serves(stepping, model, bodies)) return "stepping";
  return serves(exact, model, bodies) ? "exact" : "course";
}

long mostEffort(const Model& model) {
  constexpr double kMost = 1e18;  // that a count can hold
  return std::max(kMostEffort, std::lround(std::min(kMost, kEffortPerSecond * model.def.duration)));
}

void checkAuto(const Model& model, std::span<const RigidBody> bodies) {
  findMethod(model.runs)->check(model, bodies);
}

void advanceAuto(const Model& model, State& state, double t_end, Report& report) {
  if (!state.before) findMethod(model.runs)->advance(model, state, t_end, report);
  const Method& stepping = *findMethod("stepping");
  const bool gaveUp = report.stopped && !state.before && model.runs != "stepping";
  if (gaveUp && serves(stepping, model, state.bodies)) handOver(model, state, report);
  if (state.before && !report.stopped) stepping.advance(model, state, t_end, report);
}

void lookAuto(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
              std::vector<Contact>& contacts, std::vector<JointForce>& joints) {
  const bool earlier = state.before && t < state.before->t;
  const Method& method = *findMethod(state.before && !earlier ? "stepping" : model.runs);
  method.look(model, earlier ? *state.before : state, t, bodies, contacts, joints);
}

}  // namespace tumble
