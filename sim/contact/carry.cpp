#include "sim/contact/carry.h"

#include <algorithm>

#include "sim/body/mass_properties.h"
#include "sim/contact/modes.h"
#include "sim/contact/rows.h"
#include "sim/problem/solvers.h"

namespace tumble {

bool canCarry(const RigidBody& a, const RigidBody& b, std::span<const Contact> contacts,
              double off) {
  // The load, on the body that it moves most.
  const RigidBody bodies[] = {a.invM > b.invM ? a : b, makeFixedBody(Pose{})};
  const RigidBody& body = bodies[0];
  Vec6 load = Vec6::Zero();
  double reach = 0.0;
  Problem problem;
  beginVelocityProblem(bodies, problem);
  const auto add = [&](const Contact& c, const Vec3& d) {
    problem.rows.push_back(pointRow(bodies, 0, 1, c.point.p, d, 0.0));
  };
  for (const Contact& c : contacts) {
    const Vec3 arm = c.point.p - body.x;
    load.head<3>() += c.force;
    load.tail<3>() += arm.cross(c.force);
    reach = std::max(reach, arm.norm());
    if (c.idle) continue;
    const bool rubs = c.friction > 0.0, slides = rubs && c.sliding;
    problem.cones.push_back(
        {.kind = slides ? ConeKind::Slide : (rubs ? ConeKind::Friction : ConeKind::Push),
         .row = static_cast<int>(problem.rows.size()),
         .mu = c.friction});
    add(c, c.point.n);
    if (!rubs) continue;
    Vec3 t1, t2;
    tangents(c.point.n, Vec3::Zero(), t1, t2);
    add(c, slides ? slipDirectionOf(a, b, c) : t1);
    if (!slides) add(c, t2);
  }
  // Contacts that hold the body still under the opposite of their load can carry it.
  problem.vStar[0] << -body.invM * load.head<3>(), -body.Iinv * load.tail<3>();
  Solution solution;
  findSolver("newton")->solve(problem, {}, solution);
  const Vec6& v = solution.v[0];
  return v.allFinite() && v.head<3>().norm() <= off && reach * v.tail<3>().norm() <= off;
}

}  // namespace tumble
