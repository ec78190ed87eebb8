// Time stepping after Moreau; one class, and so long. Each step solves one contact problem for the
// velocities at its end,
//   M (v⁺ − v) = h F + Jᵀ λ,   u_n ≥ −separation/h,  λ_n ≥ 0, complementary, Coulomb's cone,
// moves the bodies with v⁺, and lifts what still overlaps without touching a velocity. Where no
// contact changes its mode, forces are those of the middle of the step, and bodies move with the
// mean of v and v⁺. Blows are struck where bodies meet, by the scene's law of impact: a step is
// divided there. Bodies that joints alone hold go by RATTLE (Andersen, 1983): half of what forces
// give comes after the move, and then velocities are what the joints allow. Joints close their gaps
// by their forces alone, so that the move keeps angular momentum.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "sim/joint/joint_bonds.h"
#include "sim/joint/joint_rows.h"
#include "sim/method/method.h"
#include "sim/method/stepping/point_plan.h"
#include "sim/problem/problem.h"

namespace tumble {

void checkStepping(const Model& model, std::span<const RigidBody> bodies);
void advanceStepping(const Model& model, State& state, double t_end, Report& report);
void lookStepping(const Model& model, const State& state, double t, std::vector<RigidBody>& bodies,
                  std::vector<Contact>& contacts, std::vector<JointForce>& joints);

class Stepping {
 public:
  Stepping(const Model& model, State& state, Report& report);

  /// One step of the grid, shorter only at the end of the run.
  void step();

 private:
  void stepTo(double t1, double h);
  void stepInHalves(double t1);
  /// Takes the bodies whose clock runs to t1, in as many parts as their hits ask for. @return how
  /// many
  int go(double t1, double h);
  void moveTo(double t1, double h);
  void beginPart(double t1);
  void endPart(double t1);
  /// Whether the step ends here: the run stops, or what is left of the step is to be divided.
  bool halted() const { return report_.stopped || misses_; }
  double lengthTo(double t1) const;
  void beginSegment(double t1);
  void endSegment(double t1);
  void joinStill();
  bool finite() const;
  void stop(const std::string& what);

  // clusters.cpp: bodies that are near each other have a clock of their own, where one of them
  // hits.
  /// Bodies that joints, springs, fields, drag or what bends act on: one cluster, with what is near
  /// them, that takes every step whole or with all others.
  void findTied();
  /// Whether their clock runs.
  bool tiesRun() const { return !parted_ || cluster_ == work_.tiedCluster; }
  /// Those whose bodies go on: all, or none.
  std::span<const Joint> joints() const {
    return tiesRun() ? std::span<const Joint>(model_.joints) : std::span<const Joint>();
  }
  bool isActive(int body) const { return !parted_ || work_.cluster[body] == cluster_; }
  void activateAll();
  /// Tells clusters apart by near pairs. @return whether something hits within h seconds, and not
  /// all bodies, nor any that are tied, are near it
  bool findClusters(double h);
  void dealOut();
  template <class KnownOf>
  void dealPairs(const KnownOf& knownOf);
  /// Takes near pairs in the place of those at hand, which it gives, and books likewise.
  void exchange(NearPairs& own);
  void exchange(ClusterBooks& own);
  void enter(int cluster);
  void leave();
  void gather();
  /// Keeps the ends of all clusters, for those that will be the same when the step begins again.
  void keepEnds();
  /// Takes the cluster to its end, if that is kept. @return whether it is
  bool recall(int cluster);
  void closeBooks();
  void stepClusters(double t1, double h);
  void save();
  void restore();
  void moveCarriers(double h);
  bool areStrangers(int a, int b) const {
    return work_.cluster[a] != work_.cluster[b] && !model_.fixed(a) && !model_.fixed(b);
  }
  void stray(double t1);
  /// Notes the pairs of two clusters that may have met in the step. @return whether there is one
  bool haveMet(double h);

