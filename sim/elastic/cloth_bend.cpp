// A second difference of places: threads that bend or twist.
#include "sim/elastic/element.h"

namespace tumble {

void differentiate(const ClothBend& bend, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  terms.clear(ask);
  const Vec4& c = bend.difference;
  Vec3 second = Vec3::Zero();
  for (int i = 0; i < kFewPoints; ++i)
    if (c[i] != 0.0) second += c[i] * x[i];
  terms.energy = 0.5 * bend.stiffness * second.squaredNorm();
  if (ask == ElementAsk::Energy) return;
  for (int i = 0; i < kFewPoints; ++i)
    terms.gradient.segment<3>(3 * i) = bend.stiffness * c[i] * second;
  if (ask == ElementAsk::Forces) return;
  for (int i = 0; i < kFewPoints; ++i)
    for (int j = 0; j < kFewPoints; ++j)
      terms.hessian.block<3, 3>(3 * i, 3 * j).diagonal().setConstant(bend.stiffness * c[i] * c[j]);
}

}  // namespace tumble
