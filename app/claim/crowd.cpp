// What holds of many bodies at once, whatever their motion: energy only goes, momentum is kept, and
// what the numerics mend is small.
#include <algorithm>

#include "app/claim/rows.h"

namespace tumble {

namespace {

// Allowed, of the largest kinetic energy or of what is lost in all, whichever is more: a rise
// between samples beyond what repairs added, measured 4e-16; what repairs added, measured 2e-2
// where many lean on each other, 8e-4 else; losses that no hit and no slip accounts for, which is
// what crowds solved to a thousandth leave, measured 1e-2. Momentum [relative], measured 1e-12;
// overlap at the ends of steps [m], measured 1e-5.
constexpr double kRise = 1e-9, kRepaired = 3e-2, kUntold = 3e-2, kMomentum = 1e-9, kOverlap = 1e-4;

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
  const Sample &first = recording.samples.front(), &last = recording.samples.back();
  const double gone = first.kinetic + first.potential - last.kinetic - last.potential;
  const double scale = std::max(most, gone);
  const double repaired = books.energy_added_repair / scale;
  WorstRow rise("energy gained between samples, relative", kRise + repaired);
  for (std::size_t k = 1; k < recording.samples.size(); ++k) {
    const Sample &before = recording.samples[k - 1], &now = recording.samples[k];
    const double gained = now.kinetic + now.potential - before.kinetic - before.potential;
    rise.see(std::max(0.0, gained) / scale, 0.0, gained / scale);
  }
  const double told =
      books.energy_lost_impact + books.energy_lost_friction - books.energy_added_repair;
  return {rise.row(),
          {"energy lost / J, relative", gone, told, std::abs(gone - told) / scale, kUntold},
          {"energy that repairs added, relative", repaired, 0.0, repaired, kRepaired},
          {"momentum that no force gave, relative", books.momentum_error, 0.0, books.momentum_error,
           kMomentum},
          {"deepest overlap / m", books.max_penetration, 0.0, books.max_penetration, kOverlap}};
}

}  // namespace tumble
