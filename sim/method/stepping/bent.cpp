// What bends, in a step: linearised, coupled to what it touches, and booked.
#include <algorithm>
#include <cmath>

#include "sim/method/stepping/stepping.h"

namespace tumble {

/// The forces of what bends at the start of a step, and the motion that they give alone.
bool Stepping::bend(double h) {
  work_.crushed.clear();
  for (BendingPart& part : memory_.bendings->parts) {
    std::fill(part.about.begin(), part.about.end(), Vec3::Zero());
    part.stored = linearise(part, memory_.bendings->pointOf, state_.bodies, h);
    if (!freeMotion(part, state_.bodies, h)) work_.crushed = unbent(part);
  }
  bent_ = std::numeric_limits<double>::infinity();
  return work_.crushed.empty();
}

std::string Stepping::unbent(const BendingPart& part) const {
  return "\"" + part.body->name + "\" left the range of numbers at t = " + shortNumber(state_.t) +
         " s; try a smaller stepping.step, or less stiffness";
}

/// Linearises anew about the motion that was found, Newton's way. @return whether that is needed
bool Stepping::bendFurther(double h) {
  constexpr double kSame = 1e-10;  // of the largest velocity: a step that changes less is the last
  double change = 0.0, scale = 0.0;
  for (BendingPart& part : memory_.bendings->parts)
    for (std::size_t p = 0; p < part.bodies.size(); ++p) {
      const Vec3 v = work_.after[part.bodies[p]].head<3>();
      change = std::max(change, (v - part.about[p]).lpNorm<Eigen::Infinity>());
      scale = std::max(scale, v.lpNorm<Eigen::Infinity>());
    }
  if (!(change > kSame * std::max(scale, gravity_ * h))) return false;
  // Where the last one went further astray, half of the way.
  const double share = change < bent_ ? 1.0 : 0.5;
  bent_ = change;
  for (BendingPart& part : memory_.bendings->parts) {
    for (std::size_t p = 0; p < part.bodies.size(); ++p)
      part.about[p] += share * (work_.after[part.bodies[p]].head<3>() - part.about[p]);
    linearise(part, memory_.bendings->pointOf, state_.bodies, h);
    if (!freeMotion(part, state_.bodies, h)) work_.crushed = unbent(part);
  }
  return work_.crushed.empty();
}

void Stepping::foreseeBent() {
  for (const BendingPart& part : memory_.bendings->parts)
    for (const int p : part.moving) work_.star[part.bodies[p]].head<3>() = part.star[p];
}

void Stepping::markBent() {
  for (const BendingPart& part : memory_.bendings->parts)
    for (const int p : part.moving) work_.touched[part.bodies[p]] = 1;
}

bool Stepping::anyBends() const {
  return std::any_of(work_.movers.begin(), work_.movers.end(),
                     [this](int body) { return model_.bends(body); });
}

/// All points of what bends in an island belong to it.
void Stepping::collectBent() {
  for (std::size_t k = 0; k < work_.movers.size(); ++k) {
    const int part = model_.bending.empty() ? -1 : model_.bending[work_.movers[k]];
    if (part < 0) continue;
    for (const int p : memory_.bendings->parts[part].moving) {
      const int body = memory_.bendings->parts[part].bodies[p];
      if (work_.local[body] >= 0) continue;
      work_.local[body] = 0;
      work_.movers.push_back(body);
    }
  }
}

/// Adds K of what bends in an island to its problem.
void Stepping::coupleBent() {
  std::vector<char> seen(memory_.bendings->parts.size(), 0);
  for (const int mover : work_.movers) {
    const int number = model_.bending[mover];
    if (number < 0 || seen[number]) continue;
    seen[number] = 1;
    const BendingPart& part = memory_.bendings->parts[number];
    for (const int p : part.moving) {
      const int at = localOf(part.bodies[p]);
      work_.problem.couplings.push_back({at, at, part.own[p]});
    }
    for (const auto& [e, inA] : part.movingEdges)
      work_.problem.couplings.push_back({localOf(part.bodies[part.edges[e].first]),
                                         localOf(part.bodies[part.edges[e].second]), part.off[e]});
  }
}

/// What the implicit step takes [J], by the impulses p of what bends and its energies alone: with
/// v̄ the mean of the velocities before and after, a point gains p·v̄ while the energies give
/// −ΔE; gravity acts on the way h v⁺, which is ½ h Δv longer than that of v̄. Points that are led
/// along take −p from who leads them.
Stepping::BentBooks Stepping::booksOf(const BendingPart& part, double h) const {
  std::vector<Vec3> v, pull;
  for (const int i : part.bodies) v.push_back(work_.after[i].head<3>());
  part.timesK(v, pull);
  BentBooks books;
  double gained = part.reached - part.stored;
  for (std::size_t p = 0; p < part.bodies.size(); ++p) {
    const RigidBody& body = state_.bodies[part.bodies[p]];
    const Vec3 impulse = part.constant[p] - pull[p];
    const Vec3 before = work_.before[part.bodies[p]].head<3>();
    if (part.mover[p] < 0) {
      books.led -= impulse.dot(body.v);
      books.external -= impulse;
      continue;
    }
    gained += impulse.dot(0.5 * (before + v[p])) -
              0.5 * h * body.M * model_.def.gravity.dot(v[p] - before);
    books.size += 0.5 * body.M * (v[p].squaredNorm() + before.squaredNorm());
  }
  books.taken = books.led - gained;
  books.size += part.reached + part.stored;
  return books;
}

/// Finds the books of the velocities at hand. @return whether linear forces give energy, as those
/// of what buckles or turns far in a step can: about the motion that they give they do not, but for
/// what is left of Newton's method.
bool Stepping::gains(double h) {
  constexpr double kGain = 1e-7;  // of the energies at both ends
  bentBooks_.clear();
  for (BendingPart& part : memory_.bendings->parts) {
    part.reached = energyAfter(part, state_.bodies, work_.after, h);
    bentBooks_.push_back(booksOf(part, h));
  }
  return std::any_of(bentBooks_.begin(), bentBooks_.end(),
                     [](const BentBooks& books) { return books.taken < -kGain * books.size; });
}

void Stepping::bookBent() {
  for (const BentBooks& books : bentBooks_) {
    state_.externalImpulse += books.external;
    report_.certificate.work_of_forces += books.led;
    report_.certificate.energy_lost_bending += books.taken;
  }
}

}  // namespace tumble
