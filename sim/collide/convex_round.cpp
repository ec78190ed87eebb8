// Chapter 5, collide: planes between a cylinder and another solid.
#include "sim/collide/convex.h"

namespace tumble::convex {

Plane widestAxisRound(const Core&, const Core&, double) {
  return {};
}
Plane nearestPlaneRound(const Core&, const Core&) {
  return {};
}

}  // namespace tumble::convex
