#include "app/scene/choices.h"

#include "sim/body/inertia_method.h"
#include "sim/contact/impact.h"
#include "sim/method/course/contact_model.h"
#include "sim/method/course/plan.h"
#include "sim/method/stepping/point_plan.h"
#include "sim/ode/integrator.h"
#include "sim/problem/problem.h"
#include "sim/world.h"

namespace tumble {

namespace {

template <class Rows>
std::vector<std::string> namesOf(const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& row : rows) names.emplace_back(row.name);
  return names;
}

}  // namespace

std::vector<std::string> methodChoices() {
  return namesOf(methodNames());
}
std::vector<std::string> impactChoices() {
  return namesOf(impactLaws());
}
std::vector<std::string> integratorChoices() {
  return namesOf(integrators());
}
std::vector<std::string> solverChoices() {
  return namesOf(solvers());
}
std::vector<std::string> presetChoices() {
  return namesOf(solverPresets());
}
std::vector<std::string> pointPlanChoices() {
  return namesOf(pointPlans());
}
std::vector<std::string> attitudeChoices() {
  return {"quaternion", "matrix"};
}
std::vector<std::string> inertiaChoices() {
  return namesOf(inertiaMethods());
}
std::vector<std::string> planChoices() {
  return namesOf(plans());
}
std::vector<std::string> contactChoices() {
  return namesOf(contactModels());
}

}  // namespace tumble