  // touching.cpp: which pairs are near, and where they touch.
  void findTouching(double h);
  void lookAtAll(double h);
  /// @return whether other pairs are near than before.
  bool findNear(double h);
  /// Brings the near pairs up to date with the boxes. @return whether they are others than before
  bool takePairs();
  double marginOf(std::size_t pair, double h) const;
  /// Whether a point of what bends goes past a solid within h seconds: its way stays clear of it,
  /// and leads to where the solid shows another side. Its row, which knows the plane at the start
  /// alone, would push it out of the way of what it never meets.
  /// @param v  [m/s] velocity of the second of the pair against the first
  bool passes(std::size_t pair, const Vec3& v, double h) const;
  /// The same for a speed [m/s] at which surfaces approach.
  double marginFor(double speed, double h) const;
  /// Looks where velocities that contacts gave lead, beyond what was foreseen. @return whether
  /// something is met there that the contact problem must know.
  bool seeFurther(double h);
  /// Widens the boxes of bodies that leave them in h seconds at the velocities `after`, to which
  /// forces still come if they fall. @return whether there was one
  bool growBoxes(double h, bool fall);
  Vec6 twistAhead(int body) const;
  double gapAhead(const ContactPoint& c, std::pair<int, int> pair, double h) const;
  /// The same of an end beside what crosses, at these twists: what turns past the other, and is as
  /// far from it then, does not meet it, though its gap shrinks at first.
  double gapBeside(const ContactPoint& c, std::pair<int, int> pair, const Vec6& va, const Vec6& vb,
                   double h) const;
  double marginAhead(std::size_t pair, double h) const;
  bool meetsUnknown(std::size_t pair, double h);
  bool lookFurther(std::size_t pair, double h);
  /// Brings the contact points of a pair up to date with the poses of its bodies.
  void look(std::size_t pair, double margin);
  /// Gives a pair the points that were found; numbers the look, if it sees other levers.
  void renew(PairMemory& memory, std::pair<int, int> pair);
  Lever leverOf(const ContactPoint& c, std::pair<int, int> pair) const;
  /// What rounding may leave of a place [m].
  double roundingAt(const Vec3& x) const {
    return kPoseRounding * std::max(model_.size, x.lpNorm<Eigen::Infinity>());
  }
  void matchFeatures(PairMemory& memory, std::pair<int, int> pair);

  // seams.cpp: what a third body keeps apart.
  bool closed(const Touch& touch) const;
  void leaveSeams();
  bool passesThrough(int point, int other) const;
  bool keptApart(int pair, int body) const;

  // rebounds.cpp: impacts.
  /// The hits that may divide a step: all, those that rebound for longer than a step, or none.
  enum class Hits { All, Fast, None };
  /// Strikes what is due, and @return how long [s], at most h, the bodies go until the next hit.
  double meet(double h, Hits divide);
  /// Forces and touches of the bodies as they are.
  void findOut(double h);
  /// The first hit [s] after `soon` and before h, else h, of those that rebound faster than `least`
  /// [m/s].
  double untilHit(double soon, double h, double least);
  void findHeld();
  void hold(const Contact& contact);
  /// Holds the bodies of what the contact problem of the next h seconds stops: hits and, in a
  /// crowd, what hardly parts.
  void holdStopped(double h);
  /// Which points of a pair rebound faster than `least` [m/s], and when they are due.
  void foresee(std::size_t pair, double least);
  /// The same of one point; a and b are its bodies as underWay has them.
  void foresee(Touch& touch, const RigidBody& a, const RigidBody& b, double least) const;
  /// Whether a pair without restitution hits harder than what rests. A step's problem would stop it
  /// in two parts, that of the gap and the rest, and they do not add up to one blow where friction
  /// or another contact has a part in it, however short the step is.
  bool landsHard(std::size_t pair) const;
  /// Whether what arrives at so many m/s is struck; `least` [m/s] as for untilHit.
  bool isHit(const Touch& touch, double speed, double least) const;
  /// Whether a touch is a contact that lasts but for a hop, lower than bodies fall in a step, by
  /// the order of steps. A blow on its bodies pushes it too.
  bool hovers(const Touch& touch) const;
  /// The widest gap [m] of those: a face that lands on all its corners at once misses some by it.
  double widestHover() const;
  /// Whether points of a pair without restitution, all of them open, meet within h seconds along
  /// their normals as they are now.
  bool seemsToMeet(std::size_t pair, double h);
  /// Of such a pair, whether it passes by in truth: its points wait then.
  void foreseePassing(std::size_t pair, double h);

