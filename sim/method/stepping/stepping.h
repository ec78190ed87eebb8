// Time stepping after Moreau: each step solves one contact problem for the velocities at its end,
//   M (v⁺ − v) = h F + Jᵀ λ,   u_n ≥ −separation/h,  λ_n ≥ 0, complementary, Coulomb's cone,
// moves the bodies with v⁺, and lifts what still overlaps without touching a velocity.
#pragma once

#include <span>
#include <vector>

#include "sim/method/method.h"
#include "sim/problem/problem.h"

namespace tumble {

void checkStepping(const Model& model, std::span<const RigidBody> bodies);
void advanceStepping(const Model& model, State& state, double t_end, Report& report);
void lookStepping(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
                  std::vector<Contact>& contacts);

class Stepping {
 public:
  Stepping(const Model& model, State& state, Report& report);

  /// One step of the grid, shorter only at the end of the run.
  void step();

 private:
  void findNear(double h);
  void buildProblem(double h);
  void addContact(const Contact& contact, double h);
  void solve();
  void applyImpulses(double h);
  void moveBodies(double h);
  /// Free flight of one body through a step; `before` is its velocity [m/s] at the start.
  void coast(RigidBody& body, const Vec3& before, double h) const;
  void project();
  double deepestOverlap();
  void lift();
  bool finite() const;
  void stop();
  /// A contact that pushed in this step.
  struct Push {
    Contact contact;  // with its force
    double approach;  // [m/s] how fast it came
    double j;         // [N·s] all that it got, the step of its arrival included
    bool arriving;    // closed its gap in this step
  };
  /// All of them; keeps impulses and arrivals for the next step.
  std::vector<Push> pushes(double h);
  void recordImpact(double t, std::span<const Push> pair);
  void recordEvents(double t);
  /// vrel [m/s] < 0 below which a touch is an impact: more than gravity gives in two steps.
  double landingSpeed() const;

  const Model& model_;
  State& state_;
  Report& report_;
  ContactTolerance tolerance_;
  Problem problem_;
  Solution solution_;
  std::vector<Contact> contacts_;
  std::vector<Contact> overlaps_;  ///< what the projection sees
  std::vector<Vec6> before_;       ///< twists at the start of the step
  std::vector<char> touched_;      ///< per body: a contact pushed it in this step
  std::vector<double> approach_;   ///< [m/s] per contact: how fast it came
  std::vector<char> rebounds_;     ///< per contact: it leaves with e times its approach
  std::vector<Vec3> impulse_;      ///< [N·s] per contact, on a
};

}  // namespace tumble
