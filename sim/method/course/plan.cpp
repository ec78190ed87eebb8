// The table of plans.
#include "sim/method/course/plan.h"

namespace tumble {
namespace {

constexpr Plan kPlans[] = {
    {"backstep", "the step ends at the instant of the collision (slide SH8)", true,
     [](const CourseSettings&) { return 0.0; }},
    {"gradual", "the overlap stands, and each step takes away a share of it (slide SH7)", false,
     [](const CourseSettings& course) { return 1.0 / course.repairSteps; }},
    {"lie", "at the end of the step the bodies are moved out of each other (slide SH9)", false,
     [](const CourseSettings&) { return 1.0; }},
};

}  // namespace

std::span<const Plan> plans() {
  return kPlans;
}

const Plan* findPlan(std::string_view name) {
  for (const Plan& plan : kPlans)
    if (plan.name == name) return &plan;
  return nullptr;
}

}  // namespace tumble
