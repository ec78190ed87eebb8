// [[expect]]: what a scene's author claims of it by a formula.
#pragma once

#include <vector>

#include "app/claim/claim.h"

namespace tumble {

/// What came of one of them.
struct Expectation {
  ClaimRow row;
  /// Where a body's centre should have been when it was measured, of a formula that is one
  /// coordinate of it.
  std::optional<Vec3> place = {};
  int axis = 0;           ///< of that coordinate
  std::size_t index = 0;  ///< which of the scene's it is
};

/// Its name in tables: "y of the ball, max".
std::string labelOf(const ExpectDef& expect);

/// In the order of the scene. One at an instant between samples, as a recording at another rate has
/// them, is left out; one at an instant that the run did not reach fails.
std::vector<Expectation> expectationsOf(const Scene& scene, const Recording& recording);

/// What is wrong with the formulas of a scene, in [[expect]] and [[graph]]: no formula, or a name
/// that nothing has; each with its place in the text.
std::vector<Diagnostic> faultsOfFormulas(const Scene& scene);

}  // namespace tumble
