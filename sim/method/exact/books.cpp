// The certificate of a run without steps: everything is known in closed form, so the books are
// kept where something changes.
#include "sim/method/exact/exact.h"

namespace tumble {

void Exact::bringTo(double t, int body) {
  state_.exact.flights[body].back().at(t, state_.bodies[body]);
  for (std::size_t k = 0; k < state_.exact.tops.size(); ++k)
    if (model_.pivots[k].body == body) state_.exact.tops[k].at(t, state_.bodies[body]);
}

void Exact::stop(std::string reason) {
  report_.stopped = true;
  report_.reason = std::move(reason);
  keepBooks(state_.t);
}

/// What lasting contacts did since they were last booked: constant forces along paths that are
/// known at both ends and at constant acceleration between.
void Exact::bookHolds(double t) {
  const double h = t - state_.exact.bookedHold;
  if (h > 0.0 && !state_.lasting.empty()) {
    const auto way = [&](int i) -> Vec3 {
      RigidBody body = state_.bodies[i];
      state_.exact.flights[i].back().at(state_.exact.bookedHold, body);
      const Vec3 v = body.v;
      state_.exact.flights[i].back().at(t, body);
      return 0.5 * h * (v + body.v);
    };
    Certificate& books = report_.certificate;
    for (const Contact& c : state_.lasting) {
      const Vec3 wayA = way(c.a), wayB = way(c.b);
      books.energy_lost_friction -= c.force.dot(wayA - wayB);
      if (model_.fixed(c.b)) {
        state_.externalImpulse += h * c.force;
        books.work_of_forces += c.force.dot(wayB);
      } else if (model_.fixed(c.a)) {
        state_.externalImpulse -= h * c.force;
        books.work_of_forces -= c.force.dot(wayA);
      }
    }
  }
  state_.exact.bookedHold = t;
}

void Exact::keepBooks(double t) {
  for (int i = 0; i < model_.count(); ++i) {
    bringTo(t, i);
    const RigidBody& body = state_.bodies[i];
    if (report_.stopped || (body.x.allFinite() && body.q.coeffs().allFinite() &&
                            body.v.allFinite() && body.omega.allFinite()))
      continue;
    report_.stopped = true;
    report_.reason =
        "\"" + nameOf(i) + "\" leaves the range of numbers before t = " + digits(t) + " s";
    return;
  }
  bookHolds(t);
  const double h = t - state_.exact.booked;
  for (int i = 0; i < model_.count(); ++i) {
    const RigidBody& body = state_.bodies[i];
    if (body.fixed()) continue;
    if (model_.def.bodies[i].pivot_B) {  // the pivot gives what momentum it gains, and no work
      state_.externalImpulse += body.P - state_.exact.bookedP[i];
    } else {
      // Gravity has a potential; of what acts besides, work is force times way.
      state_.externalImpulse += h * state_.exact.outer[i];
      report_.certificate.work_of_forces += (state_.exact.outer[i] - body.M * model_.def.gravity)
                                                .dot(body.x - state_.exact.bookedX[i]);
    }
    state_.exact.bookedX[i] = body.x;
    state_.exact.bookedP[i] = body.P;
  }
  state_.exact.booked = state_.t = t;
  account(model_, state_, report_);
}

}  // namespace tumble
