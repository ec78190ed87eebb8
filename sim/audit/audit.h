// Chapter 10, audit: holds a run to what its recorded states alone tell. It takes x, q, P and L at
// the ends of every part of a step, nothing that a method derived from them or wrote in its books,
// and shares with the methods only the definitions of shapes, forces and joints.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim/audit/cloth_crossings.h"
#include "sim/audit/joint_gap.h"
#include "sim/audit/loads.h"
#include "sim/audit/nearness.h"
#include "sim/audit/ways.h"
#include "sim/method/report.h"
#include "sim/method/state.h"

namespace tumble {

/// For every part, of each group of bodies that touch, are joined or pull each other:
///   energy      what Δ(T + V) exceeds the work of loads and of fixed bodies by: contacts and
///               joints only take. Summed up for bodies that ever met; its largest rise is told.
///   momentum    ΔP − ∫F dt, and about the centre of mass ΔL − ∫τ dt, of groups that no fixed body
///               and no joint to the world touches
/// and of all bodies overlap and gaps of joints at the end of every part, overlap in its midst too;
/// of cloths, some times in a run, where they pass through each other.
/// ∫ along the ways of `BodyPath` by three Gauss nodes: error h⁴. Work of fixed bodies, while all
/// that touch a group move as one: what they must have pushed, times how they moved.
class Audit {
 public:
  Audit(const Model& model, std::span<const RigidBody> start);

  /// Goes through what a method has recorded since it was last asked.
  void follow(const State& state);

  /// Writes the figures into the certificate; at the end of a run, where the two differ.
  void report(const State& state, Report& report) const;

  /// The next recorded state of all bodies, at t [s]. What lies between may be one part of a step,
  /// or many: then loads along the way are known only if they are the same all the way.
  /// @param pieces  of that part, that only some bodies have; nothing but gravity and winds acts on
  ///   those
  void see(double t, std::span<const RigidBody> bodies, bool many = false,
           std::span<const ClusterPart> pieces = {});

 private:
  /// Bodies that may have pushed each other in a part.
  struct Group {
    int count = 0, fixed = kNoBody;  ///< bodies; one that touches them and does not move freely
    bool held = false;               ///< by a fixed body, a joint to one or to the world
    bool unlike = false;             ///< by several that move unlike,
    bool torn = false;               ///< one of its bodies by two, or one that no forces tell it of
    bool springy = false;            ///< contacts in it are springs
    bool lost = false;               ///< work of loads along the way is unknown,
    bool unseen = false;             ///< and so are their impulses
    bool vague = false;              ///< where a point of mass in it is rubbed is unknown
    double mass = 0.0, gain = 0.0;   ///< [kg], [J] Δ(T + V) − work of loads
    Vec3 P = Vec3::Zero(), L = Vec3::Zero();  ///< [N s], [N m s] not explained by loads
    Vec3 turn = Vec3::Zero();  ///< [N m s] what it had about its centre, if several flew
    Vec3 X0 = Vec3::Zero(), X1 = Vec3::Zero(), P0 = Vec3::Zero(), P1 = Vec3::Zero();
  };
  /// What bodies that ever met have gained.
  struct Family {
    double own = 0.0, low = 0.0;  ///< [J] and the least that it ever was
  };

  // reading.cpp: what methods record.
  void followSteps(const State& state);
  void followFlights(const State& state);
  void bodiesInFlight(const State& state, double t, bool before, std::vector<RigidBody>& out) const;

  void addWays();

  // blows.cpp
  bool isOpen() const;
  bool passBlowsOn(const Nearness::Part& part);

  // impulses.cpp
  double sameWorkOf(int body) const;
  void findSwings();
  void findStops(const LinearDrag& drag);
  void addLoads();
  void addPressed();
  void addBent();
  double unsureOf(const ElasticBody& body, double off) const;
  void addElement(const Element& element, ElementTerms& start, ElementTerms& end);

  // balance.cpp
  void balance();
  void group(const std::vector<Nearness::Pair>& touched);
  void join(int a, int b);
  bool rubs(int point, int body) const;
  void addFoot(int point, int body);
  void addRubs();
  void addRub(const Ways::Part& part, const Vec3& P, const Ways::Part& other);
  void joinBent(const std::vector<int>& points);
  void joinLayers(const Layers& layers);
  void holdLayers();
  void findLayerBearers(const Layers& layers);
  void addLayers();
  void holdBent(const std::vector<int>& points);
  void holdBy(int body, int fixed);
  void addStates();
  void addTurns();
  double workOfFixed(int root) const;
  double workOfSeveral(int root) const;
  bool isLed(const Group& group) const {
    return group.unlike || (group.fixed != kNoBody && !still(group.fixed));
  }
  void settle();
  void book(int root, double given);
  int rootOf(int body);
  int familyOf(int body);
  void meet(int a, int b);

