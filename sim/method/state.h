// Chapter 9, method: the half of a world that changes.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sim/body/rigid_body.h"
#include "sim/collide/broad_phase.h"
#include "sim/collide/witness.h"
#include "sim/contact/contact.h"
#include "sim/flight/flight.h"
#include "sim/flight/top.h"
#include "sim/joint/joint_bonds.h"
#include "sim/method/effort.h"
#include "sim/method/exact/pace.h"
#include "sim/method/report.h"
#include "sim/method/stepping/memory.h"
#include "sim/shape/outline.h"

namespace tumble {

/// A part of a step that was divided for some bodies alone.
struct ClusterPart {
  double t0 = 0.0, t1 = 0.0;  ///< [s]
  std::vector<int> bodies;
  std::vector<RigidBody> start, end;  ///< these bodies, as in Segment
  std::vector<Contact> contacts;      ///< theirs
};

/// A stretch of motion without an event in it, kept so that any instant inside can be looked at.
struct Segment {
  double t0 = 0.0, t1 = 0.0;     ///< [s]
  std::vector<RigidBody> start;  ///< the bodies at t0, after the events of t0
  std::vector<RigidBody> end;    ///< the bodies at t1, before its events
  std::vector<Contact>
      contacts;  ///< the lasting contacts, for `stepping` with the forces of the step
  std::vector<Limit> limits = {};        ///< of joints, that hold
  std::vector<JointForce> joints = {};   ///< of `stepping`: the forces of the step
  bool still = false;                    ///< nothing changes in it; of `course`: without an end
  long steps = 1;                        ///< of `stepping`: that it is made of, 1 if not still
  bool crossing = false;                 ///< of `exact`: a step across events that crowd
  std::vector<ClusterPart> pieces = {};  ///< of `stepping`: where bodies have parts of their own
};

/// Time, bodies, and what a method remembers from step to step.
struct State {
  double t = 0.0;      ///< [s]
  long gridIndex = 0;  ///< whole steps done; the grid is gridIndex · h
  std::vector<RigidBody> bodies;
  std::vector<Contact> lasting;  ///< contacts that rest or slide
  std::vector<Limit> limits;     ///< of joints, that are reached and at rest
  BroadPhase broadPhase;
  std::vector<Segment> trail;  ///< from the advance before the last one up to t

  // Running totals behind the certificate.
  Vec3 externalImpulse = Vec3::Zero();  ///< [N·s] of all forces and impulses from outside
  Vec3 momentumStart = Vec3::Zero();    ///< [kg m/s]
  double momentumDrift = 0.0;           ///< [kg m/s] worst |P − P₀ − ∫F − Σ impulses|
  double momentumScale = 0.0;           ///< [kg m/s] max of Σ|P|
  double kineticMax = 0.0;              ///< [J]
  /// [J] of the step before, without what repairs and forces did to it.
  double energyOwn = std::numeric_limits<double>::infinity();
  double load = 0.0;       ///< [N] Σ|F| of gravity and the forces, at the start
  double loadPower = 0.0;  ///< [W/s] Σ F²/m of the same

  SteppingMemory stepping;          ///< what only `stepping` remembers
  std::vector<Segment> spareTrail;  ///< stretches gone by, whose memory is used again

  std::vector<std::pair<int, int>> near;  ///< pairs that the next step may bring together
  std::vector<PairWitness> witnesses;     ///< planes that parted them when last looked at

  // What only `course` remembers: whether the contacts of this instant are known, and the events
  // since the last whole step.
  bool settled = false;
  std::map<std::pair<int, int>, int> recentImpacts;
  int recentBackUps = 0;  ///< stretches that ended before the step did
  int backUpsSpent = 0;   ///< of the store that every whole step refills
  int stalled = 0;        ///< events in a row that moved time by nothing

  // What only `exact` remembers: how every body flies, and what is to happen next.
  /// Per body: its flights, each from the end of the one before; the last has no end yet.
  std::vector<std::vector<Flight>> flights;
  std::vector<HeavyTop> tops;  ///< in place of the flights of bodies with pivots, as Model::pivots
  std::vector<std::vector<Convex>> parts;  ///< per body: what others can touch
  std::vector<Vec3> bookedX, bookedP;      ///< [m], [kg m/s] per body: x and P at `booked`
  std::vector<Vec3> outer;                 ///< [N] per body: constant force, gravity included
  double lookedAt = 0.0;                   ///< [s] end of the advance before this one

  /// One stretch of time that is looked through at once, in a frame that may drift and fall.
  struct Window {
    double t0 = 0.0, t1 = 0.0;        ///< [s]
    double length = 0.0;              ///< [s] what the last one was made for
    Vec3 drift = Vec3::Zero();        ///< [m/s] of the frame at t0
    Vec3 fall = Vec3::Zero();         ///< [m/s²] of the frame
    std::vector<int> finite, planes;  ///< bodies that can touch something
    std::vector<Aabb> swept;          ///< per body of the model: what it can reach until t1
    long renewals = 0;                ///< flights begun inside
  };
  Window window;

  /// Two bodies that will touch unless one of them changes its flight before.
  struct Touch {
    double t = 0.0;  ///< [s]
    int a = 0, b = 0;
    long flightA = 0, flightB = 0;  ///< which flights of theirs this was found for
  };
  std::vector<Touch> queue;       ///< a heap, the earliest first
  std::vector<long> flightCount;  ///< per body

  /// The contacts that last from an instant on, with their forces.
  struct Hold {
    double t = 0.0;
    std::vector<Contact> contacts;
  };
  std::vector<Hold> holds;
  std::vector<Event> closing;  ///< rests whose last bounces are under way
  double booked = 0.0;         ///< [s] up to which the books are kept,
  double bookedHold = 0.0;     ///< [s] and what lasting contacts did

  // What `exact` remembers of contacts that last while their forces change.
  bool sustained = false;   ///< bodies go on through such a stretch
  bool modesKnown = false;  ///< which contact sticks, slides or idles
  bool jammed = false;      ///< forces grow beyond all bounds
  bool lawless = false;     ///< no forces were found that obey the laws of contact
  int stretchesLeft = 0;    ///< until closed forms are tried again,
  int patience = 0;         ///< and how many the next time
  Pace pace;                ///< of its events

  Effort effort;  ///< of the exact method
  /// What `auto` remembers: how the exact method left things, where it gave up.
  std::shared_ptr<const State> before;
};

}  // namespace tumble
