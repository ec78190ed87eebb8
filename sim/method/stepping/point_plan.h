// What `stepping` does with points of what bends that come into a solid (slides SH, cloth: "new
// contacts: generally inside").
#pragma once

#include <span>
#include <string_view>

namespace tumble {

/// A row of the table of plans for points. All keep a point that touches from moving further in,
/// with friction, and let go of one that parts.
struct PointPlan {
  std::string_view name, summary;
  /// Whether a point is met before it is inside. If not, it is found where a step left it.
  bool foresees;
  /// Share [1] of its overlap by which it is moved out after each step, whatever it hangs on.
  double share;
  /// Whether its way out is part of the implicit step, for all that it hangs on to follow.
  bool inStep;
};

/// All plans. To add one: write its row in point_plan.cpp.
std::span<const PointPlan> pointPlans();
const PointPlan* findPointPlan(std::string_view name);

}  // namespace tumble
