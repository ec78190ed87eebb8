// What holds of many bodies at once, whatever their motion: energy only goes, momentum is kept, and
// what the numerics mend is small.
#include <algorithm>

#include "app/claim/rows.h"

namespace tumble {

namespace {

// Allowed: a rise between samples beyond what repairs added [of the largest kinetic energy],
// measured 4e-16; repairs [of the same]; losses that no hit and no slip accounts for [of the same],
// which is what crowds solved to a thousandth leave, measured 1e-3; momentum [relative], measured
// 2e-13; overlap at the ends of steps [m], measured 9e-6.
constexpr double kRise = 1e-9, kRepaired = 5e-3, kUntold = 1e-2, kMomentum = 1e-9, kOverlap = 1e-4;

// Only gravity and contacts between bodies that move and ones that stand: nothing feeds energy in.
bool isPassive(const WorldDef& world) {
  const auto drives = [](const BodyDef& body) {
    return body.fixed && !(body.velocity.isZero() && body.angularVelocity.isZero());
  };
  return world.forces.empty() && std::none_of(world.bodies.begin(), world.bodies.end(), drives);
}

}  // namespace

std::vector<ClaimRow> crowdRows(const Scene& scene, const Recording& recording) {
  if (!isPassive(scene.world)) return {emptyClaim("forces or moving supports feed energy in")};
  double most = 0.0;
  for (const Sample& sample : recording.samples) most = std::max(most, sample.kinetic);
  if (!(most > 0.0)) return {emptyClaim("nothing moves")};

  const Certificate& books = recording.report.certificate;
  const double repaired = books.energy_added_repair / most;
  WorstRow rise("energy gained between samples / largest kinetic", kRise + repaired);
  for (std::size_t k = 1; k < recording.samples.size(); ++k) {
    const Sample &before = recording.samples[k - 1], &now = recording.samples[k];
    const double gained = now.kinetic + now.potential - before.kinetic - before.potential;
    rise.see(std::max(0.0, gained) / most, 0.0, gained / most);
  }
  const Sample &first = recording.samples.front(), &last = recording.samples.back();
  const double gone = first.kinetic + first.potential - last.kinetic - last.potential;
  const double told =
      books.energy_lost_impact + books.energy_lost_friction - books.energy_added_repair;
  return {rise.row(),
          {"energy lost / J, off by largest kinetic", gone, told, std::abs(gone - told) / most,
           kUntold},
          {"energy that repairs added / largest kinetic", repaired, 0.0, repaired, kRepaired},
          {"momentum that no force gave, relative", books.momentum_error, 0.0, books.momentum_error,
           kMomentum},
          {"deepest overlap / m", books.max_penetration, 0.0, books.max_penetration, kOverlap}};
}

}  // namespace tumble
