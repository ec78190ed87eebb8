#include "sim/method/model.h"

#include <algorithm>
#include <cmath>

namespace tumble {

Surface Model::surface(int a, int b) const {
  const BodyDef &p = def.bodies[a], &q = def.bodies[b];
  Surface s{std::max(p.restitution, q.restitution), std::sqrt(p.friction * q.friction)};
  for (const PairDef& pair : def.pairs) {
    const bool straight = pair.materialA == p.material && pair.materialB == q.material;
    const bool crossed = pair.materialA == q.material && pair.materialB == p.material;
    if (!straight && !crossed) continue;
    s.restitution = pair.restitution.value_or(s.restitution);
    s.friction = pair.friction.value_or(s.friction);
  }
  return s;
}

}  // namespace tumble
