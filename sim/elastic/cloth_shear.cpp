// Threads of a piece of cloth that lean against each other.
#include "sim/elastic/element.h"

namespace tumble {

void differentiate(const ClothShear& cloth, const ElementPlaces& x, ElementAsk ask,
                   ElementTerms& terms) {
  terms.clear(ask);
  const Vec4 &du = cloth.weave.du, &dv = cloth.weave.dv;
  Vec3 wu = Vec3::Zero(), wv = Vec3::Zero();
  for (int i = 0; i < 4; ++i) {
    wu += du[i] * x[i];
    wv += dv[i] * x[i];
  }
  const double lean = wu.dot(wv), k = cloth.stiffness * cloth.weave.area;
  terms.energy = 0.5 * k * lean * lean;
  if (ask == ElementAsk::Energy) return;
  FewVector slope;  // of the lean
  for (int i = 0; i < 4; ++i) slope.segment<3>(3 * i) = du[i] * wv + dv[i] * wu;
  terms.gradient.head<12>() = k * lean * slope;
  if (ask == ElementAsk::Forces) return;

  // The second derivative of the lean has as much below 0 as above it: projected, it is left out.
  const FewMatrix outer = slope * slope.transpose();
  terms.hessian.topLeftCorner<12, 12>() = k * outer;
  terms.damping.topLeftCorner<12, 12>() = cloth.damping * cloth.weave.area * outer;
  if (ask == ElementAsk::Projected) return;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      terms.hessian.block<3, 3>(3 * i, 3 * j).diagonal().array() +=
          k * lean * (du[i] * dv[j] + dv[i] * du[j]);
}

}  // namespace tumble
