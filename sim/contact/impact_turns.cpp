// Pass after pass of an impact law, until nothing approaches any more.
#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "sim/contact/impact_pass.h"

namespace tumble {
namespace {

/// Residual of a pass that has no impulses: bodies that fixed ones leave nowhere to go.
constexpr double kHopeless = 1e-2;

bool drives(const RigidBody& body) {
  return body.fixed() && !(body.v.isZero(0.0) && body.omega.isZero(0.0));
}

/// What an impact changes, as it was.
class Before {
 public:
  explicit Before(const Impact& impact) : impulse_(impact.impulse.begin(), impact.impulse.end()) {
    for (const Contact& c : impact.contacts)
      for (const int i : {c.a, c.b}) keep(impact, i);
    if (!impact.bound()) return;
    bonds_ = *impact.bonds;
    for (const Row& row : bonds_.rows)
      for (const int i : {row.a, row.b})
        if (i < static_cast<int>(impact.bodies.size())) keep(impact, i);
  }

  void restore(const Impact& impact) const {
    for (const auto& [i, body] : bodies_) impact.bodies[static_cast<std::size_t>(i)] = body;
    std::copy(impulse_.begin(), impulse_.end(), impact.impulse.begin());
    if (impact.bound()) *impact.bonds = bonds_;
  }

 private:
  void keep(const Impact& impact, int i) {
    const RigidBody& body = impact.bodies[static_cast<std::size_t>(i)];
    if (!body.fixed()) bodies_.try_emplace(i, body);
  }

  std::map<int, RigidBody> bodies_;
  std::vector<Vec3> impulse_;
  Bonds bonds_;
};

/// Strikes what fixed bodies that move close in on, whose contacts hand each other on without end:
/// all at once, or, where no impulses take them apart, not at all.
ImpactReport strikeAtOnce(const Impact& impact, const Before& before) {
  before.restore(impact);
  ImpactReport report;
  strikeOnce(impact, PassKind::Inelastic, report);
  if (report.residual > kHopeless) {
    before.restore(impact);
    report = {.residual = report.residual};
  }
  report.finishedInelastic = true;
  return report;
}

}  // namespace

ImpactReport strikeUntilApart(const Impact& impact, PassKind kind, int passes) {
  constexpr int kMany = 1000;  // of a ball that a press jams in a wedge; what has room takes 500
  ImpactReport report;
  std::optional<Before> before;
  if (std::any_of(impact.bodies.begin(), impact.bodies.end(), drives)) before.emplace(impact);
  for (int pass = 0; pass < passes && anyApproaching(impact); ++pass) {
    strikeOnce(impact, kind, report);
    if (before && (report.residual > kHopeless || pass == kMany))
      return strikeAtOnce(impact, *before);
  }
  if (anyApproaching(impact)) {
    strikeOnce(impact, PassKind::Inelastic, report);
    report.finishedInelastic = true;
  }
  return report;
}

}  // namespace tumble
