#include "sim/contact/impact.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/impulse.h"

namespace tumble {
namespace {

constexpr ImpactLaw kLaws[] = {
    {"auto", "reflections where a blow reaches few contacts, else crowd", impactAuto},
    {"reflections", "Newton's law at all approaching contacts at once, again and again",
     impactReflections},
    {"crowd",
     "one problem for all that a blow reaches; what compression took is given back in part",
     impactCrowd},
    {"simultaneous", "Newton's law at all contacts at once, as one LCP", impactSimultaneous},
    {"sequential", "Newton's law at one contact after the other", impactSequential},
    {"poisson", "what compression took is given back in part", impactPoisson},
};

}  // namespace

std::span<const ImpactLaw> impactLaws() {
  return kLaws;
}

const ImpactLaw* findImpactLaw(std::string_view name) {
  for (const ImpactLaw& law : kLaws)
    if (law.name == name) return &law;
  return nullptr;
}

std::vector<int> reachOfImpact(const Impact& impact) {
  const auto approaching = [&](const Contact& c) {
    return approachVelocity(impact.bodies[c.a], impact.bodies[c.b], c.point) <
           -impact.tolerance.rest;
  };
  std::vector<char> bodyReached(impact.bodies.size(), 0), reached(impact.contacts.size(), 0);
  const auto reachBody = [&](int body) {
    if (impact.bodies[body].fixed()) return;
    bodyReached[body] = 1;
  };
  const auto reachBond = [&](const Row& row) {
    reachBody(row.a);
    if (row.b < static_cast<int>(impact.bodies.size())) reachBody(row.b);
  };
  bool grew = false;
  for (std::size_t i = 0; impact.bound() && i < impact.bonds->rows.size(); ++i) {
    const Row& row = impact.bonds->rows[i];
    if (bondVelocity(row, impact.bodies) >= -impact.tolerance.rest) continue;
    grew = true;
    reachBond(row);
  }
  for (std::size_t i = 0; i < impact.contacts.size(); ++i) {
    if (!approaching(impact.contacts[i])) continue;
    reached[i] = 1;
    grew = true;
    reachBody(impact.contacts[i].a);
    reachBody(impact.contacts[i].b);
  }
  while (grew) {
    grew = false;
    for (std::size_t i = 0; impact.bound() && i < impact.bonds->rows.size(); ++i) {
      const Row& row = impact.bonds->rows[i];
      const bool inWorld = row.b >= static_cast<int>(impact.bodies.size());
      if (inWorld || impact.bodies[row.a].fixed() || impact.bodies[row.b].fixed() ||
          bodyReached[row.a] == bodyReached[row.b])
        continue;
      grew = true;
      reachBond(row);
    }
    for (std::size_t i = 0; i < impact.contacts.size(); ++i) {
      const Contact& c = impact.contacts[i];
      if (reached[i] || !(bodyReached[c.a] || bodyReached[c.b])) continue;
      reached[i] = 1;
      grew = true;
      reachBody(c.a);
      reachBody(c.b);
    }
  }
  std::vector<int> list;
  for (std::size_t i = 0; i < reached.size(); ++i)
    if (reached[i]) list.push_back(static_cast<int>(i));
  return list;
}

ImpulseEnergy applyContactImpulse(const Impact& impact, int contact, const Vec3& J) {
  const Contact& c = impact.contacts[contact];
  RigidBody& a = impact.bodies[c.a];
  RigidBody& b = impact.bodies[c.b];
  const double before = kineticEnergy(a) + kineticEnergy(b);
  ImpulseEnergy energy;
  if (a.fixed()) energy.work = -J.dot(pointVelocity(a, c.point.p));
  if (b.fixed()) energy.work = J.dot(pointVelocity(b, c.point.p));
  applyImpulse(a, c.point.p, J);
  applyImpulse(b, c.point.p, -J);
  energy.lost = before - (kineticEnergy(a) + kineticEnergy(b)) + energy.work;
  impact.impulse[contact] += J;
  return energy;
}

}  // namespace tumble
