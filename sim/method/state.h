// Chapter 9, method: the half of a world that changes.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sim/body/rigid_body.h"
#include "sim/collide/broad_phase.h"
#include "sim/collide/witness.h"
#include "sim/contact/contact.h"
#include "sim/joint/joint_bonds.h"
#include "sim/method/course/memory.h"
#include "sim/method/effort.h"
#include "sim/method/exact/memory.h"
#include "sim/method/report.h"
#include "sim/method/stages.h"
#include "sim/method/stepping/memory.h"

namespace tumble {

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

/// Time, bodies and books, and what the method at work remembers from step to step.
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
  /// [J] the least so far, without what repairs and forces did to it.
  double energyLeast = std::numeric_limits<double>::infinity();
  double load = 0.0;       ///< [N] Σ|F| of gravity and the forces, at the start
  double loadPower = 0.0;  ///< [W/s] Σ F²/m of the same

  std::vector<Segment> spareTrail;  ///< stretches gone by, whose memory is used again

  std::vector<std::pair<int, int>> near;  ///< pairs that the next step may bring together
  std::vector<PairWitness> witnesses;     ///< planes that parted them when last looked at

  CourseMemory course;      ///< what only `course` remembers,
  ExactMemory exact;        ///< only `exact`,
  SteppingMemory stepping;  ///< only `stepping`

  StageTimes times;  ///< of `stepping` and the audit
  Effort effort;     ///< of the exact method
  /// What `auto` remembers: how the exact method left things, where it gave up.
  std::shared_ptr<const State> before;
};

}  // namespace tumble
