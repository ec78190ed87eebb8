// A spring between two points.
#include "sim/elastic/element.h"

namespace tumble {

void differentiate(const StretchSpring& spring, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  terms.clear<2>(ask);
  const Vec3 span = x[0] - x[1];
  const double length = span.norm(), stretch = length - spring.rest;
  terms.energy = 0.5 * spring.stiffness * stretch * stretch;
  // Without a length it has no direction and pulls at nothing.
  if (ask == ElementAsk::Energy || length == 0.0) return;
  const Vec3 along = span / length;
  const Vec3 pull = spring.stiffness * stretch * along;
  terms.gradient.segment<3>(0) = pull;
  terms.gradient.segment<3>(3) = -pull;
  if (ask == ElementAsk::Forces) return;

  // Across it, tension over length resists; projected, the push of a short one does not.
  const Mat3 outer = along * along.transpose();
  double across = spring.stiffness * stretch / length;
  if (ask == ElementAsk::Projected && across < 0.0) across = 0.0;
  const Mat3 K = spring.stiffness * outer + across * (Mat3::Identity() - outer);
  for (const int i : {0, 3})
    for (const int j : {0, 3}) {
      terms.hessian.block<3, 3>(i, j) = i == j ? K : Mat3(-K);
      terms.damping.block<3, 3>(i, j) = (i == j ? spring.damping : -spring.damping) * outer;
    }
}

}  // namespace tumble
