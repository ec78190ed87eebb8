// A body that falls without spin onto a floor and bounces: all of its motion in closed form.
#pragma once

#include <vector>

#include "app/scene/scene.h"

namespace tumble {

/// Fall along the floor's normal; heights [m] are of the contact above the floor, speeds [m/s]
/// upward. Between hits the height is a parabola; each hit turns the speed into −e times itself.
struct Fall {
  int body = 0, floor = 0;
  Vec3 normal = Vec3::UnitY();
  double g = 9.81;                   ///< [m/s²] acceleration against the normal, > 0
  double height = 0.0, speed = 0.0;  ///< at t = 0
  double e = 0.0, mu = 0.0;
  /// Velocity [m/s] and acceleration [m/s²] across the normal; hits without friction leave them
  /// alone.
  Vec3 glide = Vec3::Zero(), glideAcceleration = Vec3::Zero();

  /// √(v² + 2 g h) [m/s], the speed of the first hit.
  double hitSpeed() const;
  /// (v + √(v² + 2 g h))/g [s].
  double firstHit() const;
  /// Time of the n-th hit [s], n ≥ 1.
  double hitTime(int n) const;
  /// Height of the n-th apex, e^(2n) hitSpeed²/(2 g); n = 0 is the one of the first fall. [m]
  double apex(int n) const;
  /// Time of the n-th apex [s], n ≥ 1.
  double apexTime(int n) const;
  /// First hit + 2 hitSpeed/g · e/(1 − e), the sum of the geometric series [s]; infinite for e = 1.
  /// From rest this is t1 (1 + e)/(1 − e).
  double restTime() const;
  /// Height at a time [m].
  double heightAt(double t) const;
  /// Whether friction acts sideways while the body touches.
  bool rubs() const { return mu > 0.0 && !(glide.isZero() && glideAcceleration.isZero()); }
};

/// Every moving body that falls onto a half-space at rest without spinning or beginning to: a
/// sphere, or a box or cylinder whose contact lies symmetrically under its centre and does not rub.
/// Bodies with forces that leave no parabola, and bodies that start in contact, are left out.
std::vector<Fall> fallsOf(const Scene& scene);

}  // namespace tumble