  // tumbling.cpp: the hits of bodies that turn too fast for parabolas.
  /// Whether a pair turns so far in h seconds that its points go by no parabolas.
  bool tumbles(std::size_t pair, double h) const;
  /// How fast [rad/s] a pair's contact runs round a rim, as seen in space.
  double runsRound(std::size_t pair) const;
  /// How long [s], at most a step, a part may be for what runs round a rim of a pair that touches.
  double partOnRim(std::size_t pair);
  /// Whether a body flies in closed form.
  bool fliesFree(int body) const;
  /// Finds when the two first touch within h seconds; all points of theirs that are open wait.
  void foreseeMeeting(std::size_t pair, double h);
  /// When two that fly free first touch within h seconds, or h.
  double firstMeeting(std::size_t pair, double h);
  const std::vector<Convex>& partsOf(int body);

  /// The body under its forces and, if it is held, under all that acted on it in the step before.
  RigidBody underWay(int body) const;
  bool anyHit(double within) const;
  /// Applies the law of impact to what touches, and to what is due within that time [s].
  /// @return whether it changed anything
  bool strike(double within);
  /// How often blows may go on from body to body within a step.
  int mostBlows() const;
  /// Of a hit that the contact problem of a whole step of h seconds takes in: it gives back what
  /// restitution asks for from the speed `vrel` [m/s] at which the step begins (Newton's law).
  void rebound(Touch& touch, double vrel, double h, Row& normal) const;
  void bookShift(const Touch& touch);
  /// Says so of a touch that the contact problem pushed by j [N·s], if that stopped, without a
  /// rebound, what another hit sent.
  void tellPassedOn(const Touch& touch, double j);
  /// Whether a touch is left out of the contact problem of a step: it is struck at its end or
  /// later, or a chain is not known to meet it.
  bool flies(const Touch& touch, double h) const {
    const auto [a, b] = std::pair(touch.contact.a, touch.contact.b);
    return (touch.due >= h && !work_.held[a] && !work_.held[b]) || isFree(a) || isFree(b);
  }

