// What `stepping` remembers from step to step. None of it changes an answer beyond rounding: it
// spares looking twice at what has not changed.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sim/contact/bonds.h"
#include "sim/contact/contact.h"
#include "sim/joint/swing.h"
#include "sim/method/stepping/drives.h"
#include "sim/problem/problem.h"

namespace tumble {

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
  bool rebounds = false;        ///< when it is struck
  double due = 0.0;             ///< [s] until it is struck or, of free bodies, until they meet
  double approach = 0.0;        ///< [m/s] how fast it came
  double arrivalSpeed = 0.0;    ///< [m/s] of a hit that closed its gap in the step before
  double arrivalImpulse = 0.0;  ///< [N·s] that it got so far
};

/// The contact points of a near pair, as found at two poses.
struct PairMemory {
  Pose poseA, poseB;
  double margin = -1.0;  ///< [m] up to which points were looked for; < 0: never looked at
  long look = 0;         ///< number of the look that found them: the same number, the same levers
  long form = 0;         ///< number of the look that found these features first, in a row
  double deepest = 0.0;  ///< [m] largest overlap
  bool bounces = false;  ///< it has restitution
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

/// Sums over the contacts of an island in one step, for the books.
struct IslandBooks {
  double lostImpact = 0.0, lostFriction = 0.0, work = 0.0;  ///< [J]
  Vec3 external = Vec3::Zero();                             ///< [N·s] from fixed bodies
};

/// An island when it was last solved: the question and the answer.
struct IslandMemory {
  struct Mover {
    int body = 0;
    Mat3 Iinv;
    Vec6 vStar, v;
  };
  struct Seen {
    long look = 0, form = 0;  ///< as of PairMemory; 0 of a joint
  };
  std::vector<Mover> movers;  ///< in order of their first contact
  std::vector<Seen> seen;     ///< its pairs
  double length = 0.0;        ///< [s] of the last step
  double solved = 0.0;        ///< [s] of the step that it was solved in
  double scale = 1.0;         ///< [m/s] velocityScale of the problem
  double residual = 0.0;
  IslandBooks books;
};

/// What a step works with and then forgets; kept for the sake of its storage.
struct SteppingWork {
  std::vector<Aabb> boxes;
  std::vector<std::pair<int, int>> near;
  std::vector<PairMemory> passed;
  Manifold found;
  std::vector<int> crossing;              ///< pairs that may meet at a seam
  std::vector<std::vector<int>> holders;  ///< per body: the pairs that touch and may hold it
  Bonds bonds;                            ///< rows of joints
  std::vector<int> root, order, begin;    ///< of islands: forest of bodies; links by island
  std::vector<int> island;                ///< per link: its island; < 0: it joins nothing now
  std::vector<char> open;                 ///< per root: an overlap in its island
  std::vector<double> pull;               ///< of one island: as SolveSettings::pull
  std::vector<int> local, bodies;         ///< of one island: numbers in its problem, and back
  std::vector<int> movers;
  Problem problem;
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
  std::vector<LastingPair> lasting;
};

struct SteppingMemory {
  std::vector<PairMemory> pairs;      ///< as State::near
  std::vector<IslandMemory> islands;  ///< by the first of their bodies
  std::vector<LastingPair> lasting;   ///< of the step before, in order of pairs
  int parts = 1;                      ///< equal ones that the next step is made in
  Swing swing;                        ///< the fastest in joints
  std::optional<Drives> drives;       ///< once dealt out
  std::vector<FreeSpin> spins;        ///< per body
  SteppingWork work;
  long looks = 0;
  long asked = 0;  ///< looks up to which pairs were asked whether they meet at a seam
};

}  // namespace tumble
