#include "sim/elastic/strain.h"

#include <algorithm>
#include <cmath>

#include "sim/elastic/solid.h"

namespace tumble {
namespace {

double strain(const StretchSpring& spring, const ElementPlaces& x) {
  return spring.rest > 0.0 ? std::abs((x[0] - x[1]).norm() / spring.rest - 1.0) : 0.0;
}

double strain(const ClothStretch& cloth, const ElementPlaces& x) {
  double most = 0.0;
  for (const Vec4& d : {cloth.weave.du, cloth.weave.dv}) {
    const Vec3 w = d[0] * x[0] + d[1] * x[1] + d[2] * x[2] + d[3] * x[3];
    most = std::max(most, std::abs(w.norm() - 1.0));
  }
  return most;
}

double solidStrain(const Mat3& F) {
  return (stretchesAloneOf(F) - Vec3::Ones()).lpNorm<Eigen::Infinity>();
}

double strain(const Corotated& solid, const ElementPlaces& x) {
  return solidStrain(deformation(solid.cell, x));
}
double strain(const NeoHookean& solid, const ElementPlaces& x) {
  return solidStrain(deformation(solid.cell, x));
}
double strain(const ShapeMatch& match, const ElementPlaces& x) {
  return solidStrain(deformation(match, x));
}

double strain(const ClothShear&, const ElementPlaces&) {
  return 0.0;
}
double strain(const ClothBend&, const ElementPlaces&) {
  return 0.0;
}
double strain(const StrandBend&, const ElementPlaces&) {
  return 0.0;
}
double strain(const ClothPoint&, const ElementPlaces&) {
  return 0.0;
}
double strain(const ClothEdges&, const ElementPlaces&) {
  return 0.0;
}

}  // namespace

double strainOf(const Energy& energy, const ElementPlaces& x) {
  return std::visit([&](const auto& law) { return strain(law, x); }, energy);
}

std::vector<double> strainsOf(const ElasticBody& body, std::span<const Vec3> places) {
  std::vector<double> strains(body.bodies.size(), 0.0);
  const auto at = [&](int point) {
    return std::lower_bound(body.bodies.begin(), body.bodies.end(), point) - body.bodies.begin();
  };
  for (const Element& element : body.elements) {
    ElementPlaces x;
    x.fill(Vec3::Zero());
    for (int k = 0; k < element.count; ++k) x[k] = places[at(element.points[k])];
    const double strain = strainOf(element.energy, x);
    for (int k = 0; k < element.count; ++k) {
      double& most = strains[at(element.points[k])];
      most = std::max(most, strain);
    }
  }
  return strains;
}

}  // namespace tumble