  // crowds.cpp: where more contacts meet than reflections are for.
  /// Finds those of the bodies whose clock runs that touch at many points: more than two near each
  /// other, at more points than reflections are for. Where these rebound they are a crowd.
  void findCrowds();
  /// Whether one of a near pair is marked.
  bool isOneOf(const std::vector<char>& marks, std::size_t pair) const {
    return marks[state_.near[pair].first] || marks[state_.near[pair].second];
  }
  /// Whether an island is a crowd.
  bool isCrowd(const Island& island) const;
  /// What the points of a pair, of which there are some, weigh in it.
  static int weightOf(const PairMemory& pair);
  /// Whether their hits divide no step.
  bool strikesAsCrowd() const;
  /// Whether their hits may divide a step: where they are no crowd they may, whatever the preset.
  bool divides() const { return model_.def.stepping.divides || !crowd_; }
  /// Whether they are in such haste that a step is taken whole, without a second look.
  bool isDrafted() const { return crowd_ && isHasty() && !model_.def.stepping.divides; }
  /// Whether the contact problem of a step takes in what hits.
  bool reboundsInStep() const { return isDrafted() && strikesAsCrowd(); }
  /// Whether its problem is that of many contacts; joints may be among them, springs not.
  bool isManyContacts(const Island& island) const;
  /// What may be left of its problem, if it is that of many contacts that move: of what
  /// moves, the part that is planned for crowds. 0 for any other problem.
  /// @param scale [m/s] its velocityScale
  double roughTolerance(const Island& island, double scale) const;
  /// Whether all that is asked of any crowd is to leave a little open.
  bool isHasty() const {
    return model_.def.stepping.anyCrowd && model_.def.stepping.crowdOpen > 0.0;
  }
  /// In haste, takes out of a rough problem the points that part too fast for its forces to bring
  /// them together, and gives them no force; rows move up.
  /// @param scale [m/s] as for roughTolerance
  void setAside(Island& island, double scale, double h);
  bool isAside(const Touch& touch) const { return touch.due < 0.0; }
  void takeBack(const Island& island);
  /// Solves the island's problem to the last digits, or as far as is planned for crowds.
  /// @param bent, crowd  something in it bends; it is a crowd
  SolveReport solveAsPlanned(Island& island, bool bent, bool crowd, double h);
  /// What is asked of an island that is not rough, or must not be.
  double fineTolerance(const Island& island) const;
  SolveReport solveFine(Island& island, double tolerance);
  /// Whether its problem gives back what restitution asks for.
  bool anyRebounds(const Island& island) const;
  /// Of a crowd that moves hardly any more, in a draft: to the last digits if that takes few
  /// iterations; else swept, for some steps.
  SolveReport solveCalm(Island& island, double h);
  /// Mass of the lightest point of what bends in an island, by that of its heaviest solid; at
  /// most 1.
  double lightness(const Island& island) const;
  /// Whether sweeps left a small island far from what was planned for it.
  bool isFarOff(const Island& island, const SolveReport& solved, double tolerance) const;
  /// Whether they left joints open.
  bool isOpened(const Island& island, double tolerance) const;
  SolveReport solveRough(Island& island, double tolerance, double h);
  /// The λ that the contacts had in the step before.
  void startFromBefore(Island& island, double h);
  /// Overlap [m] that stays: the part that is planned of what the solver may leave in a step.
  double mayLeave(double scale, double h) const;
  /// The part of λ that takes most energy, where the whole of it would add some.
  /// @return whether that was so
  bool keepFromGaining(Island& island, double h);
  bool pushLess(Island& island, double fall);
  /// The rebound [m/s] up to which a touch is a contact that lasts: what a solver leaves is none.
  double leastRebound(const Touch& touch, double least) const;

  // grouping.cpp: which bodies are as one.
  void groupLinks(double h);
  /// The forest of islands: each body alone, and two bodies that something joins as one.
  void partBodies();
  void joinBodies(int a, int b);
  /// Whether two bodies may touch within h seconds, if the two stray so far [m] from the way on
  /// which they are: no plane across a gap between them keeps them apart at both ends of it.
  bool mayMeet(std::size_t pair, double h, double strays = 0.0);
  /// The forest in which bodies that are near each other are as one.
  void joinNear(double h);

