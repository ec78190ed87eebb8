#include "sim/body/force.h"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

using Bodies = std::span<RigidBody>;
using ConstBodies = std::span<const RigidBody>;

/// Calls act(body) for the one body of a force, or for each, fixed ones left out.
template <class Span, class Action>
void forEachFree(Span bodies, int index, Action act) {
  const std::size_t first = index == kNoBody ? 0 : index;
  const std::size_t end = index == kNoBody ? bodies.size() : first + 1;
  for (std::size_t i = first; i < end; ++i)
    if (!bodies[i].fixed()) act(bodies[i]);
}

/// One end of a spring: where it is and how fast it moves. World frame.
struct End {
  Vec3 p, v;
};

End endOf(ConstBodies bodies, int index, const Vec3& anchor_B) {
  if (index == kNoBody) return {anchor_B, Vec3::Zero()};
  const Vec3 p = bodies[index].R * anchor_B + bodies[index].x;
  return {p, pointVelocity(bodies[index], p)};
}

bool isFree(ConstBodies bodies, int index) {
  return index != kNoBody && !bodies[index].fixed();
}

/// What a spring does at this moment; one of no length has no direction and pulls at nothing.
struct Pull {
  End a, b;
  Vec3 force = Vec3::Zero();  ///< [N] on a
  double stretch = 0.0;       ///< [m] l − rest
  double rate = 0.0;          ///< [m/s] l̇
};

Pull pullOf(const Spring& s, ConstBodies bodies) {
  Pull pull{endOf(bodies, s.a, s.anchorA_B), endOf(bodies, s.b, s.anchorB_B)};
  const Vec3 span = pull.a.p - pull.b.p;
  const double length = span.norm();
  pull.stretch = length - s.rest;
  if (length == 0.0) return pull;
  const Vec3 along = span / length;
  pull.rate = along.dot(pull.a.v - pull.b.v);
  pull.force = -(s.stiffness * pull.stretch + s.damping * pull.rate) * along;
  return pull;
}

void add(const UniformWind& wind, Bodies bodies) {
  forEachFree(bodies, wind.body, [&](RigidBody& body) { body.force += wind.force; });
}

void add(const LinearDrag& drag, Bodies bodies) {
  forEachFree(bodies, drag.body, [&](RigidBody& body) {
    body.force -= drag.linear * body.v;
    body.torque -= drag.angular * body.omega;
  });
}

void add(const PointForce& f, Bodies bodies) {
  RigidBody& body = bodies[f.body];
  applyForce(body, body.R * f.point_B + body.x, f.force);
}

void add(const Spring& spring, Bodies bodies) {
  const Pull pull = pullOf(spring, bodies);
  if (isFree(bodies, spring.a)) applyForce(bodies[spring.a], pull.a.p, pull.force);
  if (isFree(bodies, spring.b)) applyForce(bodies[spring.b], pull.b.p, -pull.force);
}

void add(const CircularField& field, Bodies bodies) {
  forEachFree(bodies, field.body,
              [&](RigidBody& body) { body.force += body.M * acceleration(field, body.x); });
}

ElementPlaces placesOf(const Element& element, ConstBodies bodies) {
  ElementPlaces x;
  x.fill(Vec3::Zero());
  for (int k = 0; k < element.count; ++k) x[k] = bodies[element.points[k]].x;
  return x;
}

/// −∂E/∂x − D v of an element, by its points.
ElementVector pullOf(const Element& element, ConstBodies bodies, ElementTerms& terms) {
  const bool damped = damps(element.energy);
  differentiate(element.energy, placesOf(element, bodies),
                damped ? ElementAsk::Matrices : ElementAsk::Forces, terms);
  if (!damped) return -terms.gradient;
  ElementVector v = ElementVector::Zero();
  for (int k = 0; k < element.count; ++k) v.segment<3>(3 * k) = bodies[element.points[k]].v;
  return -terms.gradient - elementTimes(terms.damping, v, element.count);
}

void add(const Bending& bending, Bodies bodies) {
  ElementTerms terms;
  for (const Element& element : bending.body->elements) {
    const ElementVector pull = pullOf(element, bodies, terms);
    for (int k = 0; k < element.count; ++k) {
      RigidBody& body = bodies[element.points[k]];
      if (!body.fixed()) body.force += pull.segment<3>(3 * k);
    }
  }
}

/// Calls act(body, force [N]) for every point of cloth that presses on cloth.
template <class Act>
void forPressed(const Layers& layers, ConstBodies bodies, const Act& act) {
  std::vector<Vec3> x;
  Layers::Look at;
  for (const int i : layers.points()) x.push_back(bodies[i].x);
  layers.look(x, {}, at);
  for (const LayerPair& pair : at.pairs)
    for (int k = 0; k < 4; ++k)
      act(layers.points()[pair.points[k]],
          pair.stiffness * (pair.thickness - pair.distance) * pair.weight[k] * pair.n);
}

void add(const Layering& layering, Bodies bodies) {
  forPressed(*layering.layers, bodies, [&](int i, const Vec3& force) {
    if (!bodies[i].fixed()) bodies[i].force += force;
  });
}

double power(const UniformWind& wind, ConstBodies bodies) {
  double sum = 0.0;
  forEachFree(bodies, wind.body, [&](const RigidBody& body) { sum += wind.force.dot(body.v); });
  return sum;
}

