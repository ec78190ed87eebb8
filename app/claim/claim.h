// The closed-form truths that scenes are held to: one file each, a row each.
// A claim reads every parameter from the scene, so it holds for any scene it applies to.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/record/recording.h"

namespace tumble {

/// One quantity against its exact value. `error` is in the unit that the label names, else
/// relative.
struct ClaimRow {
  std::string label;
  double measured = 0.0, exact = 0.0;
  double error = 0.0, allowed = 0.0;
  bool silent = false;  ///< nothing was compared: the claim says nothing of this scene, and fails
  Relation relation = Relation::Equal;  ///< of measured to exact, but for what is allowed
  bool holds() const { return error <= allowed; }  ///< never for a NaN
};

/// "", "≤ " or "≥ ".
const char* signOf(Relation relation);

/// Keeps the worst of many comparisons as one row. Fails as long as nothing has been compared, and
/// for good once an error is not a number.
class WorstRow {
 public:
  WorstRow(std::string label, double allowed);
  /// @param where  which of the comparisons it is, for the label of the worst: "t = 1 s"
  void see(double measured, double exact, double error, const std::string& where = {});
  const ClaimRow& row() const { return row_; }

 private:
  std::string label_;
  ClaimRow row_;
  bool seen_ = false;
};

/// Where a claim expects a centre of mass to pass. World frame [m].
struct Curve {
  int body = 0;
  std::vector<Vec3> points;
};

/// A row of the table of claims.
struct Check {
  std::string_view name, summary;
  std::vector<ClaimRow> (*rows)(const Scene&, const Recording&);
  std::vector<Curve> (*expected)(const Scene&, const Recording&);  ///< null: nothing to draw
};

std::span<const Check> checks();

/// The row of that name, or null.
const Check* findCheck(std::string_view name);

/// A row that fails because the claim found nothing to hold.
ClaimRow emptyClaim(const std::string& what);

}  // namespace tumble
