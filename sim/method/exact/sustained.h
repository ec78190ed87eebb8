// Contacts that last while their forces change: a differential-algebraic equation as long as every
// contact keeps to its mode (sticks, slides, idle), and events where one of them cannot.
#pragma once

#include <optional>
#include <vector>

#include "sim/contact/rest.h"
#include "sim/math/root.h"
#include "sim/method/exact/sustained_system.h"
#include "sim/method/method.h"
#include "sim/ode/path.h"

namespace tumble {

/// All bodies of a world on their way through one stretch without an event. Positions and
/// velocities are held to the contacts after every step. What ends a stretch:
///   a normal force that would pull · friction that would have to be more than mu f_n · the end of
///   a slip · a touch · a feature that slides off · friction that jams (Painlevé).
/// Instants are found to the accuracy of time itself; of forces, a part kMargin late, so that the
/// contact problem sees what is to change.
class Sustained {
 public:
  Sustained(const Model& model, State& state, Report& report);

  /// Goes on to the next event, or as far as can be looked ahead; then closed forms may be tried.
  void next();

 private:
  struct Near {
    int b = 0, a = 0;
    bool lasts = false;
    double now = 0.0;    ///< [m] gap at the start
    double floor = 0.0;  ///< [m] gap that must not be passed
    double speed = 0.0;  ///< [m/s] that the gap cannot change faster than
  };
  enum class Cause { None, Touch, Mode };
  /// What the bodies show at one instant of the stretch.
  struct Look {
    double s = 0.0;                 ///< [s] since its start
    double allowed = 0.0;           ///< see allowance()
    bool turned = false;            ///< a slip has left the direction of its start too far behind
    std::vector<double> gaps = {};  ///< [m] of near_
    std::vector<double> heights = {}, rates = {};  ///< [m], [m/s] of watched_
  };

  /// Sets h [s] to the first event, or to where the stretch ends without one. @return whether
  /// there is one
  bool findEvent(double& h);
  /// The first change between two looks, all being well at the first; nothing if none is seen.
  std::optional<Bracket> between(const Look& lo, const Look& hi);
  Look look(double s);
  /// How far the motion may go: ≥ 0 a mode and no overlap, < 0 too far. Leaves y_, trial_, cause_.
  double allowance(double h);
  /// The height of the lowest point that does not touch yet, where that is left to sink [m].
  double lowestWatched() const;
  /// < 0 where a pair that touches would be found to touch in another way.
  double featureAllowance() const;
  double ambiguity(const Contact& contact) const;
  void commit(double h);
  /// Goes on by one step of at most that length [s], whatever the contacts do.
  void cross(double most);
  bool givesEnergy() const;
  void leave();
  void keepPace(bool event);

  // modes.cpp: what each contact does.
  void chooseModes();
  /// The contact problem of this instant; contact forces are left on bodies and contacts.
  SolveReport solveCones(std::vector<RigidBody>& bodies, std::vector<Contact>& contacts) const;
  /// Whether the forces of the modes, which the bodies carry, accelerate as the contact problem.
  bool conesAgree(std::span<const RigidBody> bodies) const;
  /// Marks a slip that begins.
  void markOnset();
  void unload();
  bool pairCarries(std::size_t contact) const;
  double modeAllowance();
  double forceAllowance(std::size_t contact) const;
  double slipAllowance(std::size_t contact) const;
  double forceScale(const Contact& contact) const;

  // foresight.cpp: how far to look.
  double lookAhead() const;
  void findNear(double h);
  double speedBound(int a, int b, double h) const;
  /// Whether bodies that were too far apart overlap where they were last tried; they are near then.
  bool metUnseen();
  /// An instant between two looks at which something may have happened unseen; hi.s if there is
  /// none.
  double doubt(const Look& lo, const Look& hi) const;
  bool slipTurned() const;
  /// Whether a slip has grown beyond its onset.
  bool slipBegan() const;

  const Model& model_;
  State& state_;
  Report& report_;
  ContactTolerance tolerance_;
  SustainedSystem system_;
  Extrapolation integrator_;
  Path path_;
  std::vector<double> y0_, y_;
  std::vector<RigidBody> trial_;
  std::vector<Near> near_;
  std::vector<Near> apart_;        ///< pairs that are too far apart to meet
  std::vector<Contact> watched_;   ///< points of lasting pairs that do not last
  std::vector<Contact> touching_;  ///< points of lasting pairs that touched at the start
  std::vector<double> gaps_;       ///< [m] of near_, where the bodies were last tried
  std::vector<double> slip_;       ///< [m/s] per lasting contact, at the start
  const double onset_;             ///< [m/s] up to which a slip that begins follows its growth
  double acceleration_ = 1.0;      ///< [m/s²] what counts as large
  double most_ = 0.0;              ///< [s] how far could be looked ahead
  long counted_ = 0;               ///< evaluations of system_ that are in the certificate,
  long before_ = 0;                ///< and those before this stretch
  Cause cause_ = Cause::None;
  double overlap_ = 0.0;  ///< [m] of the bodies last tried, beyond what is allowed
};

/// The bodies at time t of the trail, and their lasting contacts with forces.
void lookSustained(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
                   std::vector<Contact>& contacts);

}  // namespace tumble
