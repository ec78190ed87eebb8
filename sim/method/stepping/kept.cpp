// Answers that islands keep: from the step before, or from one of another length.
#include <algorithm>

#include "sim/math/rotation.h"
#include "sim/method/stepping/stepping.h"

namespace tumble {

/// Whether an island has the bodies that it had when it was solved, and as many links.
bool Stepping::ofSame(const IslandMemory& memory, std::span<const Link> links) const {
  return memory.seen.size() == links.size() &&
         std::equal(memory.movers.begin(), memory.movers.end(), work_.movers.begin(),
                    work_.movers.end(),
                    [](const IslandMemory::Mover& mover, int body) { return mover.body == body; });
}

/// Whether an island asks what it asked when it was solved, wherever it has gone: the same levers
/// and inertias, and velocities that differ by far less than the tolerance on the residual.
bool Stepping::keeps(const IslandMemory& memory, std::span<const Link> links) const {
  if (!ofSame(memory, links)) return false;
  for (std::size_t k = 0; k < links.size(); ++k)
    if (!isPair(links[k]) || memory.seen[k].look != memory_.pairs[links[k]].look) return false;
  constexpr double kKept = 0.01;  // of the tolerance: what is kept errs the same way in every step
  const double part = kKept * model_.def.stepping.tolerance, allowed = part * memory.scale;
  for (const IslandMemory::Mover& mover : memory.movers) {
    const Mat3 turned = state_.bodies[mover.body].Iinv - mover.Iinv;
    if (!((work_.star[mover.body] - mover.vStar).lpNorm<Eigen::Infinity>() <= allowed) ||
        !(turned.lpNorm<Eigen::Infinity>() <= part * mover.Iinv.lpNorm<Eigen::Infinity>()))
      return false;
  }
  for (const Link link : links)
    for (const Touch& touch : memory_.pairs[link].touches)
      if (touch.arrivalSpeed > 0.0) return false;
  return true;
}

/// Whether an island that was at rest is asked for a step of another length: its forces stay,
/// unless they are those of a short step, in whose impulses more of them is rounding.
bool Stepping::rests(const IslandMemory& memory, std::span<const Link> links, double h) const {
  if (memory.length == h || h > 2.0 * memory.solved || !ofSame(memory, links)) return false;
  for (std::size_t k = 0; k < links.size(); ++k)
    if (!isPair(links[k]) || memory.seen[k].form != memory_.pairs[links[k]].form) return false;
  const double s = h / memory.length, still = tolerance_.rest;
  for (std::size_t i = 0; i < work_.movers.size(); ++i) {
    const Vec6 &star = work_.star[work_.movers[i]], &before = work_.before[work_.movers[i]];
    const Vec6 asked = before + s * (memory.movers[i].vStar - memory.movers[i].v);
    for (const Vec6& v : {before, memory.movers[i].v, Vec6(star - asked)})
      if (!(v.lpNorm<Eigen::Infinity>() <= still)) return false;
  }
  return true;
}

/// An island none of whose bodies moves by more than the solver left, before a step or after it,
/// stands, where that would bring one of them to another pose: it was no motion. In a crowd it
/// stands as soon as all of them are at rest.
void Stepping::stand(IslandMemory& memory, bool crowd, double h) const {
  constexpr double kLeft = 10.0;  // of the residual
  const double left = kLeft * memory.residual * memory.scale;
  const double still = crowd ? tolerance_.rest : std::min(left, tolerance_.rest);
  const auto stands = [&](int body, const Vec6& twist) {
    return twist.head<3>().norm() + model_.radius[body] * twist.tail<3>().norm() <= still;
  };
  bool leaves = crowd;
  for (const IslandMemory::Mover& mover : memory.movers) {
    if (!stands(mover.body, work_.before[mover.body]) || !stands(mover.body, mover.v)) return;
    const RigidBody& body = state_.bodies[mover.body];
    leaves = leaves || body.x + h * mover.v.head<3>() != body.x ||
             rotated(body.q, h * mover.v.tail<3>()).coeffs() != body.q.coeffs();
  }
  if (!leaves) return;
  memory.books.external.setZero();
  for (IslandMemory::Mover& mover : memory.movers) {
    mover.v.setZero();
    memory.books.external -= state_.bodies[mover.body].M * mover.vStar.head<3>();
  }
}

/// Gives the answer of an island at rest to a step of another length.
void Stepping::stretch(IslandMemory& memory, std::span<const Link> links, double h) {
  const double s = h / memory.length;
  memory.length = h;
  memory.books = {};
  for (std::size_t k = 0; k < links.size(); ++k) {
    memory.seen[k].look = memory_.pairs[links[k]].look;
    for (Touch& touch : memory_.pairs[links[k]].touches) {
      touch.impulse *= s;
      touch.length = h;
    }
  }
  for (std::size_t i = 0; i < work_.movers.size(); ++i) {
    memory.movers[i].vStar = work_.star[work_.movers[i]];
    memory.movers[i].v = work_.before[work_.movers[i]];
    memory.books.external +=
        state_.bodies[work_.movers[i]].M * (memory.movers[i].v - memory.movers[i].vStar).head<3>();
  }
}

}  // namespace tumble