double power(const LinearDrag& drag, ConstBodies bodies) {
  double sum = 0.0;
  forEachFree(bodies, drag.body, [&](const RigidBody& body) {
    sum -= drag.linear * body.v.squaredNorm() + drag.angular * body.omega.squaredNorm();
  });
  return sum;
}

double power(const PointForce& f, ConstBodies bodies) {
  const RigidBody& body = bodies[f.body];
  return body.fixed() ? 0.0 : f.force.dot(pointVelocity(body, body.R * f.point_B + body.x));
}

double power(const Spring& spring, ConstBodies bodies) {
  const Pull pull = pullOf(spring, bodies);
  // The damper takes c l̇²; an end that is led along gives what its bearer pushes.
  double sum = -spring.damping * pull.rate * pull.rate;
  if (!isFree(bodies, spring.a)) sum -= pull.force.dot(pull.a.v);
  if (!isFree(bodies, spring.b)) sum += pull.force.dot(pull.b.v);
  return sum;
}

double power(const CircularField&, ConstBodies) {
  return 0.0;
}

/// Its dampers take v·D v; points that are led along give what their bearers push.
double power(const Bending& bending, ConstBodies bodies) {
  double sum = 0.0;
  ElementTerms terms;
  for (const Element& element : bending.body->elements) {
    const ElementVector pull = pullOf(element, bodies, terms);
    ElementVector v = ElementVector::Zero();
    for (int k = 0; k < element.count; ++k) {
      const RigidBody& body = bodies[element.points[k]];
      v.segment<3>(3 * k) = body.v;
      if (body.fixed()) sum -= pull.segment<3>(3 * k).dot(body.v);
    }
    if (damps(element.energy)) sum -= v.dot(elementTimes(terms.damping, v, element.count));
  }
  return sum;
}

double power(const Layering& layering, ConstBodies bodies) {
  double sum = 0.0;
  forPressed(*layering.layers, bodies, [&](int i, const Vec3& force) {
    if (bodies[i].fixed()) sum -= force.dot(bodies[i].v);
  });
  return sum;
}

/// Energy [J] that a force has stored; only springs, fields and what bends do.
double stored(const Bending& bending, ConstBodies bodies) {
  double sum = 0.0;
  ElementTerms terms;
  for (const Element& element : bending.body->elements) {
    differentiate(element.energy, placesOf(element, bodies), ElementAsk::Energy, terms);
    sum += terms.energy;
  }
  return sum;
}

double stored(const Layering& layering, ConstBodies bodies) {
  return layering.layers->energyAt([&](int i) -> const Vec3& { return bodies[i].x; });
}

double stored(const Spring& spring, ConstBodies bodies) {
  const double stretch = pullOf(spring, bodies).stretch;
  return 0.5 * spring.stiffness * stretch * stretch;
}

double stored(const CircularField& field, ConstBodies bodies) {
  double sum = 0.0;
  forEachFree(bodies, field.body, [&](const RigidBody& body) {
    sum += 0.5 * body.M * field.rotation.cross(body.x - field.centre).squaredNorm();
  });
  return sum;
}

template <class OtherForce>
double stored(const OtherForce&, ConstBodies) {
  return 0.0;
}

}  // namespace

bool dependsOnVelocity(const Force& force) {
  if (const Spring* spring = std::get_if<Spring>(&force)) return spring->damping != 0.0;
  if (const Bending* bending = std::get_if<Bending>(&force)) {
    const std::vector<Element>& elements = bending->body->elements;
    return std::any_of(elements.begin(), elements.end(),
                       [](const Element& element) { return damps(element.energy); });
  }
  return std::holds_alternative<LinearDrag>(force);
}

Vec3 acceleration(const CircularField& field, const Vec3& x) {
  return field.rotation.cross(field.rotation.cross(x - field.centre));
}

void sumForces(const Vec3& gravity, std::span<const Force> forces, std::span<RigidBody> bodies) {
  for (RigidBody& body : bodies) {
    body.force.setZero();
    body.torque.setZero();
    if (!body.fixed()) body.force = body.M * gravity;
  }
  for (const Force& force : forces) {
    std::visit([&](const auto& f) { add(f, bodies); }, force);
  }
}

double kineticEnergy(std::span<const RigidBody> bodies) {
  double sum = 0.0;
  for (const RigidBody& body : bodies) sum += kineticEnergy(body);
  return sum;
}

double potentialEnergy(const Vec3& gravity, std::span<const Force> forces,
                       std::span<const RigidBody> bodies) {
  double sum = 0.0;
  if (!gravity.isZero(0.0))
    for (const RigidBody& body : bodies) {
      if (!body.fixed()) sum -= body.M * gravity.dot(body.x);
    }
  for (const Force& force : forces) {
    sum += std::visit([&](const auto& f) { return stored(f, bodies); }, force);
  }
  return sum;
}

double powerOfForces(std::span<const Force> forces, std::span<const RigidBody> bodies) {
  double sum = 0.0;
  for (const Force& force : forces) {
    sum += std::visit([&](const auto& f) { return power(f, bodies); }, force);
  }
  return sum;
}

}  // namespace tumble
