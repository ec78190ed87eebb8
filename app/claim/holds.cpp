#include "app/claim/holds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/claim/rows.h"
#include "app/record/bodies.h"
#include "sim/body/force.h"
#include "sim/elastic/elastic_body.h"

namespace tumble {

namespace {

constexpr double kTouch = 1e-9;  // [m] points that are further off are not held

// Blocks of points of several bodies that bend, by numbers of bodies of the world.
struct Blocks {
  std::map<int, Mat3> own;
  std::map<BlockEdge, Mat3> off;

  // Adds an element's part of h (h K + D), and gives h² K v of its points.
  ElementVector add(const Element& element, const std::vector<RigidBody>& bodies, double h) {
    ElementPlaces x;
    x.fill(Vec3::Zero());
    ElementVector v = ElementVector::Zero();
    for (int k = 0; k < element.count; ++k) {
      x[k] = bodies[element.points[k]].x;
      v.segment<3>(3 * k) = bodies[element.points[k]].v;
    }
    ElementTerms terms;
    differentiate(element.energy, x, ElementAsk::Projected, terms);
    for (int i = 0; i < element.count; ++i)
      for (int j = 0; j < element.count; ++j) {
        const int p = element.points[i], q = element.points[j];
        const Mat3 block = h * (h * terms.hessian.block<3, 3>(3 * i, 3 * j) +
                                terms.damping.block<3, 3>(3 * i, 3 * j));
        if (p == q) own.try_emplace(p, Mat3::Zero()).first->second += block;
        if (p < q) off.try_emplace({p, q}, Mat3::Zero()).first->second += block;
      }
    return h * h * elementTimes(terms.hessian, v, element.count);
  }
};

// The first contact of each point that touches what stands: along its normal it goes as that does.
// By numbers of bodies of the world.
std::map<int, Hold> contactsAt(const std::vector<RigidBody>& bodies, const Sample& sample) {
  std::map<int, Hold> holds;
  const auto see = [&](int point, int solid, const Vec3& n, const Vec3& p) {
    if (!bodies[solid].fixed() || bodies[point].fixed()) return;
    const double asked = n.dot(pointVelocity(bodies[solid], p) - bodies[point].v);
    holds.try_emplace(point, Hold{.n = n, .value = asked});
  };
  for (const ContactSample& contact : sample.contacts) {
    if (contact.separation > kTouch) continue;
    see(contact.a, contact.b, contact.n, contact.p);
    see(contact.b, contact.a, -contact.n, contact.p);
  }
  return holds;
}

}  // namespace

HeldProblem heldStep(const Scene& scene, const Sample& sample) {
  const double h = scene.world.stepping.step;
  std::vector<RigidBody> bodies = bodiesAt(scene.world, sample);
  sumForces(scene.world.gravity, scene.world.forces, bodies);
  Blocks blocks;
  std::map<int, Vec3> slowed;  // h² K v
  for (const Force& force : scene.world.forces)
    if (const Bending* bending = std::get_if<Bending>(&force))
      for (const Element& element : bending->body->elements) {
        const ElementVector change = blocks.add(element, bodies, h);
        for (int k = 0; k < element.count; ++k)
          slowed.try_emplace(element.points[k], Vec3::Zero()).first->second +=
              change.segment<3>(3 * k);
      }

  HeldProblem problem;
  std::map<int, int> pointOf;
  std::map<int, Hold> contacts = contactsAt(bodies, sample);
  for (const auto& [i, block] : blocks.own) {
    const RigidBody& body = bodies[i];
    const int point = pointOf[i] = static_cast<int>(problem.own.size());
    problem.own.push_back(block + (body.fixed() ? 0.0 : body.M) * Mat3::Identity());
    problem.b.push_back(h * body.force - slowed[i]);
    if (body.fixed()) {
      for (int axis = 0; axis < 3; ++axis) problem.holds.push_back({point, Vec3::Unit(axis), 0.0});
    } else if (const auto at = contacts.find(i); at != contacts.end()) {
      at->second.point = point;
      problem.holds.push_back(at->second);
    }
  }
  for (const auto& [edge, block] : blocks.off) {
    problem.edges.push_back({pointOf[edge.first], pointOf[edge.second]});
    problem.off.push_back(block);
  }
  if (problem.holds.empty()) return {};
  return problem;
}

const Sample* mostHeld(const Scene& scene, const Recording& recording) {
  const Sample* most = nullptr;
  std::size_t holds = 0;
  for (const Sample& sample : recording.samples) {
    const std::vector<RigidBody> bodies = bodiesAt(scene.world, sample);
    const std::size_t held = contactsAt(bodies, sample).size();
    if (held <= holds) continue;
    holds = held;
    most = &sample;
  }
  return most;
}

std::vector<ClaimRow> holdRows(const Scene& scene, const Recording& recording) {
  // Allowed of the largest Δv. Measured 2e-12, as gradients end at 1e-12.
  constexpr double kEnd = 1e-12, kAgree = 1e-8;
  const Sample* at = mostHeld(scene, recording);
  const HeldProblem problem = at ? heldStep(scene, *at) : HeldProblem{};
  if (problem.holds.empty()) return {emptyClaim("nothing that bends touches what stands")};

  const HeldAnswer reference = solveMultipliers(problem, kEnd);
  double largest = 0.0;
  for (const Vec3& v : reference.dv) largest = std::max(largest, v.norm());
  std::vector<ClaimRow> rows;
  for (const HeldSolver& solver : heldSolvers()) {
    const HeldAnswer answer = solver.solve(problem, kEnd);
    double off = 0.0, slips = 0.0;
    for (std::size_t p = 0; p < answer.dv.size(); ++p)
      off = std::max(off, (answer.dv[p] - reference.dv[p]).norm() / largest);
    for (const Hold& hold : problem.holds)
      slips = std::max(slips, std::abs(hold.n.dot(answer.dv[hold.point]) - hold.value));
    const std::string name =
        fmt::format("{}, {} step{}: ", solver.name, answer.count, answer.count == 1 ? "" : "s");
    rows.push_back({name + "Δv off that of multipliers, relative", off, 0.0, off, kAgree});
    rows.push_back({name + "residual, relative", answer.residual, 0.0, answer.residual, kAgree});
    rows.push_back({name + "what is held moves by / (m/s)", slips, 0.0, slips, 1e-12});
  }
  return rows;
}

}  // namespace tumble
