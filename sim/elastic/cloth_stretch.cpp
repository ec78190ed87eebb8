// Threads of a piece of cloth that get longer or shorter.
#include "sim/elastic/element.h"

namespace tumble {
namespace {

/// Adds what the threads along one of the two directions give.
void addThreads(const ClothStretch& cloth, const Vec4& d, const ElementPlaces& x, ElementAsk ask,
                ElementTerms& terms) {
  const Vec3 w = d[0] * x[0] + d[1] * x[1] + d[2] * x[2] + d[3] * x[3];
  const double length = w.norm(), strain = length - 1.0;
  const double k = cloth.stiffness * cloth.weave.area;
  terms.energy += 0.5 * k * strain * strain;
  if (ask == ElementAsk::Energy || length == 0.0) return;
  const Vec3 along = w / length;
  for (int i = 0; i < 4; ++i) terms.gradient.segment<3>(3 * i) += k * strain * d[i] * along;
  if (ask == ElementAsk::Forces) return;

  const Mat3 outer = along * along.transpose();
  double across = k * strain / length;
  if (ask == ElementAsk::Projected && across < 0.0) across = 0.0;
  const Mat3 K = k * outer + across * (Mat3::Identity() - outer);
  const Mat3 D = cloth.damping * cloth.weave.area * outer;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      terms.hessian.block<3, 3>(3 * i, 3 * j) += d[i] * d[j] * K;
      terms.damping.block<3, 3>(3 * i, 3 * j) += d[i] * d[j] * D;
    }
}

}  // namespace

void differentiate(const ClothStretch& cloth, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  terms.clear(ask);
  addThreads(cloth, cloth.weave.du, x, ask, terms);
  addThreads(cloth, cloth.weave.dv, x, ask, terms);
}

}  // namespace tumble
