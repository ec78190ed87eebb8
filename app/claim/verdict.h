// A scene held to its claims.
#pragma once

#include <string>
#include <vector>

#include "app/claim/claim.h"

namespace tumble {

struct Verdict {
  std::vector<ClaimRow> rows;
  std::vector<std::size_t> expects;  ///< the last rows are of these of the scene's [[expect]]
  int failed = 0;                    ///< rows that do not hold
  std::string worst;        ///< label of the row nearest to, or furthest beyond, what is allowed
  double worstShare = 0.0;  ///< its error / allowed
};

/// All rows of all checks that the scene names, one for each disagreement of the audit, and what
/// the scene expects by formulas.
Verdict judge(const Scene& scene, const Recording& recording);

/// "all 3 claims hold", "2 of 3 claims fail", as many as there are; "" of none.
std::string toldOf(const Verdict& verdict);

/// @throws SceneError if the scene names a check that the table does not have, or expects something
/// of what is no formula.
void requireKnownChecks(const Scene& scene);

}  // namespace tumble
