#include "sim/method/impacts.h"

#include <algorithm>

namespace tumble {
namespace {

bool samePair(const Contact& c, const Contact& d) {
  return c.a == d.a && c.b == d.b;
}

bool sameNormal(const Contact& c, const Contact& d) {
  constexpr double kOneNormal = 1e-9;  // [1] what rounding leaves of a shared face
  return (c.point.n - d.point.n).squaredNorm() < kOneNormal * kOneNormal;
}

}  // namespace

void bookImpact(const ImpactReport& impact, Report& report) {
  Certificate& books = report.certificate;
  books.energy_lost_impact += impact.lostNormal;
  books.energy_lost_friction += impact.lostFriction;
  books.work_of_forces += impact.work;
  books.energy_cut_impact += impact.cut;
  books.max_complementarity = std::max(books.max_complementarity, impact.residual);
  if (impact.finishedInelastic)
    report.note("impacts that did not come to an end were finished without rebound");
}

std::vector<Event> impactEvents(const Model& model, State& state, double t,
                                std::span<const Contact> contacts, std::span<const double> vrel,
                                std::span<const Vec3> impulse) {
  std::vector<Event> events;
  for (std::size_t i = 0, pair = 0; i < contacts.size(); ++i) {
    const Contact& first = contacts[i];
    if (model.fixed(first.b)) state.externalImpulse += impulse[i];
    if (model.fixed(first.a)) state.externalImpulse -= impulse[i];
    if (!samePair(contacts[pair], first)) pair = i;
    const auto alike = [&](const Contact& c) { return sameNormal(c, first); };
    if (std::any_of(contacts.begin() + pair, contacts.begin() + i, alike)) continue;
    Event event{.t = t, .kind = EventKind::Impact, .a = first.a, .b = first.b};
    event.n = first.point.n;
    event.p.setZero();
    for (std::size_t k = i; k < contacts.size() && samePair(contacts[k], first); ++k) {
      if (!alike(contacts[k])) continue;
      const double j = impulse[k].dot(event.n);
      event.p += j * contacts[k].point.p;
      event.j += j;
      event.vrel = std::min(event.vrel, vrel[k]);
    }
    if (event.j <= 0.0) continue;
    event.p /= event.j;
    events.push_back(event);
  }
  return events;
}

bool leansOn(const Event& impact, std::span<const RigidBody> bodies, double keep) {
  const double kick = impact.j * (bodies[impact.a].invM + bodies[impact.b].invM);
  return impact.vrel > -keep && kick < keep;
}

}  // namespace tumble
