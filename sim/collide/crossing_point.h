// Chapter 5, collide: where an edge or a rim of one solid crosses one of the other.
#pragma once

#include <utility>

#include "sim/collide/contact_point.h"

namespace tumble {

/// Tangents [1] along which the point of a crossing wanders over a, and over b.
Vec3 crossingAlongA(const ContactPoint& c);
Vec3 crossingAlongB(const ContactPoint& c);

/// Moves the point of a contact of a face to where the edges or rims of both cross, seen along n,
/// from the places at which they are given; sets pa, pb and, of rims, ea or eb.
/// @param fromA, fromB  [m] points of edges, or centres of rims
void alignCrossing(ContactPoint& c, const Vec3& fromA, const Vec3& fromB);

/// Whether edges or rims cross at a slant: n is across both, not that of a face.
inline bool isSlant(const ContactPoint& c) {
  return c.tie == NormalTie::Edges && c.crosses;
}

/// Two edges or rims at a slant, at points whose offset way = pa − pb is to be square to both:
///   ta·way = tb·way = 0
/// A way wa along a changes ta·way by (1 + way·bendA) wa, and tb·way by (ta·tb) wa.
struct Slant {
  Vec3 ta, tb;        ///< [1] unit tangents
  Vec3 bendA, bendB;  ///< [1/m] how they turn along rims; 0 of edges

  /// Of a contact with its normal.
  explicit Slant(const ContactPoint& c);
  /// @param ta, tb  [1] tangents there
  Slant(const ContactPoint& c, const Vec3& ta, const Vec3& tb);
  /// The ways [m] along both that bring ta·way = a and tb·way = b to 0; of rates, speeds.
  std::pair<double, double> ways(double a, double b) const;

 private:
  double growthA_, growthB_, cosine_;
};

/// Moves the point of an edge or a rim against another at a slant to where they cross; sets n
/// across both, pa, pb, the separation and, of rims, ea or eb.
/// @param fromA, fromB    [m] points of edges, or centres of rims
/// @param alongA, alongB  [1] unit directions of edges, or axes of rims
void alignSlant(ContactPoint& c, const Vec3& fromA, const Vec3& fromB, const Vec3& alongA,
                const Vec3& alongB);

}  // namespace tumble
