#include "sim/elastic/elastic_body.h"

namespace tumble {
namespace {

int points(const StretchSpring&) {
  return 2;
}
int corners(const Weave& weave) {
  return weave.du[3] == 0.0 && weave.dv[3] == 0.0 ? 3 : 4;
}
int points(const ClothStretch& cloth) {
  return corners(cloth.weave);
}
int points(const ClothShear& cloth) {
  return corners(cloth.weave);
}
int points(const ClothBend& bend) {
  return bend.difference[3] == 0.0 ? 3 : 4;
}
int points(const StrandBend&) {
  return 3;
}
int points(const Corotated&) {
  return 4;
}
int points(const NeoHookean&) {
  return 4;
}
int points(const ShapeMatch&) {
  return 8;
}
int points(const ClothPoint&) {
  return 4;
}
int points(const ClothEdges&) {
  return 4;
}

double dampingOf(const StretchSpring& spring) {
  return spring.damping;
}
double dampingOf(const ClothStretch& cloth) {
  return cloth.damping;
}
double dampingOf(const ClothShear& cloth) {
  return cloth.damping;
}
double dampingOf(const ClothBend&) {
  return 0.0;
}
double dampingOf(const StrandBend&) {
  return 0.0;
}
double dampingOf(const Corotated& solid) {
  return solid.solid.viscosity;
}
double dampingOf(const NeoHookean& solid) {
  return solid.solid.viscosity;
}
double dampingOf(const ShapeMatch& match) {
  return match.viscosity;
}
double dampingOf(const ClothPoint&) {
  return 0.0;
}
double dampingOf(const ClothEdges&) {
  return 0.0;
}

}  // namespace

bool damps(const Energy& energy) {
  return std::visit([](const auto& law) { return dampingOf(law) != 0.0; }, energy);
}

int pointsOf(const Energy& energy) {
  return std::visit([](const auto& law) { return points(law); }, energy);
}

}  // namespace tumble
