// What a run says of its own numerics: contact forces solved for, nothing in anything, energy
// accounted for.
#include <algorithm>

#include "app/claim/footing.h"
#include "app/claim/rows.h"

namespace tumble {

namespace {

// Allowed of the residual [1], of the overlap [m] and of the balance [1]; measured 1e-9 by newton.
constexpr double kResidual = 1e-6, kOverlap = 1e-9, kBalance = 1e-9;

/// How fast and how lively a run gets.
struct Liveliness {
  double fastest = 0.0;  ///< [m/s] centre of mass
  double kinetic = 0.0;  ///< [J] of all
};

Liveliness livelinessOf(const Scene& scene, const Recording& recording) {
  Liveliness most;
  for (const Sample& sample : recording.samples) {
    most.kinetic = std::max(most.kinetic, sample.kinetic);
    for (std::size_t i = 0; i < sample.bodies.size(); ++i)
      if (moves(scene.world.bodies[i]))
        most.fastest = std::max(most.fastest, sample.bodies[i].v.norm());
  }
  return most;
}

}  // namespace

// Steps see a contact up to one of them late, and know the work of gravity to as much: the deepest
// overlap is at most the way of a step, the balance what the weight does in two.
std::vector<ClaimRow> bookRows(const Scene& scene, const Recording& recording) {
  const Certificate& books = recording.report.certificate;
  const Liveliness most = livelinessOf(scene, recording);
  if (!(most.kinetic > 0.0)) return {emptyClaim("nothing moves")};
  double mass = 0.0;
  for (const BodyDef& body : scene.world.bodies)
    if (moves(body)) mass += massOf(body).mass;
  const double way = grain(scene) * most.fastest;
  const double work = 2.0 * way * mass * scene.world.gravity.norm() / most.kinetic;
  return {
      {"residual of the contact problem, relative", books.max_complementarity, 0.0,
       books.max_complementarity, kResidual},
      {"deepest overlap / m", books.max_penetration, 0.0, books.max_penetration, kOverlap + way},
      {"balance of energy, relative", books.energy_balance_error, 0.0, books.energy_balance_error,
       kBalance + work}};
}

}  // namespace tumble