  // island.cpp: the contact problem of each island.
  /// Solves until nothing comes to meet what was not looked at.
  void solveSteadily(double h);
  void solveInTurns(double h);
  void solveIslands(double h);
  /// All islands, by as many workers as there are.
  void solveEach(double h);
  /// What the islands of the step did, once they are solved for good.
  void bookIslands(double h);
  std::span<const Link> linksOf(std::size_t island) const {
    const int first = work_.begin[island];
    return std::span(work_.order).subspan(first, work_.begin[island + 1] - first);
  }
  /// The velocities at the end of the step, were there nothing to touch or hold.
  void foreseeTwists(double h);
  std::pair<int, int> ends(Link link) const;
  bool isBonded(const Island& island) const;
  bool anyYields(const Island& island) const;  ///< whether one of its links is a spring
  bool isPair(Link link) const { return link < static_cast<int>(state_.near.size()); }
  Row& bondOf(Link link) { return work_.bonds.rows[link - state_.near.size()]; }
  /// Takes the storage of an island for another one.
  void startIsland(Island& island, std::span<const Link> links);
  void solveIsland(Island& island, double h);
  void giveMotion(const Island& island);
  void tellRough(Island& island, double h) const;
  void collectBodies(Island& island);
  void swing(Island& island, double h);
  /// Of an island that nothing holds, under gravity alone: it falls on a parabola.
  void fallAsOne(Island& island, double h);
  bool ofSame(const Island& island) const;
  bool hasSameForm(const Island& island) const;
  bool looksTheSame(const Island& island, double h) const;
  bool keeps(const Island& island, double h) const;
  /// Of what is seen further in a step: whether it asks an island nothing.
  bool isAnswered(const Island& island, double h) const;
  void answerAgain(Island& island, double h);
  bool goesOn(const Island& island, double h) const;
  /// Whether a body is not at rest as the step begins; whether one of an island is.
  bool moves(int body) const;
  bool anyMoves(const Island& island) const;
  bool rests(const Island& island, double h) const;
  bool pushesAlike(Island& island, double h);
  bool balances(const Island& island);
  /// How a pair of bodies is apart.
  struct Room {
    bool allClosed = false;  ///< all its points touch
    double least = 0.0;      ///< [m] its least gap, where that one touches; else 0
  };
  double missedBy(const Touch& touch, const Room& room, double h) const;
  void stand(Island& island, bool crowd, double h) const;
  void stretch(Island& island, double h);
  bool areClosed(std::span<const Touch> touches) const;
  Room roomOf(std::span<const Touch> touches) const;
  double gapRate(const Touch& touch, const Room& room, double h) const;
  /// What a step adds to the relative velocity of two bodies that turn together: each goes along
  /// its chord, not along its tangent.
  Vec3 carried(const Contact& contact, double h) const;
  bool atStart() const { return partStart_ == 0.0; }
  void share(Island& island, double h);
  void remember(Island& island);
  void shareTouch(Island& island, Touch& touch, const Cone& cone, double h);
  void bookTouch(Touch& touch, const Vec3& ofA, const Vec3& ofB, IslandBooks& books) const;
  Vec3 speedAt(const Contact& contact, int body, std::span<const Vec6> twists) const;
  /// Of body a against b.
  Vec3 rateAt(const Contact& contact, std::span<const Vec6> twists) const {
    return speedAt(contact, contact.a, twists) - speedAt(contact, contact.b, twists);
  }
  bool slides(const Touch& touch) const;
  /// Whether a fixed body that moves takes part.
  bool isLed(const Island& island) const;
  /// Words on what is crushed in an island, if no velocities obey its contacts.
  void findCrushed(Island& island, const SolveReport& solved);

  // built.cpp
  int localOf(Island& island, int body);
  void build(Island& island, double h);
  Row& addRow(Island& island, const Row& row);
  void addPair(Island& island, std::vector<Touch>& touches, double h);
  void level(Island& island) const;
  void addTouch(Island& island, const Stance& at, const Room& room, double h);

  // smooth.cpp: what slides or rolls on.
  bool foreseesSmooth(Island& island, double h);
  bool isSmooth(const Island& island, double h) const;
  void gripAnew(Island& island, double h);
  double leftOver(const Touch& touch, double h) const;
  double closing(std::span<const Touch> touches, double h) const;
  Vec3 rateAtEnd(const Stance& at) const;
  double wanders(const Stance& at) const;
  Vec3 rateIn(const Stance& at, std::span<const Vec6> twists) const;
  bool leads(const Contact& contact, double h) const;
  bool goesRound(const Touch& touch, double h) const;
  bool keepsMode(const Touch& touch, const Vec3& first, const Vec3& last) const;
  void bookLanding(Island& island, double h) const;
  void bookWays(Island& island, double h) const;
  Stance inMiddle(Touch& touch, double h) const;

