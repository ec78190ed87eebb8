// Bodies that contacts, joints and what bends join in a step: their contact problem, from what
// joins them to its answer. A value, so that islands can be solved side by side: solving one writes
// what belongs to its own bodies and links, and nothing else.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/body/rigid_body.h"
#include "sim/collide/contact_point.h"
#include "sim/joint/joint_rows.h"
#include "sim/problem/problem.h"

namespace tumble {

/// What joins two bodies: a near pair that touches, by its number, or, numbered after them, a row
/// of a joint.
using Link = int;

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
    Vec6 vStar, v;  ///< without contacts and with them
    Vec6 push;      ///< what contacts gave when the island was solved
  };
  struct Seen {
    long look = 0, form = 0;  ///< as of PairMemory; 0 of a row of joints
    double lambda = 0.0;      ///< of such a row
  };
  std::vector<Mover> movers;  ///< in order of their first contact
  std::vector<Seen> seen;     ///< its links
  double length = 0.0;        ///< [s] of the last step
  double solved = 0.0;        ///< [s] of the step that it was solved in
  double scale = 1.0;         ///< [m/s] velocityScale of the problem
  double residual = 0.0;
  std::size_t cones = 0;  ///< how many of its points were held apart
  long step = 0;          ///< Stepping::solveSteadily that solved it
  long sweptTo = 0;       ///< until that solveSteadily it is swept, in a draft
  bool rough = false;     ///< solved as far as is planned for crowds
  bool kept = false;      ///< the last step asked nothing new
  bool smooth = false;    ///< it moved smoothly in the step that solved it
  bool above = false;     ///< the solver left it above the tolerance
  IslandBooks books;
};

/// What solving an island tells the step.
struct IslandAnswer {
  int head = -1;          ///< its first body, whose memory it has; < 0: nothing in it moves
  bool kept = true;       ///< it asks nothing new, and no mode of it changes
  bool rough = false;     ///< it was solved as far as is planned for crowds,
  double leftOpen = 0.0;  ///< [m] which leaves so much overlap
  bool misses = false;    ///< rows of joints miss too much: the step is to be divided
  double parts = 0.0;     ///< [1/s] into which such rows ask for it to be
  std::string crushed;    ///< words, where no forces can hold what moves on
};

struct Touch;

/// Where the rows of a contact point are taken.
struct Stance {
  Touch* touch;
  ContactPoint point;
  Vec3 a, b;            ///< [m] places of its bodies
  double closes = 0.0;  ///< [m/s] how fast it closes what a smooth step left of its gap
};

/// An island at hand. Its storage serves one island after the other.
struct Island {
  std::span<const Link> links;
  IslandMemory* memory = nullptr;
  std::vector<int> movers;  ///< its bodies that move
  bool smooth = false;      ///< no contact of it changes its mode
  /// Whether it is one body on what is fixed, besides: its points are followed through the step.
  bool follows() const { return smooth && movers.size() == 1; }

  Problem problem;
  std::vector<int> local, bodies;  ///< per body of the world: its number in the problem, or < 0;
                                   ///< and back
  std::vector<double> pull;        ///< as SolveSettings::pull
  std::vector<Vec3> side;          ///< [N s] per body of a problem of what bends
  Solution solution, before;       ///< and that of the round before
  Solution alone;                  ///< what joints need without contacts

  std::vector<Stance> stances;       ///< of a pair, point by point
  std::vector<const Stance*> faces;  ///< the nearest of each normal
  std::vector<RigidBody> ahead;      ///< per body in a joint: after the step
  std::vector<JointRow> jointRows;   ///< of one joint there
  std::vector<Vec3> ends, speeds;    ///< per mover of what flies as one: see keepSpin

  IslandAnswer answer;
};

}  // namespace tumble