  void findDisagreements(Report& report) const;
  void tellWeakness(Report& report) const;
  bool moves(int body) const { return !bodies_[body].fixed(); }
  void findBearers();
  double potentialOf(int body, std::span<const Recorded> states) const;
  RigidBody fixedAt(int body, double t) const;
  bool still(int body) const {
    return bodies_[body].v.isZero(0.0) && bodies_[body].omega.isZero(0.0);
  }
  void addMotions();
  double turnOf(const ElasticBody& body) const;
  void countCrossings();
  void addKinetic(std::span<const RigidBody> bodies);
  double relative(double open, double has, double wouldHave) const;

  const Model& model_;
  std::vector<RigidBody> bodies_;  ///< what is constant of them, and where fixed ones began
  Nearness nearness_;
  std::vector<int> bears_;  ///< per body: what bends, by its number among the forces, or −1
  std::vector<int> alone_;  ///< numbers of the other forces
  const Layers* layers_ = nullptr;  ///< of the cloths that are kept apart, if there are any,
  std::vector<int> layerBearer_;    ///< and per point of these the body that bears their energy
  Layers::Look layersLook_;
  std::vector<Bond> bonds_;
  ClothCrossings cloths_;
  long crossings_ = 0;        ///< the most at a look
  double clothsNext_ = 0.0;   ///< [s] when they are looked at again
  double t_ = 0.0, h_ = 0.0;  ///< [s] of the last state, and since the one before it
  bool many_ = false;         ///< more than one part since then
  bool struck_ = false;       ///< impulses at the start of a step are a part of it
  bool winds_ = true;         ///< no loads but winds
  bool stored_ = true;        ///< no loads but ones that give back what they take
  bool turns_ = false;        ///< something bends, and a body that it may meet turns steadily
  bool skins_ = false;        ///< points of mass that nothing bends have a skin that is rubbed
  bool quiet_ = false;        ///< if nothing changes from here on, nothing is wrong
  std::vector<Recorded> last_, now_;
  Ways ways_;  ///< of bodies that have parts of their own between the two
  std::vector<double> net_, way_, reach_;  ///< [m] see Nearness
  std::vector<double> carried_, blown_;    ///< [J] by root, and [m] per body; see passBlowsOn
  double soon_ = 0.0;                      ///< [s] until all bodies are looked at again, about
  std::vector<int> root_, family_;         ///< forests of groups, and of families
  std::vector<Group> groups_;              ///< by root
  std::vector<Family> families_;           ///< by root
  std::vector<Vec3> driftP_, driftL_;      ///< per body: its share of what loads do not explain
  std::vector<double> energyLast_, energyNow_;  ///< [J] T + V per body
  std::vector<Vec3> sumP_, sumL_;               ///< of drifts, by root
  std::vector<Vec3> impulse_, moment_;          ///< [N s], [N m s] of loads in this part
  std::vector<char> pushed_;  ///< per body whether anything may have pushed it, or a joint holds it
  std::vector<int> holder_;   ///< per body: what holds it, or kFree
  std::vector<char> joined_;  ///< per body whether a joint holds it
  std::vector<Vec3> bentFirst_, bentMore_;  ///< [N s] of what bends; see addBent
  std::vector<Vec3> inside_;                ///< what of impulse_ it is
  std::vector<std::pair<int, int>> feet_;   ///< points of mass that are rubbed, and by whom
  std::vector<Vec3> rubbed_;                ///< [N m s] per such point: see addRubs
  std::vector<double> work_;                ///< [J] of loads in this part
  Loads loads_;
  std::vector<BodyPath> paths_;
  std::vector<PathPoint> points_;
  std::vector<Vec3> centre_;  ///< [m] of groups, by root
  std::vector<RigidBody> scratch_;

  long seen_ = 0, untold_ = 0, parts_ = 0;
  bool coarse_ = false;     ///< any two bodies may have met between two looks
  bool broken_ = false;     ///< the motion left the range of numbers
  double unsureNow_ = 0.0;  ///< [J] of the work of who turns what bends, as much as may be wrong,
  double unsure_ = 0.0;     ///< [J] and in all parts so far
  double energyStart_ = 0.0, workDone_ = 0.0, gain_ = 0.0;
  double kineticMax_ = 0.0, momentumMax_ = 0.0, spinMax_ = 0.0, driftMaxP_ = 0.0, driftMaxL_ = 0.0;
  double load_ = 0.0, loadPower_ = 0.0, size_ = 0.0, jointGap_ = 0.0;
  double astray_ = 0.0;  ///< [m] farthest that a body was moved beyond what its speed explains

  // Of reading flights.
  std::vector<long> flightsSeen_;
  long looks_ = 0;
  double followed_ = 0.0;  ///< [s] end of the last part
  bool handedOver_ = false;
};

}  // namespace tumble
