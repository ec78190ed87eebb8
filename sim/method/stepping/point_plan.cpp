#include "sim/method/stepping/point_plan.h"

namespace tumble {

std::span<const PointPlan> pointPlans() {
  static constexpr PointPlan kTable[] = {
      {"gradual", "a point found inside is moved out by a quarter a step", false, 0.25, false},
      {"displace", "a point found inside is moved out at once", false, 1.0, false},
      {"implicit", "a point found inside is moved out within the implicit step", false, 0.0, true},
      {"constraint", "no point gets inside: the implicit step foresees contacts", true, 0.0, false},
  };
  return kTable;
}

const PointPlan* findPointPlan(std::string_view name) {
  for (const PointPlan& plan : pointPlans())
    if (plan.name == name) return &plan;
  return nullptr;
}

}  // namespace tumble
