// What bends, by sweeps in place of factors: parts whose factor costs too much, where a preset asks
// for no more than sweeps give.
#include <algorithm>
#include <utility>

#include "sim/method/stepping/stepping.h"
#include "sim/problem/nodes.h"

namespace tumble {

/// Whether sweeps can solve an island: they know points that bend, and contacts with what does not
/// move.
bool Stepping::canSweep(const Island& island) {
  bool can = true;
  forBent(island, [&](const BendingPart& part) { can = can && part.sweeps; });
  for (const int mover : island.movers) can = can && model_.bends(mover);
  for (const Link link : island.links) {
    const auto [b, a] = ends(link);
    can = can && isPair(link) && model_.fixed(a) != model_.fixed(b);
  }
  return can;
}

/// The parts of an island that sweeps do not solve get their factor.
void Stepping::factorSwept(Island& island) {
  forBent(island, [&](BendingPart& part) {
    if (!part.sweeps) return;
    part.sweeps = false;
    factorBent(part, island.answer.crushed);
    for (const int p : part.moving) work_.star[part.bodies[p]].head<3>() = part.star[p];
  });
}

/// Sweeps of an island did not come to an end: factors take their place in this step, and in those
/// that follow, each time in twice as many.
void Stepping::leaveSweeps(Island& island) {
  constexpr int kLongest = 64;  // steps
  forBent(island, [&](BendingPart& part) {
    Unswept& unswept = memory_.unswept[&part - memory_.bendings->parts.data()];
    unswept.left = unswept.next;
    unswept.next = std::min(2 * unswept.next, kLongest);
  });
  factorSwept(island);
  for (std::size_t k = 0; k < island.bodies.size(); ++k) {
    island.problem.vStar[k] = work_.star[island.bodies[k]];
    island.solution.v[k] = work_.before[island.bodies[k]];
  }
}

/// Sweeps the problem at hand, from where the last sweeps ended.
SolveReport Stepping::sweepBodies(Island& island, double h) {
  constexpr int kMost = 300;
  constexpr double kOpen = 0.05;  // of the kinetic energies, in a step
  Solution& solution = island.solution;
  island.side.resize(island.bodies.size());
  double speed = gravity_ * h;
  for (std::size_t k = 0; k < island.bodies.size(); ++k) {
    if (model_.fixed(island.bodies[k])) continue;
    const BendingPart& part = memory_.bendings->partWith(island.bodies[k]);
    const int point = memory_.bendings->pointOf[island.bodies[k]];
    island.side[k] = part.side[part.mover[point]];
    solution.v[k].head<3>() = part.swept[point];
    speed = std::max(speed, part.swept[point].lpNorm<Eigen::Infinity>());
  }
  constexpr double kGuess = 30.0;  // times what is enough
  const double enough = (guesses_ ? kGuess : 1.0) * model_.def.stepping.bent * speed;
  const SolveReport solved = sweepNodes(
      island.problem, island.side,
      {.enough = enough, .most = kMost, .open = kOpen, .still = gravity_ * h, .settles = !guesses_},
      solution);
  for (std::size_t k = 0; k < island.bodies.size(); ++k) {
    if (model_.fixed(island.bodies[k])) continue;
    BendingPart& part = memory_.bendings->partWith(island.bodies[k]);
    part.swept[memory_.bendings->pointOf[island.bodies[k]]] = solution.v[k].head<3>();
  }
  return solved;
}

SolveReport Stepping::sweepBent(Island& island, double h) {
  startFromBefore(island, h);
  return sweepBodies(island, h);
}

/// Sweeps of what flies begin with the momentum that it ends with.
void Stepping::startFlown(BendingPart& part, double h) const {
  double mass = 0.0;
  Vec3 open = Vec3::Zero();
  for (std::size_t p = 0; p < part.bodies.size(); ++p) {
    const RigidBody& body = state_.bodies[part.bodies[p]];
    mass += body.M;
    open += body.P + h * body.force - body.M * part.swept[p];
  }
  for (Vec3& v : part.swept) v += open / mass;
}

/// Parts that nothing touches.
void Stepping::moveAlone(double h) {
  Island& island = work_.islands.front();
  for (BendingPart& part : memory_.bendings->parts) {
    const bool anew = std::exchange(part.anew, false);
    if (part.touched) continue;
    startIsland(island, {});
    for (const int p : part.moving) island.movers.push_back(part.bodies[p]);
    if (part.sweeps && anew) {
      build(island, h);
      coupleBent(island);
      if (part.flies()) startFlown(part, h);
      if (sweepBodies(island, h).status != SolveStatus::Solved) {
        leaveSweeps(island);
        for (const int p : part.moving) work_.after[part.bodies[p]].head<3>() = part.star[p];
      }
    }
    if (part.sweeps)
      for (const int p : part.moving) work_.after[part.bodies[p]].head<3>() = part.swept[p];
    flyBent(island, h);
  }
}

}  // namespace tumble
