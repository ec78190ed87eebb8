// What `course` does with a step that leads bodies into each other (slides SD29, SH6–SH9).
#pragma once

#include <span>
#include <string_view>

#include "sim/method/model.h"

namespace tumble {

/// A row of the table of plans.
struct Plan {
  std::string_view name, summary;
  /// Whether a step ends at the instant of a collision; if not, it goes on into the overlap.
  bool backsUp;
  /// Share [1] of each overlap that is taken away at the end of a step.
  double (*share)(const CourseSettings&);
};

/// All plans. To add one: write its row in plan.cpp.
std::span<const Plan> plans();
const Plan* findPlan(std::string_view name);

}  // namespace tumble
