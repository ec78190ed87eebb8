#include "sim/method/crush.h"

#include <algorithm>

#include "sim/contact/rows.h"
#include "sim/problem/endless.h"

namespace tumble {

bool drives(const Model& model, const RigidBody& body, int number) {
  return model.fixed(number) && !(body.v.isZero(0.0) && body.omega.isZero(0.0));
}

std::string crushWords(const Model& model, double t, std::span<const std::pair<int, int>> pairs,
                       std::span<const double> push) {
  constexpr double kPart = 1e-3;  // of the hardest push: who takes part
  const double most = *std::max_element(push.begin(), push.end());
  const auto isFixed = [&](int i) { return i >= model.count() || model.fixed(i); };
  int pressed = -1;
  double hardest = 0.0;
  std::vector<int> jaws;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    if (push[c] < kPart * most) continue;
    for (const int i : {pairs[c].first, pairs[c].second}) {
      if (!isFixed(i) && push[c] > hardest) {
        hardest = push[c];
        pressed = i;
      } else if (isFixed(i) && i < model.count() &&
                 std::find(jaws.begin(), jaws.end(), i) == jaws.end()) {
        jaws.push_back(i);
      }
    }
  }
  std::sort(jaws.begin(), jaws.end());
  const auto name = [&](int i) { return "\"" + model.def.bodies[i].name + "\""; };
  std::string words = pressed < 0 ? "what is held" : name(pressed);
  for (std::size_t k = 0; k < jaws.size(); ++k)
    words += (k == 0 ? " is crushed by " : " and ") + name(jaws[k]);
  return words + " at t = " + shortNumber(t) + " s: no force can hold back a fixed body that moves";
}

namespace {

/// @param rubs  whether friction counts
std::string findCrushed(const Model& model, double t, std::span<const RigidBody> bodies,
                        std::span<const Contact> contacts, bool rubs) {
  const auto driven = [&](const Contact& c) {
    return drives(model, bodies[c.a], c.a) || drives(model, bodies[c.b], c.b);
  };
  if (std::none_of(contacts.begin(), contacts.end(), driven)) return {};
  Problem problem;
  beginVelocityProblem(bodies, problem);
  std::vector<std::pair<int, int>> pairs;
  for (const Contact& c : contacts) {
    const bool cone = rubs && c.friction > 0.0;
    problem.cones.push_back({.kind = cone ? ConeKind::Friction : ConeKind::Push,
                             .row = static_cast<int>(problem.rows.size()),
                             .mu = cone ? c.friction : 0.0});
    const auto add = [&](const Vec3& along) {
      problem.rows.push_back(pointRow(bodies, c.a, c.b, c.point.p, along, 0.0));
    };
    add(c.point.n);
    if (cone) {
      Vec3 t1, t2;
      tangents(c.point.n, Vec3::Zero(), t1, t2);
      add(t1);
      add(t2);
    }
    pairs.emplace_back(c.a, c.b);
  }
  const std::vector<double> push = endlessPush(problem, rubs);
  return push.empty() ? std::string{} : crushWords(model, t, pairs, push);
}

}  // namespace

std::string findCrushed(const Model& model, double t, std::span<const RigidBody> bodies,
                        std::span<const Contact> contacts) {
  return findCrushed(model, t, bodies, contacts, false);
}

std::string findLocked(const Model& model, double t, std::span<const RigidBody> bodies,
                       std::span<const Contact> contacts, double residual) {
  constexpr double kHopeless = 1e-2;
  if (!(residual > kHopeless)) return {};
  const std::string crushed = findCrushed(model, t, bodies, contacts, false);
  return crushed.empty() ? findCrushed(model, t, bodies, contacts, true) : crushed;
}

}  // namespace tumble