  // joined.cpp
  void bookJoints(double h);
  /// Whether one of two bodies is a point of what bends; the second may be the world.
  bool isBent(int a, int b) const;
  double halfGivenToBent() const;
  /// What the rows of joints as they stand take from the world and from fixed bodies.
  void bookOuter();
  void moveAhead(Island& island, int body, double h);
  /// How far the gaps of joints after the step differ from what their rows foretold.
  struct Missed {
    double way = 0.0, part = 0.0;  ///< the most: [m], and of the joint's arm
  };
  double missedStretch(Island& island, const SpringRow& spring, const Row& row, double h);
  /// Tells where the answer of an island leads, and the rows of joints what they missed there.
  Missed foretellGaps(Island& island, double h);
  /// Solves the island once more until the forces of joints alone close their gaps.
  /// @return false if it has no answer, or rows miss too much
  bool closeGaps(Island& island, bool crowd, double h, SolveReport& solved);
  /// Takes from the velocities what the joints do not allow where they now are.
  void meetJoints(double h);
  /// How many parts the next step needs for what swings fast in joints: under what they carried in
  /// the last one; or, before there is one, by themselves, without what touches.
  void divideNext(double h);
  void divideFirst(double h);
  void divide(double h, std::span<const JointForce> forces);

  // stepping.cpp: the bodies.
  void applyTwists(double h);
  void moveBodies(double h);
  /// Turns a body for h seconds with the angular momentum L [kg m²/s].
  void turn(RigidBody& body, const Vec3& L, double h) const;

  // flight.cpp: what nothing touches.
  /// Free flight of one body through a step.
  void coast(int body, double h);
  /// Turns a body that nothing twists for h seconds.
  void spin(int body, double h);
  void flyGroups(double h);

  // driven.cpp: springs and drag.
  bool isDriven(int body) const {
    return memory_.drives->groupOf[body] >= 0 || memory_.drives->dragOf[body] >= 0;
  }
  /// Whether winds and point forces alone drive a body, one of these off its centre: it has a group
  /// of its own.
  bool isGripped(int body) const {
    const int group = memory_.drives->groupOf[body];
    return group >= 0 && memory_.drives->groups[group].steady;
  }
  /// Decides which driven groups are free in this step; the springs of others leave the forces.
  void bindGroups(double h);
  void findHolds(double h);
  void freeChains(double h);
  /// Whether a fast spring was solved with contacts in too long a step: what a blow does hangs on
  /// where in a swing it comes.
  bool swingsIntoBlow(double h) const;
  void touchChain(int body);
  /// Whether joints and springs alone are known to act on a body.
  bool isFree(int body) const {
    const int chain = memory_.drives->chainOf[body];
    return chain >= 0 && memory_.drives->chains[chain].free;
  }
  /// Whether forces on a body act in halves.
  bool isHalved(int body) const {
    const int group = memory_.drives->groupOf[body];
    return group >= 0 && memory_.drives->groups[group].halved;
  }
  /// The second half of what forces on them give, where they now are.
  void pushAgain(double h);
  /// What forces without a potential did in both halves.
  void bookHalves(double h);
  /// Rows of the springs of bound groups.
  void addSprings(double h);
  void addSpring(const Spring& spring, bool stiff, double h);
  /// Where the ends of a spring and the centres of its bodies are [m].
  struct SpringEnds {
    Vec3 pa, pb, xa = Vec3::Zero(), xb = Vec3::Zero();
  };
  /// After so many seconds, as the bodies go on.
  SpringEnds endsOf(const Spring& spring, double ahead) const;
  double bend(const Spring& spring, const SpringEnds& at) const;
  Row springRow(const Spring& spring, const SpringEnds& at, const Vec3& d) const;
  /// Gives a row the law of its spring. @return whether that yields to anything
  bool setSpringRow(SpringRow& spring, const SpringLaw& law, double h, Row& row) const;
  /// Whether soft springs drive a body, and no field or point of grip.
  bool isSprung(int body) const;
  /// Whether fields, or springs that are not soft, drive a body.
  bool isMovedByGroup(int body) const {
    return memory_.drives->groupOf[body] >= 0 && !isGripped(body) && !isSprung(body);
  }
  /// Whether such springs alone join the bodies of an island, beside contacts.
  bool isSprung(const Island& island) const;
  /// The spring of a link; null if it is a row of a joint.
  SpringRow* springOf(Link link) const {
    const int bond = link - static_cast<int>(state_.near.size());
    const int first = work_.springs.empty() ? bond + 1 : work_.springs.front().bond;
    return bond < first ? nullptr : &work_.springs[bond - first];
  }
  void springAnew(Island& island, double h);
  void applyDragged(int body, double h);
  /// Mass [kg] that an impulse meets in a step: more than the body's where drag brakes it on the
  /// way.
  double massOnWay(int body) const {
    const int drag = isHalved(body) ? -1 : memory_.drives->dragOf[body];
    const double M = state_.bodies[body].M;
    return drag < 0 ? M : M / work_.drags[drag].way.mean;
  }
  double steadyPower() const;
  /// What springs and dampers take that the step treats as rows.
  void bookSprings(double h);
  double storedInStiff() const;

