// Which settings of `course` cannot be.
#include <algorithm>
#include <cmath>

#include "sim/method/course/course.h"

namespace tumble {
namespace {

template <class Rows>
std::string namesOf(const Rows& rows) {
  std::string names;
  for (const auto& row : rows) names += (names.empty() ? "" : ", ") + std::string(row.name);
  return names;
}

/// Whether two bodies could rub.
bool mayRub(const WorldDef& def) {
  const auto rough = [](const BodyDef& body) { return body.friction > 0.0; };
  return std::count_if(def.bodies.begin(), def.bodies.end(), rough) > 1 ||
         std::any_of(def.pairs.begin(), def.pairs.end(),
                     [](const PairDef& pair) { return pair.friction.value_or(0.0) > 0.0; });
}

void checkContact(const Model& model) {
  const CourseSettings& course = model.def.course;
  const Plan* plan = findPlan(course.plan);
  if (!plan)
    throw Refusal("course.plan",
                  "no plan is called \"" + course.plan + "\"; there are: " + namesOf(plans()));
  if (course.repairSteps < 1)
    throw Refusal("course.repair_steps", "a repair takes a whole number of steps, 1 or more");
  const ContactModel* contact = findContactModel(course.contact);
  if (!contact)
    throw Refusal("course.contact", "no contact model is called \"" + course.contact +
                                        "\"; there are: " + namesOf(contactModels()));
  if (!(course.stiffness > 0.0 && std::isfinite(course.stiffness)))
    throw Refusal("course.stiffness", "a stiffness must be a positive number of N/m");
  if (!(course.damping >= 0.0 && std::isfinite(course.damping)))
    throw Refusal("course.damping", "a damping must be 0 N s/m or more");
  if (!model.joints.empty() && !(contact->impulses && plan->backsUp))
    throw Refusal(contact->impulses ? "course.plan" : "course.contact",
                  "joints need the plan \"backstep\" and the contact model \"constraint\"");
  if (!model.joints.empty() && model.def.course.attitude == "matrix")
    throw Refusal("course.attitude", "joints need the attitude \"quaternion\"");
  if (contact->impulses) return;
  if (!plan->backsUp)
    throw Refusal("course.plan", "\"" + course.contact +
                                     "\" lives on overlap, so there is nothing to repair; leave "
                                     "the plan out");
  if (mayRub(model.def))
    throw Refusal("course.contact", "the springs of \"" + course.contact +
                                        "\" do not rub; take friction 0, or \"constraint\"");
}

}  // namespace

void checkCourse(const Model& model, std::span<const RigidBody> bodies) {
  refuseWhatBends(model, "follows nothing that bends");
  const CourseSettings& course = model.def.course;
  const Integrator* row = findIntegrator(course.integrator);
  if (!row)
    throw Refusal("course.integrator", "no integrator is called \"" + course.integrator + "\"");
  requireStep("course.step", course.step, model.def.duration);
  checkContact(model);
  if (course.order < 1 || course.order > kHighestOrder)
    throw Refusal("course.order",
                  "an order must be a whole number from 1 to " + std::to_string(kHighestOrder));
  if (!(course.tolerance >= kLeastTolerance && course.tolerance <= 1.0))
    throw Refusal("course.tolerance", "a tolerance must be a number from 1e-14 to 1");
  if (course.attitude != "quaternion" && course.attitude != "matrix")
    throw Refusal("course.attitude", "no attitude is called \"" + course.attitude +
                                         "\"; there are: quaternion, matrix");
  const CourseSystem system(model, bodies);
  if (const std::string_view lack = missing(system.offers(), row->needs); !lack.empty())
    throw Refusal("course.integrator", "\"" + course.integrator + "\" needs " + std::string(lack) +
                                           ", which this scene does not offer");
}

}  // namespace tumble
