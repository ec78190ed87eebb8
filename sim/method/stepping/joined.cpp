// What joints gave to the bodies in a step, for the books and for those who look.
#include "sim/method/stepping/stepping.h"

namespace tumble {

void Stepping::bookJoints(double h) {
  const OuterBonds outer = outerBonds(bonds_, state_.bodies);
  state_.externalImpulse += outer.force;
  report_.certificate.work_of_forces += outer.power;
  for (std::size_t i = 0; i < bonds_.rows.size(); ++i) {
    const Row& row = bonds_.rows[i];
    if (bonds_.kinds[i] != ConeKind::Push) continue;
    // A limit takes λ times the mean of the rates before and after.
    double rate = 0.0;
    for (const std::vector<Vec6>* v : {&before_, &after_})
      rate += 0.5 * rowSpeed(row, (*v)[row.a], (*v)[row.b]);
    report_.certificate.energy_lost_impact -= bonds_.lambda[i] * rate;
  }
  state_.trail.back().joints = jointForces(state_.trail.back().start, model_.joints, bonds_, h);
}

}  // namespace tumble
