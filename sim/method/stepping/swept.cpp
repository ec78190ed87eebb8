// What bends, by sweeps in place of factors: parts whose factor costs too much, where a preset asks
// for no more than sweeps give.
#include <algorithm>

#include "sim/method/stepping/stepping.h"
#include "sim/problem/nodes.h"

namespace tumble {

/// Whether sweeps can solve an island: they know points that bend, and contacts with what does not
/// move.
bool Stepping::canSweep(std::span<const Link> links) {
  bool can = true;
  forBent([&](const BendingPart& part) { can = can && part.sweeps; });
  for (const int mover : work_.movers) can = can && model_.bends(mover);
  for (const Link link : links) {
    const auto [b, a] = ends(link);
    can = can && isPair(link) && model_.fixed(a) != model_.fixed(b);
  }
  return can;
}

/// The parts of an island that sweeps do not solve get their factor.
void Stepping::factorSwept() {
  forBent([this](BendingPart& part) {
    if (!part.sweeps) return;
    part.sweeps = false;
    factorBent(part);
    for (const int p : part.moving) work_.star[part.bodies[p]].head<3>() = part.star[p];
  });
}

/// Sweeps of an island did not come to an end: factors take their place in this step, and in those
/// that follow, each time in twice as many.
void Stepping::leaveSweeps() {
  constexpr int kLongest = 64;  // steps
  forBent([&](BendingPart& part) {
    Unswept& unswept = memory_.unswept[&part - memory_.bendings->parts.data()];
    unswept.left = unswept.next;
    unswept.next = std::min(2 * unswept.next, kLongest);
  });
  factorSwept();
  for (std::size_t k = 0; k < work_.bodies.size(); ++k) {
    work_.problem.vStar[k] = work_.star[work_.bodies[k]];
    work_.solution.v[k] = work_.before[work_.bodies[k]];
  }
}

/// Sweeps the problem at hand, from where the last sweeps ended.
SolveReport Stepping::sweepBodies(double h) {
  constexpr int kMost = 300;
  constexpr double kOpen = 0.05;  // of the kinetic energies, in a step
  Solution& solution = work_.solution;
  work_.side.resize(work_.bodies.size());
  double speed = gravity_ * h;
  for (std::size_t k = 0; k < work_.bodies.size(); ++k) {
    if (model_.fixed(work_.bodies[k])) continue;
    const BendingPart& part = memory_.bendings->partWith(work_.bodies[k]);
    const int point = memory_.bendings->pointOf[work_.bodies[k]];
    work_.side[k] = part.side[part.mover[point]];
    solution.v[k].head<3>() = part.swept[point];
    speed = std::max(speed, part.swept[point].lpNorm<Eigen::Infinity>());
  }
  const double enough = model_.def.stepping.bent * speed;
  const SolveReport solved =
      sweepNodes(work_.problem, work_.side,
                 {.enough = enough, .most = kMost, .open = kOpen, .still = gravity_ * h}, solution);
  for (std::size_t k = 0; k < work_.bodies.size(); ++k) {
    if (model_.fixed(work_.bodies[k])) continue;
    BendingPart& part = memory_.bendings->partWith(work_.bodies[k]);
    part.swept[memory_.bendings->pointOf[work_.bodies[k]]] = solution.v[k].head<3>();
  }
  return solved;
}

SolveReport Stepping::sweepBent(std::span<const Link> links, double h) {
  startFromBefore(links, h);
  return sweepBodies(h);
}

/// Parts that nothing touches.
void Stepping::moveAlone(double h) {
  for (BendingPart& part : memory_.bendings->parts) {
    if (part.sweeps && !part.touched && part.anew) {
      work_.movers.clear();
      for (const int p : part.moving) work_.movers.push_back(part.bodies[p]);
      build({}, h);
      coupleBent();
      if (sweepBodies(h).status != SolveStatus::Solved) {
        leaveSweeps();
        for (const int p : part.moving) work_.after[part.bodies[p]].head<3>() = part.star[p];
      }
      for (const int i : work_.bodies) work_.local[i] = -1;
    }
    if (part.sweeps && !part.touched)
      for (const int p : part.moving) work_.after[part.bodies[p]].head<3>() = part.swept[p];
    part.anew = false;
  }
}

}  // namespace tumble
