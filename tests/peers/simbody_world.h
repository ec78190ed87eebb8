// One body on the ground in Simbody, as plain numbers: its headers are not C++20.
#pragma once

#include <memory>

namespace tumble::peers {

/// A ball or box above the ground y = 0. World frame, SI; q is (w, x, y, z).
struct SimbodyBody {
  bool ball = true;
  double radius = 0.0, half[3] = {};
  double mass = 1.0, inertia[3] = {};
  double x[3] = {}, q[4] = {1, 0, 0, 0}, v[3] = {}, omega[3] = {};
};

/// Contacts are compliant: stiffness [Pa], Hunt and Crossley's dissipation [s/m].
struct SimbodyContact {
  bool ground = true;
  double friction = 0.0, stiffness = 1e7, dissipation = 0.0;
};

class SimbodyWorld {
 public:
  /// @param accuracy  of Runge, Kutta and Merson's method; 0: fixed steps of h
  SimbodyWorld(const SimbodyBody& body, const SimbodyContact& contact, const double gravity[3],
               double h, double accuracy);
  ~SimbodyWorld();
  void advance(double t);
  /// x, q, v and omega of the body.
  void read(SimbodyBody& body) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tumble::peers
