#include "sim/method/model.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tumble {

std::string shortNumber(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6);
  return {text, end.ptr};
}

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
