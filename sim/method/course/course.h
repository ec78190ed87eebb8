// The method of the notes: Y(t) through the ODE black box; detect, back up to the instant of
// collision, impulses, resting forces from the LCP at acceleration level (slides SD24–SD57). Other
// plans let bodies overlap and repair that (SH7, SH9); another contact model is springs (SH10).
#pragma once

#include <memory>
#include <optional>

#include "sim/contact/rest.h"
#include "sim/joint/joint_rows.h"
#include "sim/method/course/plan.h"
#include "sim/method/course/system.h"
#include "sim/method/method.h"
#include "sim/ode/integrator.h"

namespace tumble {

void checkCourse(const Model& model, std::span<const RigidBody> bodies);
void advanceCourse(const Model& model, State& state, double t_end, Report& report);
void lookCourse(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
                std::vector<Contact>& contacts, std::vector<JointForce>& joints);

/// Events that are located exactly come out of a store of so many, which every step refills.
inline constexpr int kBackUps = 400;

/// The integrator that the scene names, and the one that stands in for it while contacts last that
/// do not offer what it needs.
class CourseSteppers {
 public:
  CourseSteppers(const Model& model, const System& system);

  /// The one for a system as it is now.
  Stepper& of(const System& system) { return *(stands(system) ? standIn_ : chosen_); }
  /// Whether it divides a step as it finds fit, so that a step in two parts is the same step.
  bool adaptive(const System& system) const { return row_.adaptive && !stands(system); }
  /// True if the other one stands in.
  bool stands(const System& system) const { return hurry || !suits(row_, system); }

  bool hurry = false;  ///< what it costs counts for more than how close it is

 private:
  const Integrator& row_;
  std::unique_ptr<Stepper> chosen_, standIn_;
};

/// The flow chart of slides SD39 and SH18 at work on one world: `move` is its update, `settle` all
/// that follows until the next one.
class Course {
 public:
  Course(const Model& model, State& state, Report& report);

  /// Events of this instant: contacts found, overlap mended, impulses given, contacts that last
  /// listed.
  void settle();
  /// One stretch of motion without an event: to the next instant of the grid, or to the first
  /// event.
  void move();

 private:
  /// Begins a stretch of motion that may last until then [s].
  void begin(double grid);
  void findNear();
  void findTouching();
  /// Stops the run where something touches that cannot have contacts here: a body with a pivot, or
  /// one whose attitude is a matrix.
  void stopUntouchable();
  /// Takes the plan's share of every overlap away, and books what energy that adds.
  void mend();
  /// Moves bodies by the least way, weighed by mass, that takes a share of each overlap away.
  void lift(double share);
  double deepestOverlap() const;
  double energy() const;
  /// Writes down the pairs that overlap among these bodies at time t, unless they are known to.
  void noteMissteps(std::span<const RigidBody> bodies, double t);
  /// Writes down where the bodies stand that do not overlap any more at time t.
  void closeMissteps(std::span<const RigidBody> bodies, double t);

  bool collides() const;
  void respond();
  /// Ends the run with these words, if there are any.
  void stopIf(const std::string& words);
  /// Whether a contact that lasted moves no more than one that lasts.
  bool leans(const Contact& contact) const;
  double restitutionNow(const Contact& contact) const;
  /// What joints gave to bodies from outside in an impact.
  void recordBonds(const Bonds& bonds);
  /// One event for each pair and normal; per contact: vrel [m/s] before, impulse [N·s] on a.
  void recordImpacts(std::span<const Contact> contacts, std::span<const double> vrel,
                     std::span<const Vec3> impulse);
  void settleCreep(std::span<Contact> lasting);
  /// Gives contacts that last, but have no forces, impulses that end a slip. @return whether it did
  bool endJam();
  void chooseLasting();
  /// The contacts that are springs now; tells when they began and ended.
  void chooseSprings();
  /// The instant [s] in a step at which the first pair begins or ceases to overlap, so that forces
  /// set in and end at the ends of steps, where an integrator keeps its order; the step if none
  /// does. Leaves the motion there in y_ and trial_.
  /// @param h  of the step, whose end they hold
  double firstTouch(double h);
  Event springEvent(EventKind kind, const Contact& contact) const;
  /// Separation [m] of a pair a time h after now; trial_ is then there.
  double gapAfter(double h, int a, int b);
  bool wasLasting(int a, int b) const;
  bool isJoined(int body) const;
  /// Whether nothing that the two bodies touch each other with slips by more than `stick` [m/s].
  bool pairIsStill(const Contact& contact, double stick) const;
  /// Slip [m/s] with which the stretch before began, where the same features stuck to each other in
  /// it.
  std::optional<double> slipWhereStuck(const Contact& contact) const;
  /// Upper estimate [m/s²] of what outer forces do to any body.
  double accelerationScale() const;

  /// Whether collisions are located: the plan backs up to them.
  bool locates() const { return contact_.impulses && plan_.backsUp; }
  /// What each near pair's separation must not fall below in this stretch.
  void setFloors();
  /// Gaps of all limits of joints with these bodies, into limits_.
  void lookAtLimits(std::span<const RigidBody> bodies);
  /// How long [s] the motion may go on unseen: no pair passes through each other, no feature dips
  /// in and out again.
  double foresee(double span) const;
  double closingSpeed(std::size_t pair) const;
  /// When [s] the first of these points that dip below their surface turns back.
  double lowestPoint(std::span<const Contact> points, double span) const;
  /// What must not fall below `height`, how far above it is now, and how near has come to it: a gap
  /// [m], or what is left of a slip [m/s].
  struct Floor {
    double height, now, there;
    /// How far above it a value is, as part of how far it is now, up to kFar: of values of any size
    /// and unit the least is a smooth function of time around its zero, and knows nothing of what
    /// ends much later.
    double leeway(double value) const;
  };
  static double slipAlong(std::span<const RigidBody> bodies, const Contact& c);
  /// How far the motion may go, by the value of one function of time: ≥ 0 allowed, < 0 too far. The
  /// least leeway [1] of all floors.
  double allowance(double h);
  /// The last length of step inside [0, span] that is allowed, to the accuracy of time itself.
  /// @param tooFar  `allowance` of the whole span, < 0
  double backUp(double span, double tooFar);
  /// equilibrium.cpp: whether nothing moves in the joints, and all forces cancel.
  bool rests();
  void commit(double t1);
  /// Ends the run at the start of the stretch that was tried.
  void stop(const std::string& why);

  const Model& model_;
  State& state_;
  Report& report_;
  ContactTolerance tolerance_;
  CourseSystem system_;
  CourseSteppers steppers_;
  long counted_ = 0;  ///< evaluations of system_ that are in the certificate
  int jams_ = 0;      ///< that ended at this instant
  const Plan& plan_;
  const ContactModel& contact_;
  RestForces rest_;
  std::vector<Contact> touching_;
  bool hits_ = false;  ///< something touches that does not just lean
  std::vector<double> y0_, y_;
  /// Y at the furthest instant [s] of this stretch that is known to be allowed, from where an
  /// adaptive integrator goes on.
  std::vector<double> yAllowed_;
  double allowed_ = 0.0;
  std::vector<RigidBody> trial_;
  Problem lift_;
  Solution lifted_;
  std::vector<JointRow> limits_;  ///< those that joints have, at the poses last looked at
  std::vector<double> gaps_;      ///< [m] per near pair: separation now
  std::vector<Floor> floors_;     ///< of near pairs, of limits, of slips that may end
  double allowanceNow_ = 0.0;     ///< `allowance` of no motion at all
};

}  // namespace tumble
