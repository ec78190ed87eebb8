// The table of methods.
#include "sim/method/auto.h"
#include "sim/method/course/course.h"
#include "sim/method/exact_or_joined.h"
#include "sim/method/method.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {
namespace {

constexpr Method kMethods[] = {
    {"auto", "exact while little stays in contact, else stepping: chosen by what the scene holds",
     checkAuto, advanceAuto, lookAuto, true},
    {"course", "the notes: ODE black box, back up to the collision, impulses, resting forces",
     checkCourse, advanceCourse, lookCourse, true},
    {"exact", "from event to event in closed form: no step, no overlap, no missed hit",
     checkExactOrJoined, advanceExactOrJoined, lookExactOrJoined, true},
    {"stepping", "one velocity-level contact problem per step, for stacks and piles", checkStepping,
     advanceStepping, lookStepping, true},
};

}  // namespace

std::span<const Method> methods() {
  return kMethods;
}

const Method* findMethod(std::string_view name) {
  for (const Method& method : kMethods)
    if (method.name == name) return &method;
  return nullptr;
}

void refuseWhatBends(const Model& model, const std::string& why) {
  for (const Force& force : model.def.forces)
    if (const auto* bending = std::get_if<Bending>(&force))
      throw Refusal("method", "\"" + model.def.method + "\" " + why + ", as \"" +
                                  bending->body->name + "\" does; take \"stepping\" or \"auto\"");
}

}  // namespace tumble
