#include "sim/collide/contact_point.h"

#include <utility>

#include "sim/collide/features.h"

namespace tumble {
namespace {

NormalTie mirrored(NormalTie tie) {
  switch (tie) {
    case NormalTie::FaceOfA:
      return NormalTie::FaceOfB;
    case NormalTie::FaceOfB:
      return NormalTie::FaceOfA;
    case NormalTie::EdgeOfA:
      return NormalTie::EdgeOfB;
    case NormalTie::EdgeOfB:
      return NormalTie::EdgeOfA;
    default:
      return tie;
  }
}

}  // namespace

void mirror(ContactPoint& c) {
  c.n = -c.n;
  c.tie = mirrored(c.tie);
  c.feature = swappedFeature(c.feature);
  std::swap(c.pa, c.pb);
  std::swap(c.ra, c.rb);
  std::swap(c.ea, c.eb);
  std::swap(c.rimA, c.rimB);
  std::swap(c.halfA, c.halfB);
}

}  // namespace tumble
