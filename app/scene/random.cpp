#include "app/scene/random.h"

#include <cmath>

namespace tumble {

Random::Random(std::uint64_t seed, std::string_view stream) : state_(seed) {
  // Each letter of the name moves the state by the mix of what came before (a hash in the manner of
  // FNV, made of the generator itself).
  for (const char c : stream) {
    state_ ^= static_cast<unsigned char>(c);
    state_ = bits();
  }
}

std::uint64_t Random::bits() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::unit() {
  return static_cast<double>(bits() >> 11) * 0x1p-53;
}

double Random::between(double lo, double hi) {
  const double u = unit();
  return lo + (hi - lo) * u;
}

Vec3 Random::inBox(const Vec3& lo, const Vec3& hi) {
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = between(lo[i], hi[i]);
  return p;
}

Quat Random::orientation() {
  for (;;) {
    Vec4 p;
    for (int i = 0; i < 4; ++i) p[i] = between(-1.0, 1.0);
    const double square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3];
    if (square > 1.0 || square < 1e-6) continue;
    const double length = std::sqrt(square);
    return Quat(p[0] / length, p[1] / length, p[2] / length, p[3] / length);
  }
}

}  // namespace tumble