  // bent.cpp: what bends.
  bool bends() const { return !model_.bending.empty() && tiesRun(); }
  /// @return false, with words in work_.crushed, if nothing can be made of it.
  bool bend(double h);
  void begin(BendingPart& part, double h);
  void factorBent(BendingPart& part, std::string& crushed) const;
  /// @param all  not those that gain alone
  bool bendFurther(double h, bool all);
  bool turnOn(BendingPart& part, double h);
  struct BentBooks {
    double taken = 0.0;  ///< [J] by the implicit step
    /// [J] by its impulses on the way, beyond what energies lose; asked of what joints hold.
    double given = std::numeric_limits<double>::infinity();
    double led = 0.0;              ///< [J] work of points that are led along
    double size = 0.0;             ///< [J] of the energies that make it up
    double movedOut = 0.0;         ///< [J] that the way out of solids gives
    double turned = 0.0;           ///< [J] that it gets back where it turns as a whole
    Vec3 external = Vec3::Zero();  ///< [N·s] on the points that move, by those
    bool astray = false;           ///< linear forces twist what flies

    /// Whether linear forces gave energy, as those of what buckles or turns far in a step can:
    /// about the motion that they give they do not, but for what is left of Newton's method.
    bool gained() const;
  };
  double leaned(const BendingPart& part, std::size_t p, const Vec3& impulse, const Vec3& v,
                double h) const;
  BentBooks booksOf(const BendingPart& part, double h) const;
  void reachBent(double h);
  bool gains(double h);
  bool anyByNewton() const;
  bool twists(const BendingPart& part, std::span<const Vec3> v, std::span<const Vec3> pull,
              double h) const;
  bool isToHalve(double h);
  /// Gives `act` every part that has a point in an island, once.
  template <class Act>
  void forBent(const Island& island, const Act& act) {
    for (const int mover : island.movers) {
      if (!model_.bends(mover)) continue;
      BendingPart& part = memory_.bendings->partWith(mover);
      if (part.bodies[part.moving[0]] == mover) act(part);
    }
  }
  bool keepsBent(const Island& island, double h);

  // layered.cpp: cloth that presses on cloth.
  void regroup();
  void findPressed(double h);
  int partOfPair(LayerPair& pair) const;
  void turnPressed(const LayerPair& end, LayerPair& pair) const;
  double gapAtEnd(const BendingPart& part, const LayerPair& pair) const;
  bool flipPressed(BendingPart& part) const;
  bool seePressed();
  bool flips(double h);
  bool mayGuess() const;
  bool endGuess();
  bool pressesFurther(double h, bool gains, int& looks);
  const Vec3& reachedBy(int body) const;
  void reachPressed();

  // whole.cpp: what flies as a whole.
  /// Whether what stands pushes an island or, if that moved by h falls less than its velocities
  /// say, would be met.
  bool isHeld(const Island& island, const Vec3& falls, double h) const;
  bool flyAsOne(Island& island, double h);
  Vec3 spinAmiss(const Island& island, double h) const;
  void keepSpin(Island& island, double h);
  void flyBent(Island& island, double h);
  void lean(BendingPart& part, double h);
  void turnBent(double h);
  Vec3 momentOn(const BendingPart& part, const Vec3& centre, bool& pushed) const;
  void turnWhole(BendingPart& part, double h);

