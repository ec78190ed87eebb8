// A solid that is linear in its stretches, in the frame that turns with it.
#include <cmath>

#include "sim/elastic/solid.h"

namespace tumble {

void differentiate(const Corotated& solid, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  const Mat3 F = deformation(solid.cell, x);
  const Stretches stretches = stretchesFor(ask, F);
  const auto [mu, lambda, viscosity] = solid.solid;
  const Vec3 strain = stretches.sigma - Vec3::Ones();
  const double trace = strain.sum();
  StretchLaw law;
  law.energy = mu * strain.squaredNorm() + 0.5 * lambda * trace * trace;
  law.slope = 2.0 * mu * strain + Vec3::Constant(lambda * trace);
  // All stretches alike feel λ, no other way does.
  law.way << std::sqrt(1.0 / 3.0), std::sqrt(0.5), std::sqrt(1.0 / 6.0),  //
      std::sqrt(1.0 / 3.0), -std::sqrt(0.5), std::sqrt(1.0 / 6.0),        //
      std::sqrt(1.0 / 3.0), 0.0, -std::sqrt(2.0 / 3.0);
  law.base = 2.0 * mu;
  law.weight = {2.0 * mu + 3.0 * lambda, 2.0 * mu, 2.0 * mu};
  law.flip.setConstant(2.0 * mu);
  // Turned inside out by as much as it is wide, σ_i + σ_j is 0 and any turn is as good: none is
  // told apart there.
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double sum = stretches.sigma[i] + stretches.sigma[j];
    if (sum != 0.0) law.twist[k] = (law.slope[i] + law.slope[j]) / sum;
  }
  differentiateSolid(solid.cell, viscosity, F, stretches, law, ask, terms);
}

}  // namespace tumble
