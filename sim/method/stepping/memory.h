// What `stepping` remembers from step to step. None of it changes an answer beyond rounding: it
// spares looking twice at what has not changed.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/collide/witness.h"
#include "sim/contact/bonds.h"
#include "sim/contact/contact.h"
#include "sim/joint/joint_rows.h"
#include "sim/joint/swing.h"
#include "sim/method/report.h"
#include "sim/method/stepping/bending.h"
#include "sim/method/stepping/drives.h"
#include "sim/method/stepping/island.h"
#include "sim/problem/problem.h"
#include "sim/shape/outline.h"

namespace tumble {

/// Of the numbers that a pose is made of: one that differs by less is the same.
constexpr double kPoseRounding = 4e-16;

/// What a contact problem sees of a contact point.
struct Lever {
  Vec3 n = Vec3::Zero();
  Vec3 armA = Vec3::Zero(), armB = Vec3::Zero();  ///< [m] from the bodies; 0 of one that stands
  double separation = 0.0;                        ///< [m]
};

/// What is not known yet.
inline Vec3 unknown() {
  return Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// A contact point, and what the last step that solved for it found.
struct Touch {
  Contact contact;              ///< as found; with the force of the step
  Lever lever;                  ///< when its look was numbered
  Vec3 impulse = Vec3::Zero();  ///< [N·s] on a
  Vec3 pull = unknown();        ///< [N·s] as Solution::pull
  double length = 0.0;          ///< [s] of the part of a step that gave it
  bool rebounds = false;        ///< when it is struck
  double due = 0.0;             ///< [s] until it is struck or, of free bodies, until they meet
  double approach = 0.0;        ///< [m/s] how fast it came
  bool pushedOpen = false;      ///< pushed in the step before, though its gap was open
  double arrivalSpeed = 0.0;    ///< [m/s] of a hit that closed its gap in the step before
  double arrivalImpulse = 0.0;  ///< [N·s] that it got so far
};

/// The contact points of a near pair, as found at two poses.
struct PairMemory {
  Pose poseA, poseB;
  double margin = -1.0;  ///< [m] up to which points were looked for; < 0: never looked at
  long look = 0;         ///< number of the look that found them: the same number, the same levers
  long form = 0;         ///< number of the look that found these features first, in a row
  long asked = 0;        ///< the look after which it was asked whether the two meet at a seam
  double deepest = 0.0;  ///< [m] largest overlap
  bool bounces = false;  ///< it has restitution
  bool lands = false;    ///< it has none, and nothing of it bends
  bool strikes = false;  ///< its hits are foreseen, and struck when they are
  bool tumbles = false;  ///< it turned too far for parabolas
  double lasts = 0.0;    ///< [s] how long its point on a rim is where it is, if it tumbles
  bool seamed = false;   ///< a third body keeps apart what was found
  std::vector<Touch> touches;
};

/// The first lasting contact of a pair that has one.
struct LastingPair {
  int a = 0, b = 0;
  bool sliding = false;
  Vec3 p = Vec3::Zero(), n = Vec3::UnitY();  ///< of its point
};
inline LastingPair lastingPair(const Contact& c) {
  return {.a = c.a, .b = c.b, .sliding = c.sliding, .p = c.point.p, .n = c.point.n};
}

/// What acted on a body in the last part of a step.
struct Push {
  double t0 = 0.0, t1 = 0.0;  ///< [s]
  Vec3 P0 = Vec3::Zero(), L0 = Vec3::Zero(), P1 = Vec3::Zero(), L1 = Vec3::Zero();
};

/// Near pairs, and what is known of them.
struct NearPairs {
  std::vector<std::pair<int, int>> near;
  std::vector<PairMemory> pairs;
  std::vector<PairWitness> witnesses;
  std::vector<LastingPair> lasting;
};

/// All that a step changes beside the bodies, to begin it once more.
struct StepStart {
  NearPairs known;
  std::vector<IslandMemory> islands;
  std::vector<Push> pushes;
  std::vector<char> chords;
  std::vector<double> left;
  std::vector<FreeSpin> spins;
  Certificate certificate;
  Vec3 externalImpulse = Vec3::Zero();
  std::size_t events = 0;
};

/// A part of a step that was divided for some bodies alone.
struct ClusterPart {
  double t0 = 0.0, t1 = 0.0;  ///< [s]
  std::vector<int> bodies;
  std::vector<RigidBody> start, end;  ///< these bodies, as in Segment
  std::vector<Contact> contacts;      ///< theirs
};

/// What a cluster adds to the books of a step.
struct ClusterBooks {
  Certificate certificate;
  Vec3 externalImpulse = Vec3::Zero();
  std::vector<Event> events;
  std::vector<Contact> contacts;    ///< as in Segment
  std::vector<ClusterPart> pieces;  ///< as in Segment
  int parts = 0;                    ///< of its step
};

/// A cluster at the end of its step.
struct ClusterEnd {
  std::vector<int> bodies;  ///< that move; what follows is theirs, in this order
  std::vector<RigidBody> ends;
  std::vector<Push> pushes;
  std::vector<IslandMemory> islands;
  std::vector<double> left;
  std::vector<FreeSpin> spins;
  std::vector<double> strayed, turned;  ///< as in SteppingWork
  NearPairs known;
  ClusterBooks books;
};

/// Clusters of bodies, while each goes through a step by itself: what is theirs.
struct Clusters {
  std::vector<std::vector<int>> bodies, solids;  ///< as SteppingWork::active and solids
  std::vector<NearPairs> before, after;          ///< and when its step is done
  std::vector<ClusterBooks> books;
  std::vector<ClusterEnd> ends;  ///< of the same step, when it was gone through before
  std::vector<int> endOf;        ///< per body: which of those is its own; < 0: none
  NearPairs strangers;           ///< pairs of two clusters
};

/// What a step works with and then forgets; kept for the sake of its storage.
struct SteppingWork {
  std::vector<Aabb> boxes;    ///< that hold each body of Model::solid throughout the step
  std::vector<int> active;    ///< bodies whose clock runs: all, or a cluster and what carries it
  std::vector<int> solids;    ///< those of them that move freely and can touch, as in Model::solid
  std::vector<int> carriers;  ///< fixed bodies that move
  std::vector<int> cluster;   ///< per body: its cluster; < 0 of a fixed one
  int tiedCluster = -1;       ///< that of tied bodies; −1: there are none
  std::vector<char> dense;    ///< per body: with what is near, it touches at many points
  std::vector<char> crowded;  ///< per body: it is of a crowd
  std::vector<std::size_t> struck;       ///< near pairs that hit each other in a step
  std::vector<std::pair<int, int>> met;  ///< near pairs of clusters that were found to be one
  /// [m] per body: how far its centre strayed from the way that it began, and its surface by
  /// turning otherwise
  std::vector<double> strayed, turned;
  Clusters clusters;
  StepStart start;
  std::vector<std::pair<int, int>> near;
  std::vector<PairMemory> passed;
  Manifold found;
  std::vector<int> crossing;              ///< pairs that may meet at a seam
  std::vector<std::vector<int>> holders;  ///< per body: the pairs that touch and may hold it
  Bonds bonds;                            ///< rows of joints
  std::vector<int> root, order, begin;    ///< of islands: forest of bodies; links by island
  std::vector<int> island;                ///< per link: its island; < 0: it joins nothing now
  std::vector<Island> islands;            ///< at hand: one for each worker
  std::vector<IslandAnswer> answers;      ///< of the islands of this step
  std::vector<char> open;                 ///< per root: an overlap in its island
  std::vector<Vec3> given;                ///< [kg m²/s] per root: spin that lifting gave
  std::vector<char> free;                 ///< per root: no fixed body lifted any of it
  std::vector<int> number, place;         ///< per root: of its island; per island: of its next link
  Problem problem;                        ///< of all bodies at once
  Solution solution;
  std::vector<JointForce> joints;  ///< that bring velocities to what joints allow
  SwingWork swing;
  /// Per body: twists at both ends of the step, and what they would be without contacts.
  std::vector<Vec6> before, star, after;
  std::vector<char> touched;       ///< per body: a contact pushed it in this step
  std::vector<char> held;          ///< per body: it moves, and a contact or joint acts on it
  std::vector<char> joined;        ///< per body: a contact or a joint may act on it in this step
  std::vector<char> flown;         ///< per body: its driven group moves it
  std::vector<DragStep> drags;     ///< per drag
  std::vector<SpringRow> springs;  ///< of this step
  std::string crushed;             ///< words, where no forces can hold what moves on
  double stored = 0.0;             ///< [J] in the springs of stiff groups, at its start
  std::vector<double> later;  ///< per body: the time [s] for which forces act after it has moved
  std::vector<char> smooth;   ///< per body: it moves with the mean of its velocities
  /// [m/s] per body: by how much slower it moves than it is at the end, for that is what forces
  /// give in half the step to the whole that it flies with
  std::vector<Vec3> falls;
  std::vector<LastingPair> lasting;
};

/// For how many steps a part of what bends goes by factors, for sweeps did not come to an end.
struct Unswept {
  int left = 0, next = 1;
};

struct SteppingMemory {
  std::vector<PairMemory> pairs;       ///< as State::near
  std::vector<IslandMemory> islands;   ///< by the first of their bodies
  std::vector<LastingPair> lasting;    ///< of the step before, in order of pairs
  std::vector<double> left;            ///< [m/s] per body: what the last solve left of its contacts
  int division = 0;                    ///< equal parts of the next step; 0: not known yet
  double missed = 0.0;                 ///< [1/s] parts that rows of joints asked for, in the step
  Swing swing;                         ///< the fastest in joints
  std::optional<Drives> drives;        ///< once dealt out
  std::vector<int> tied;               ///< bodies that more acts on than contacts, gravity and wind
  std::shared_ptr<Bendings> bendings;  ///< once dealt out
  std::vector<Unswept> unswept;        ///< per part of what bends
  std::vector<char> chords;  ///< per part: its velocities are those of chords, as an implicit step
                             ///< leaves them
  std::vector<FreeSpin> spins;             ///< per body
  std::vector<Push> pushes;                ///< per body
  std::vector<std::vector<Convex>> parts;  ///< per body, once asked for
  SteppingWork work;
  long looks = 0;
};

}  // namespace tumble
