#include "sim/joint/joint_rows.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A joint as its bodies stand and move.
struct View {
  View(std::span<const RigidBody> bodies, const Joint& j)
      : joint(j),
        a(bodies[j.a]),
        b(partner(bodies, j.b)),
        pa(a.x + a.R * j.anchorA_B),
        pb(b.x + b.R * j.anchorB_B),
        frameA(a.R * j.frameA_B),
        frameB(b.R * j.frameB_B),
        spin(a.omega - b.omega) {}

  const Joint& joint;
  const RigidBody &a, &b;
  Vec3 pa, pb;
  Mat3 frameA, frameB;
  Vec3 spin;  // ωa − ωb
};

/// u·(pa − pb) with u fixed in b.
JointRow pointRow(const View& s, const Vec3& u) {
  const Vec3 ra = s.pa - s.a.x, rb = s.pa - s.b.x;
  const Vec3 slip = pointVelocity(s.a, s.pa) - pointVelocity(s.b, s.pa);
  const Vec3 bend = s.a.omega.cross(s.a.omega.cross(ra)) - s.b.omega.cross(s.b.omega.cross(rb)) -
                    2.0 * s.b.omega.cross(slip);
  return {.row = {.a = s.joint.a,
                  .b = s.joint.b,
                  .linear = u,
                  .angularA = ra.cross(u),
                  .angularB = -rb.cross(u),
                  .bias = u.dot(bend)},
          .gap = u.dot(s.pa - s.pb),
          .rate = u.dot(slip)};
}

/// |pa − pb|; where both are one point, along the vertical.
JointRow distanceRow(const View& s) {
  const Vec3 ra = s.pa - s.a.x, rb = s.pb - s.b.x, offset = s.pa - s.pb;
  const double size = offset.norm();
  const Vec3 d = size > 0.0 ? Vec3(offset / size) : Vec3(Vec3::UnitY());
  const Vec3 rate = pointVelocity(s.a, s.pa) - pointVelocity(s.b, s.pb);
  const Vec3 bend = s.a.omega.cross(s.a.omega.cross(ra)) - s.b.omega.cross(s.b.omega.cross(rb));
  const double across = (rate - rate.dot(d) * d).squaredNorm();
  return {.row = {.a = s.joint.a,
                  .b = s.joint.b,
                  .linear = d,
                  .angularA = ra.cross(d),
                  .angularB = -rb.cross(d),
                  .bias = d.dot(bend) + (size > 0.0 ? across / size : 0.0)},
          .gap = size,
          .rate = rate.dot(d)};
}

/// A row that turns alone:  (ωa − ωb)·n, with n changing at the rate ṅ.
JointRow turnRow(const View& s, double gap, const Vec3& n, const Vec3& ndot) {
  return {.row = {.a = s.joint.a,
                  .b = s.joint.b,
                  .linear = Vec3::Zero(),
                  .angularA = n,
                  .angularB = -n,
                  .bias = s.spin.dot(ndot)},
          .gap = gap,
          .rate = s.spin.dot(n),
          .arm = s.joint.arm};
}

/// w·u with w fixed in a and u in b.
JointRow axesRow(const View& s, const Vec3& w, const Vec3& u) {
  return turnRow(s, w.dot(u), w.cross(u),
                 s.a.omega.cross(w).cross(u) + w.cross(s.b.omega.cross(u)));
}

/// The turn of a against b about the axis.
JointRow angleRow(const View& s) {
  const Vec3 w = s.frameA.col(1), u = s.frameB.col(1), v = s.frameB.col(2);
  const double c = u.dot(w), y = v.dot(w), size = c * c + y * y;
  // θ˙ = (ωa − ωb)·n,  n = w × (c v − y u)/(c² + y²)
  const Vec3 inner = c * v - y * u, e = inner / size;
  const Vec3 du = s.b.omega.cross(u), dv = s.b.omega.cross(v);
  const double dc = s.spin.dot(w.cross(u)), dy = s.spin.dot(w.cross(v));
  const Vec3 de = (dc * v + c * dv - dy * u - y * du) / size - e * (2.0 * (c * dc + y * dy) / size);
  double turn = std::atan2(y, c);
  const double middle = 0.5 * (s.joint.lo + s.joint.hi);
  if (std::isfinite(middle)) turn -= 2.0 * kPi * std::round((turn - middle) / (2.0 * kPi));
  return turnRow(s, turn, w.cross(e), s.a.omega.cross(w).cross(e) + w.cross(de));
}

/// value ≥ lo and value ≤ hi, where these are finite.
void addLimits(const View& s, const JointRow& value, std::vector<JointRow>& rows) {
  if (std::isfinite(s.joint.lo)) {
    JointRow lower = value;
    lower.gap = value.gap - s.joint.lo;
    lower.limit = 0;
    rows.push_back(lower);
  }
  if (std::isfinite(s.joint.hi)) {
    JointRow upper = value;
    upper.gap = s.joint.hi - value.gap;
    upper.rate = -value.rate;
    upper.row.linear *= -1.0;
    upper.row.angularA *= -1.0;
    upper.row.angularB *= -1.0;
    upper.row.bias *= -1.0;
    upper.limit = 1;
    rows.push_back(upper);
  }
}

void addAxes(const View& s, std::vector<JointRow>& rows) {
  for (const auto& [w, u] : {std::pair(2, 1), std::pair(0, 2), std::pair(1, 0)})
    rows.push_back(axesRow(s, s.frameA.col(w), s.frameB.col(u)));
}

void addRows(const View& s, std::vector<JointRow>& rows) {
  const Joint& joint = s.joint;
  switch (joint.kind) {
    case JointKind::Ball:
    case JointKind::Hinge:
    case JointKind::Fixed:
      for (int k = 0; k < 3; ++k) rows.push_back(pointRow(s, s.frameB.col(k)));
      if (joint.kind == JointKind::Fixed) addAxes(s, rows);
      if (joint.kind != JointKind::Hinge) return;
      for (int k : {1, 2}) rows.push_back(axesRow(s, s.frameA.col(0), s.frameB.col(k)));
      return addLimits(s, angleRow(s), rows);
    case JointKind::Slider:
      for (int k : {1, 2}) rows.push_back(pointRow(s, s.frameB.col(k)));
      addAxes(s, rows);
      return addLimits(s, pointRow(s, s.frameB.col(0)), rows);
    case JointKind::Distance:
      JointRow row = distanceRow(s);
      if (std::isfinite(joint.lo) || std::isfinite(joint.hi)) return addLimits(s, row, rows);
      row.gap -= joint.length;
      rows.push_back(row);
  }
}

}  // namespace

void jointRows(std::span<const RigidBody> bodies, const Joint& joint, std::vector<JointRow>& rows) {
  rows.clear();
  addRows(View(bodies, joint), rows);
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].place = static_cast<int>(k);
}

double largestJointGap(std::span<const RigidBody> bodies, std::span<const Joint> joints) {
  thread_local std::vector<JointRow> rows;  // keeps its storage from call to call
  double largest = 0.0;
  for (const Joint& joint : joints) {
    jointRows(bodies, joint, rows);
    for (const JointRow& row : rows)
      largest = std::max(largest, row.arm * (row.limit < 0 ? std::abs(row.gap) : -row.gap));
  }
  return largest;
}

const Joint* brokenJoint(std::span<const RigidBody> bodies, std::span<const Joint> joints) {
  constexpr double kApart = 0.1;  // of the arm
  for (const Joint& joint : joints)
    if (!(largestJointGap(bodies, {&joint, 1}) < kApart * joint.arm)) return &joint;
  return nullptr;
}

}  // namespace tumble
