// What drives bodies through a step of `stepping` beside gravity: springs and fields, which change
// on the way; drag, which decays; steady forces.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/body/body_system.h"
#include "sim/flight/rotor.h"
#include "sim/math/decay.h"
#include "sim/method/model.h"
#include "sim/ode/integrator.h"

namespace tumble {

/// Bodies under forces that change on the way, as one system, with a ledger at the end of Y: the
/// work [J] of forces without a potential, and the impulse [N·s] of all forces on them together.
class DrivenSystem : public System {
 public:
  static constexpr int kLedger = 4;

  DrivenSystem(const Vec3& gravity, const std::vector<Force>& forces,
               std::span<const RigidBody> bodies);

  int size() const override { return bodies_.size() + kLedger; }
  void derivative(double t, std::span<const double> y, std::span<double> ydot) const override;
  void normalise(std::span<double> y) const override;

  /// The bodies as they are, with an empty ledger.
  void pack(std::span<const RigidBody> bodies, std::span<double> y);
  void unpack(std::span<const double> y, std::span<RigidBody> bodies) const;

 private:
  BodySystem bodies_;
  std::vector<Force> forces_;
  mutable std::vector<RigidBody> work_;
};

/// Bodies that springs join, or one that a field drives, or a force that grips it off its centre,
/// or one in a joint that drag brakes. While nothing touches one of them, nor any joint holds it,
/// they follow their equation of motion to rounding. Where joints alone hold them, forces act in
/// halves, before they move and after. Else, or where springs are too stiff for either, their
/// springs are rows of the contact problem.
struct DrivenGroup {
  std::vector<int> bodies;      ///< in order; fixed ones that hold a spring too
  std::vector<Force> forces;    ///< all on them, by places in `bodies`
  std::vector<Force> others;    ///< those that are no springs
  std::vector<Spring> springs;  ///< by bodies of the world
  std::vector<Force> stores;    ///< the same
  bool steady = false;          ///< winds and point forces alone: one body, which they turn with
  bool plain = false;           ///< springs, with winds and drag: no field, no grip
  double fastest = 0.0;         ///< [rad/s] as by fastestDrive, in this part of a step
  bool stiff = false;           ///< faster than a step can follow
  bool bound = false;           ///< something holds it in this step
  bool halved = false;          ///< and forces on it act in halves; else its springs are rows
  int chain = 0;                ///< its place in Drives::chains
  double power = 0.0;           ///< [W] of what has no potential, at the start of a step in halves
  std::shared_ptr<DrivenSystem> system;
  std::shared_ptr<Stepper> stepper;
  std::vector<RigidBody> moved;
  std::vector<double> y;
};

/// Along one line: f = −(k s + c ṡ).
struct SpringLaw {
  double stiffness = 0.0, damping = 0.0;  ///< [N/m], [N s/m]
  double stretch = 0.0;                   ///< [m] s at the start of the step
  double bend = 0.0;  ///< [m] what s gains in it beside h ṡ, its ends going on as they do
};

/// The row of a spring in a step of h, whose ends move as u⁻ before it and as u⁺ at its end:
///   λ = −h (k (s + h (a u⁺ − b u⁻)) + c (θ u⁺ + (1 − θ) u⁻)).
/// Where h²k/m is small, a = b = ¼, θ = ½: areas are kept, and with them energy but for terms that
/// swing, as by leapfrog, at any h²k/m (Newmark's method; Hairer, Lubich and Wanner, Geometric
/// Numerical Integration, §XIII). Where it is large, a = θ = 1, b = 0: what is faster than the step
/// is damped (implicit Euler).
struct SpringRow {
  int bond = 0;                    ///< its row
  const Spring* spring = nullptr;  ///< whose it is
  int across = 0;                  ///< 0: along the spring; 1, 2: across it; 3: it has no length
  SpringLaw law;
  double a = 0.25, b = 0.25, theta = 0.5;
  double before = 0.0;  ///< [m/s] u⁻
  bool stiff = false;
  /// Whether it has, after a step, the length that its row gives it then.
  bool isRigid() const {
    constexpr double kRigid = 0.99;  // of the end of a step, in what it goes by
    return stiff && across == 0 && a > kRigid;
  }
};

/// Linear drag on one body, of all forces together.
struct Drag {
  int body = 0;
  double linear = 0.0, angular = 0.0;  ///< [N s/m], [N m s]
  Mat3 axes = Mat3::Identity();        ///< principal axes, in the body frame
  Vec3 inverse = Vec3::Zero();         ///< [1/(kg m²)] inverse moments about them
};

/// Bodies that joints and springs make one.
struct Chain {
  bool limited = false;  ///< a joint in it has limits
  bool halved = false;   ///< forces on it act in halves in this step
  bool soft = true;      ///< a step can follow what drives it
  bool free = false;     ///< it is soft, and nothing is known to touch it in this step
};

/// All of a model, dealt out.
struct Drives {
  std::vector<DrivenGroup> groups;
  std::vector<Drag> drags;
  std::vector<Chain> chains;
  std::vector<int> groupOf, dragOf, chainOf;  ///< per body; −1: none
  std::vector<Force> steady;  ///< wind and point forces, one for each body that they act on
  std::vector<Force> outer;   ///< all but those of what bends
};
Drives drivesOf(const Model& model, std::span<const RigidBody> bodies);

/// How fast [rad/s] the springs and the drag of a group could move its bodies, at most.
double fastestDrive(const DrivenGroup& group, std::span<const Drag> drags,
                    const std::vector<int>& dragOf, std::span<const RigidBody> bodies);

/// What linear drag makes of a step of one body at its attitude: momenta decay on the way, and so
/// do the impulses that contacts give.
struct DragStep {
  Decay way;                         ///< of velocities
  Mat3 left = Mat3::Identity();      ///< what the step leaves of the angular velocity
  Mat3 halfLeft = Mat3::Identity();  ///< and half of it
  Mat3 Iinv = Mat3::Zero();          ///< [1/(kg m²)] what an angular impulse gives
  Mat3 I = Mat3::Zero();             ///< [kg m²] its inverse
};
DragStep dragStep(const Drag& drag, const RigidBody& body, double h);

/// The turn of a body that nothing twists, from an instant on.
struct FreeSpin {
  std::optional<Rotor> rotor;
  Quat q = Quat::Identity();  ///< where it has come to
  Vec3 L = Vec3::Zero();      ///< [kg m²/s]
  double spent = 0.0;         ///< [s] since the instant
};

}  // namespace tumble
