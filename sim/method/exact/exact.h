// From event to event, without a step: bodies fly in closed form, the first instant at which two of
// them touch is found and never passed, an impact law gives them new flights, and what stays in
// contact is held by constant forces, or, where these change, followed by `sustained.h`. The order
// is that of the flow chart of slide SD39; there is no illegal state to come back from.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/method/method.h"

namespace tumble {

/// @throws Refusal for a force under which flight has no closed form, and for a top under more than
///   gravity.
void checkExact(const Model& model, std::span<const RigidBody> bodies);
void advanceExact(const Model& model, State& state, double t_end, Report& report);
/// Any instant: each body by its own flight. Allocates nothing once `bodies` has its size.
void lookExact(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
               std::vector<Contact>& contacts);

/// Bodies that touch each other at one instant, directly or through others that can move, and
/// where.
struct Cluster {
  std::vector<int> bodies;        ///< in the model, in order of discovery
  std::vector<Contact> contacts;  ///< all that touch, bodies as in the model
};

/// The method at work on one world.
class Exact {
 public:
  Exact(const Model& model, State& state, Report& report);

  /// Gives every body its flight from state.t on, after the events of that instant.
  void takeOff();
  /// Goes on to the next event, to the end of the window, or to t_end, whichever is first.
  void next(double t_end);
  /// Tells the rests whose last bounces are over by t, in their place among the events.
  void closeRests(double t);

 private:
  using Pair = std::pair<int, int>;

  // window.cpp: what may meet.
  void openWindow();
  /// Pairs whose swept boxes overlap in the window; shortens it until they are few.
  std::vector<Pair> choosePairs();
  void chooseFrame();
  /// What a body can reach from t until the window's end, seen from its frame.
  Aabb sweptBox(int body, double t) const;
  /// Covers the window with the arcs of all tops.
  void spinTops();
  bool bothFixed(int i, int j) const { return model_.fixed(i) && model_.fixed(j); }

  // touch.cpp: when they do.
  /// The earliest touch of two bodies from t to the window's end goes into the queue.
  void lookFor(Pair pair, double t);
  /// New touches of a body that has just got a new flight.
  void lookAround(int body, double t);
  void push(double t, int a, int b);
  void dropStale();

  // strike.cpp: what happens then.
  void strike(double t, int a, int b);
  Cluster gather(double t, std::span<const int> seeds);
  void noteOverlaps(const Cluster& cluster);
  bool collides(const Cluster& cluster) const;
  void respond(double t, const Cluster& cluster);
  struct Bounces {
    double height, end;
  };
  /// [m] a bounce that would rise less is the last of its row.
  double lowest() const;
  void loadWithout(const Contact& pair, int body);
  std::optional<Bounces> bouncesOf(double t, const Contact& contact);
  /// Restitution of every contact at this instant: 0 for pairs whose row of bounces is over.
  std::vector<double> restitutions(double t, const std::vector<Contact>& contacts);
  void recordImpacts(double t, const Cluster& cluster, std::span<const double> vrel,
                     std::span<const Vec3> impulse);

  // hold.cpp: what stays together.
  /// The events of an instant that is not the end of a flight: all clusters, one after the other.
  void settle();
  /// Finds the forces of contacts that last, and gives all bodies of the cluster their flights.
  void hold(double t, Cluster& cluster);
  /// Lists the contacts that rest and finds their forces, which the bodies then carry, after jams
  /// have come to an end. @return the residual of the contact problem
  double findForces(double t, const Cluster& cluster, std::vector<Contact>& resting);
  std::vector<Contact> restingOf(const Cluster& cluster) const;
  bool endsBounces(const Contact& contact, double vrel) const;
  /// Drops what is neither pushed nor pressed. @return whether any of it parts slowly
  bool letGo(std::vector<Contact>& resting) const;
  /// Gives the bodies of a cluster flights under the forces that they carry.
  void flyOn(double t, const Cluster& cluster);
  /// Whether two bodies would accelerate into each other without contact forces.
  bool presses(const Contact& contact) const;
  /// What acts on its two bodies from outside, as accelerations together [m/s²].
  double weightOn(const Contact& contact) const;
  /// @return the residual of the contact problem
  double solveForces(std::vector<Contact>& resting);
  void stillContacts(const std::vector<Contact>& resting);
  bool slipTurned(const std::vector<Contact>& resting) const;
  bool steady(const Contact& contact) const;
  /// @return the contacts of the cluster that lasted before
  std::vector<Contact> changeHolds(double t, const Cluster& cluster,
                                   const std::vector<Contact>& now);
  bool lasts(int i, int j) const;
  /// Gives contacts that have no forces, or jam, impulses that end a slip. @return whether it did
  bool endJam(double t, const Cluster& cluster, const std::vector<Contact>& resting,
              double residual);
  void sustain(double t, const Cluster& cluster);
  void lookForStops(double t);
  void renew(double t, int body, const Vec3& acceleration);

  // books.cpp: the certificate.
  void bookHolds(double t);
  void keepBooks(double t);
  void bringTo(double t, int body);
  void stop(std::string reason);
  const std::string& nameOf(int body) const { return model_.def.bodies[body].name; }

  const Model& model_;
  State& state_;
  Report& report_;
  ContactTolerance tolerance_;
  /// When the last bounces of pairs that come to rest now would be over, b < a.
  std::vector<std::pair<Pair, double>> ends_;
};

/// The shortest digits that give the same number again, the same in every locale.
std::string digits(double value);
/// Why a run ends where there are too many events, and what to try.
std::string crowdedAt(double t);
/// Whom rounding drives how deep [m] into each other, and what to change.
std::string unheldAt(const Model& model, const Contact& contact, double t, double deep);
/// Who cannot get out of whose way.
std::string crushedAt(const Model& model, const Contact& contact, double t);

}  // namespace tumble
