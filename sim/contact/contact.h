// Chapter 7, contact: two bodies that touch – how they approach, how the normal turns, what is
// rest.
#pragma once

#include <span>
#include <vector>

#include "sim/body/rigid_body.h"
#include "sim/collide/contact_point.h"

namespace tumble {

/// The three kinds of contact of slides SD30–SD31 and SD37–SD38.
enum class ContactClass { Colliding, Resting, Separating };

/// Bands inside which a number counts as zero. All of them grow with the size of the world [m],
/// because rounding does.
struct ContactTolerance {
  double touch = 1e-9;   ///< [m] nearer than this is touching
  double root = 1e-12;   ///< [m] overlap that dates a collision
  double drift = 1e-10;  ///< [m] overlap that a lasting contact may gain in one step
  double rest = 1e-10;   ///< [m/s] |vrel| of a resting contact
  double keep = 1e-6;    ///< [m/s] |vrel| up to which a lasting contact stays lasting
  double stick = 1e-9;   ///< [m/s] slip of a sticking contact

  /// [m] Worlds below this size have tolerances that shrink with it.
  static constexpr double kSmall = 5e-2;
  /// What lengths and speeds are multiplied by, in a world of this size [m]: the size of what is
  /// large, 1 from kSmall to 1 m, and less where all is small.
  static double scaleOf(double size);
  static ContactTolerance forSize(double size);
};

/// A contact point that rides along with its two bodies: the features that touch, in body frames.
struct Anchor {
  Vec3 pa_B = Vec3::Zero(), pb_B = Vec3::Zero();  ///< [m] material points; of rims their centres
  Vec3 n_B = Vec3::Zero();                        ///< normal in the frame of the body it is tied to
  Vec3 ea_B = Vec3::Zero(), eb_B = Vec3::Zero();  ///< edge directions, axes of rims
  Vec3 place_B = Vec3::Zero();                    ///< [m] in b, of edges and rims at a slant
};

/// One contact between two bodies of a world.
struct Contact {
  int a = 0, b = 0;    ///< bodies; b stands first in the scene
  ContactPoint point;  ///< as found, or as last followed
  Anchor anchor;
  double restitution = 0.0, friction = 0.0;
  double scale = 1.0;            ///< [m/s] of speeds of which slips are told from none; ≤ 1
  double granted = 0.0;          ///< [m] overlap that the pull of a lasting contact leaves alone
  double pull = 0.0;             ///< [m/s²] along −n, towards no approach and that overlap
  Vec3 slipPull = Vec3::Zero();  ///< [m/s²] against the slip, while it sticks
  double energy = 0.0;           ///< [J] stored, if the contact is a spring
  bool lasting = false;          ///< rests: takes part in the contact forces
  bool sliding = false;          ///< its friction is kinetic
  bool creeping = false;         ///< slides so slowly that a step could turn its slip round
  bool mayStick = false;         ///< its slip can come to an end along slipDirection
  bool idle = false;             ///< touches and lasts, but carries nothing
  Vec3 slipDirection = Vec3::Zero();  ///< of the slip at the start of this stretch of motion
  double onset = 0.0;          ///< [m/s] below this, a slip that has just begun follows `growth`:
  Vec3 growth = Vec3::Zero();  ///< [1] the direction in which it grows
  Vec3 force = Vec3::Zero();   ///< [N] on a, friction included
};

/// vrel = n·(ṗa − ṗb) [m/s]: < 0 approaches (slide SD30; Baraff, Rigid Body Simulation II, §8).
double approachVelocity(const RigidBody& a, const RigidBody& b, const ContactPoint& c);

/// Tangential part of ṗa − ṗb [m/s] at the contact point.
Vec3 slipVelocity(const RigidBody& a, const RigidBody& b, const ContactPoint& c);

/// Whether a slip [m/s] has ended, or goes by more than 60 degrees another way than the contact
/// slides.
bool hasTurned(const Contact& c, const Vec3& slip);

/// Colliding below −tolerance, separating above it, resting between. [m/s]
ContactClass classify(double vrel, double tolerance);

/// Ties a contact point, as found at this pose, to its two bodies.
Anchor anchorOf(const RigidBody& a, const RigidBody& b, const ContactPoint& c);

/// Where the same features are now: brings p, n, separation, pa, pb and edges of `c.point` up to
/// date with the poses of a and b.
void follow(const RigidBody& a, const RigidBody& b, Contact& c);

/// ṅ [1/s]: how fast the contact normal turns with the features it is tied to.
Vec3 normalRate(const RigidBody& a, const RigidBody& b, const ContactPoint& c);

/// Velocity [m/s] of the place of contact, which is a material point of neither body when they
/// roll.
Vec3 placeVelocity(const RigidBody& a, const RigidBody& b, const ContactPoint& c);

/// How fast [rad/s], as seen in space, the place of contact runs round the rims that touch there:
/// the outermost point along n of a circle about u goes round n as u does,
///   (n·w − (u·w)(u·n))/(1 − (u·n)²),   w the angular velocity of the one body against the other.
double runsRound(const RigidBody& a, const RigidBody& b, const ContactPoint& c);

/// The part of d²(separation)/dt² [m/s²] that does not come from accelerations:
///   n·(ωa×(ωa×ra) − ωb×(ωb×rb)) + ṅ·(ṗa − ṗb) + n·(ωa×wa − ωb×wb)
/// with wa and wb the velocities at which pa and pb wander over their bodies: feet on faces and
/// edges, and outermost points of rims. Without rims it is  … + 2 ṅ·(ṗa − ṗb) − |pa − pb| |ṅ|².
/// Baraff II, §9.3. Departure: round bodies. ra, rb reach to pa, pb.
double normalAccelerationBias(const RigidBody& a, const RigidBody& b, const ContactPoint& c);

/// Acceleration [m/s²] of the material point at p [m] under the body's force and torque; 0 of a
/// fixed body.
Vec3 pointAcceleration(const RigidBody& body, const Vec3& p);

/// n·p″ = d²(separation)/dt² [m/s²] under the forces and torques that the bodies carry (slide
/// SD48).
double normalAcceleration(const RigidBody& a, const RigidBody& b, const ContactPoint& c);

/// d(slip)/dt [m/s²] along the surface under the forces and torques that the bodies carry.
Vec3 slipAcceleration(const RigidBody& a, const RigidBody& b, const ContactPoint& c);

/// The part of d(slip)/dt [m/s²] along t that does not come from accelerations.
double slipAccelerationBias(const RigidBody& a, const RigidBody& b, const ContactPoint& c,
                            const Vec3& t);

/// Two unit tangents, the first along `preferred` where that has a tangential part.
void tangents(const Vec3& n, const Vec3& preferred, Vec3& t1, Vec3& t2);

}  // namespace tumble
