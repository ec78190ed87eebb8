// Chapter 5, collide: what two bodies share where they touch.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/math/vec.h"

namespace tumble {

/// What the contact normal is fixed to, and so how it turns while the bodies move.
enum class NormalTie : std::uint8_t {
  FaceOfB,  ///< a point of a against a face of b: n rides on b
  FaceOfA,  ///< a point of b against a face of a: n rides on a
  Points,   ///< two points (ball centres, vertices): n along pa − pb
  EdgeOfB,  ///< a point of a against an edge of b: n along the part of pa − pb across eb
  EdgeOfA,  ///< a point of b against an edge of a
  Edges,    ///< edges or rims against each other: n across both, of edges along ± ea × eb
};

/// One point of contact, or of nearness. World frame, SI.
///   pa − pb = (separation + ra + rb) n,  n out of b towards a.
struct ContactPoint {
  Vec3 p = Vec3::Zero();      ///< [m] where forces act: midway between the two surfaces
  Vec3 n = Vec3::UnitY();     ///< [1] unit contact normal, out of b towards a
  double separation = 0.0;    ///< [m] gap along n; < 0 is overlap
  std::uint64_t feature = 0;  ///< the same as long as the same features of the pair touch
  NormalTie tie = NormalTie::FaceOfB;
  Vec3 pa = Vec3::Zero(),
       pb = Vec3::Zero();     ///< [m] the material points (ball centre, vertex, foot) of a and b
  double ra = 0.0, rb = 0.0;  ///< [m] radius about pa and pb: of a ball, else 0
  Vec3 ea = Vec3::Zero(),
       eb = Vec3::Zero();  ///< [1] unit edge directions where the tie names edges; see rims
  /// [m] Radius of the rim, a circle, whose outermost point pa or pb is, 0 if it is none; then ea
  /// or eb is the axis of the circle, and the point wanders along it as the solid rolls.
  double rimA = 0.0, rimB = 0.0;
  /// [m] Semi-axes of an ellipsoid, else 0: then radius and rim are those of the torus that bends
  /// as it does here (ellipsoid.h).
  Vec3 halfA = Vec3::Zero(), halfB = Vec3::Zero();
  /// Of a contact of a face, or of a rim at a slant: pa and pb are where an edge of
  /// a crosses one of b, along ea and eb, and wander along both. Of a rim, ea or eb is then the
  /// unit vector from its centre to the point.
  bool crosses = false;
  /// It is an end of round bodies that cross, and are nearest, elsewhere.
  bool beside = false;
};

/// The same contact seen with a and b exchanged.
void mirror(ContactPoint& c);

/// The points of one pair, with one normal.
using Manifold = std::vector<ContactPoint>;

}  // namespace tumble