  // found_inside.cpp: points of what bends, by plans that do not foresee contacts.
  bool findsInside(std::size_t pair) const {
    return !points_.foresees &&
           (model_.bends(state_.near[pair].first) || model_.bends(state_.near[pair].second));
  }
  /// Leaves those found points out that do not touch, but for those that were pushed when last met.
  void leaveUnmet(const PairMemory& memory);
  void findWaysOut(double h);
  void moveOut(double h);
  void takeOut();
  void bookInside();

  // swept.cpp: what bends, by sweeps in place of factors.
  bool canSweep(const Island& island);
  SolveReport sweepBent(Island& island, double h);
  SolveReport sweepBodies(Island& island, double h);
  void startFlown(BendingPart& part, double h) const;
  void moveAlone(double h);
  void factorSwept(Island& island);
  void leaveSweeps(Island& island);
  /// The velocities at the end of the step without contacts.
  void foreseeBent();
  /// Points of what bends go where the step takes them, not along a flight.
  void markBent();
  /// Whether a body of the island is a point of what bends.
  bool anyBends(const Island& island) const;
  void collectBent(Island& island);
  /// Joins the points of each part that bends.
  void joinBent();
  void coupleBent(Island& island);
  void bookBent();
  double potentialNow() const;

  // project.cpp
  /// @return whether all that overlapped or gaped is closed
  bool project();
  double deepestOverlap();
  double deepestKnown() const;
  /// Overlap [m] that is left alone: rounding, or as much as the plan for crowds leaves.
  double mayOverlap() const { return std::max(tolerance_.drift, leftOpen_); }
  double largestGap() const { return largestJointGap(state_.bodies, joints()); }
  void findOverlapping();
  int rootOf(std::size_t pair);
  /// Lifts what overlaps, by at most so many iterations of the solver, or of that of crowds.
  /// @param furthest [m] the deepest overlap, or the widest gap of a joint if that is wider
  /// @return how many it took
  int lift(double furthest, int most, bool asCrowd);
  double spinOfLifted();  ///< [kg m²/s] sum over islands

  // events.cpp
  void recordEvents(double t);
  void recordImpact(double t, const PairMemory& pair, double landing);
  void recordLasting(const std::vector<LastingPair>& before, double t);
  bool arrives(const Touch& touch) const;
  bool isArriving(const Touch& touch) const;
  /// vrel [m/s] < 0 below which a touch is an impact: more than gravity gives in two steps.
  double landingSpeed() const;
  void bookLeftOut(const Touch& touch);

  const Model& model_;
  State& state_;
  Report& report_;
  SteppingMemory& memory_;
  SteppingWork& work_;  ///< empty of meaning between steps
  ContactTolerance tolerance_;
  double gravity_;  ///< [m/s²] its size
  const Solver& solver_;
  const PointPlan& points_;

  int stillSteps_ = 0;  ///< in a row that end here, in which nothing changes
  bool allKept_ = false;
  bool known_ = false;    ///< the touches are those of the bodies as they are
  bool parted_ = false;   ///< clusters go through the step one by one
  bool divided_ = false;  ///< the bodies whose clock runs have gone a part of the step
  bool struck_ = false;   ///< the part of the step under way begins with a blow
  int cluster_ = 0;       ///< whose clock runs
  bool many_ = false;     ///< of the bodies whose clock runs, some touch at many points
  bool crowd_ = false;    ///< and are a crowd
  bool mixed_ = false;    ///< others are none
  bool rough_ = false;    ///< an island is solved as far as is planned for crowds
  bool again_ = false;    ///< islands are solved once more, with what their bodies met
  bool guesses_ = false;  ///< sweeps end early: other pairs of cloth are to press anyhow
  std::vector<BentBooks> bentBooks_;  ///< of the velocities found last, per part that bends
  double leftOpen_ = 0.0;             ///< [m] overlap that such a plan leaves
  bool misses_ = false;               ///< rows of joints miss too much in the part under way
  double partStart_ = 0.0;            ///< [s] of the part under way
  long step_ = 0;                     ///< counts solveSteadily
};

}  // namespace tumble
