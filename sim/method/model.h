// Chapter 9, method: the constant half of a world. Nothing here changes while time runs.
#pragma once

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sim/body/force.h"
#include "sim/body/inertia_method.h"
#include "sim/body/pivot.h"
#include "sim/joint/joint.h"
#include "sim/method/workers.h"
#include "sim/shape/shape.h"

namespace tumble {

struct SolverPreset;

/// A body as its author describes it. Mass wins over density; inertia (about the centre of mass,
/// body axes) over the shape's own.
struct BodyDef {
  std::string name;
  Shape shape = Sphere{};
  std::optional<double> density = {};  ///< [kg/m³]
  std::optional<double> mass = {};     ///< [kg]
  std::optional<Vec3> inertia = {};    ///< [kg m²] about the body axes, with
  Vec3 products = Vec3::Zero();        ///< [kg m²] the entries Iyz, Izx, Ixy of that tensor
  std::string inertiaBy = "surface";   ///< a row of the table of inertia methods
  int samples = 10'000;                ///< points, if that row takes some
  double restitution = 0.0, friction = 0.0;
  std::string material = {};     ///< for the pairs table; may be empty
  Vec3 position = Vec3::Zero();  ///< [m]
  Quat orientation = Quat::Identity();
  Vec3 velocity = Vec3::Zero();         ///< [m/s]
  Vec3 angularVelocity = Vec3::Zero();  ///< [rad/s] world frame
  bool fixed = false;
  /// Body point [m, body frame, from the centre of mass] that stays where it is at the start.
  std::optional<Vec3> pivot_B = {};
};

/// Mass [kg] of a body: its own, or its density times the volume of its shape; 0 without either.
double bodyMass(const BodyDef& body);

/// The inertia tensor [kg m²] that a body is given, body axes. It has one.
Mat3 givenInertia(const BodyDef& body);
/// That mass with the inertia [kg m²] that the body is given, or that its method finds for its
/// shape.
/// @throws std::invalid_argument if the mass is not positive or the method cannot tell.
MassProperties massOf(const BodyDef& body);

/// The shape as the body carries it: with the body origin at the centre of mass that its method
/// finds.
/// @throws std::invalid_argument if the method cannot tell.
Shape centredShape(const BodyDef& body);

/// What replaces the mixing rule for two materials.
struct PairDef {
  std::string materialA, materialB;
  std::optional<double> restitution, friction;
};

struct CourseSettings {
  std::string integrator = "rk4";
  int order = 12;            ///< of an integrator of any order
  double tolerance = 1e-10;  ///< of an adaptive integrator, see `Choices`
  std::string attitude = "quaternion";
  double step = 1.0 / 240.0;  ///< [s]
  std::string plan = "backstep";
  int repairSteps = 4;  ///< of the plan "gradual": steps in which an overlap would be gone at the
                        ///< rate of the first
  std::string contact = "constraint";
  double stiffness = 1e4;  ///< [N/m] k of the contact model "penalty", per point of contact
  double damping = 0.0;    ///< [N s/m] c of the same
};

struct SteppingSettings {
  double step = 1.0 / 240.0;  ///< [s]
  std::string solver = "newton";
  double tolerance = 1e-12;  ///< natural-map residual, relative
  int iterations = 4000;     ///< at most, of the solver: more bring little
  /// The same three for islands of many contacts that move; see `isCrowd`.
  std::string crowdSolver = "pgs";
  double crowdTolerance = 1e-3;
  int crowdIterations = 100;
  bool anyCrowd = false;              ///< as SolverPreset
  double crowdOpen = 0.0;             ///< as SolverPreset::open
  bool divides = true;                ///< as SolverPreset
  double bent = 0.0;                  ///< as SolverPreset
  int linearisations = 1;             ///< at most, in one step, of the forces of what bends
  std::string points = "constraint";  ///< of what bends, where they meet a solid: see PointPlan

  /// All but the length of a step as in a row of solverPresets.
  void take(const SolverPreset& preset);
  /// Crowds are solved as everything else is.
  void treatCrowdsAlike();

  bool operator==(const SteppingSettings&) const = default;
};

/// Everything a world is made from.
struct WorldDef {
  Vec3 gravity = {0.0, -9.81, 0.0};  ///< [m/s²]
  std::string method = "auto";
  std::string impact = "auto";
  double duration = 5.0;  ///< [s] the last step ends there
  CourseSettings course;
  SteppingSettings stepping;
  std::vector<BodyDef> bodies;
  std::vector<Force> forces;
  std::vector<JointDef> joints;
  std::vector<PairDef> pairs;
  bool rememberPlanes = true;  ///< false: every pair is searched anew, for the same motion
};

/// A world that cannot be: which part of the definition, and why.
/// `where` is a path into it: "bodies[3].mass", "course.integrator", "bodies[2]".
class Refusal : public std::invalid_argument {
 public:
  Refusal(std::string where, const std::string& what)
      : std::invalid_argument(what), where_(std::move(where)) {}
  const std::string& where() const { return where_; }

 private:
  std::string where_;
};

/// Six digits of a number, for refusals and reasons; the same in every locale.
std::string shortNumber(double value);

/// The most steps that a run may ask for: a day or so.
inline constexpr double kMostSteps = 1e11;

/// @throws Refusal at that path unless the step [s] leads to the end of the duration [s] in at most
/// kMostSteps steps.
void requireStep(const std::string& path, double step, double duration);

/// Restitution and friction of a pair of bodies.
struct Surface {
  double restitution = 0.0, friction = 0.0;
};

/// The checked definition, ready to run: constant bodies, shapes, surfaces, forces and settings.
struct Model {
  WorldDef def;
  std::vector<Shape> shapes;                  ///< per body, as others meet it
  std::vector<double> radius;                 ///< [m] boundingRadius of each, found once
  std::vector<int> solid;                     ///< the bodies that can touch anything, in order
  std::vector<Pivot> pivots;                  ///< of the bodies that have one
  std::vector<Joint> joints;                  ///< as in the definition
  std::vector<std::pair<int, int>> partners;  ///< bodies that a joint keeps from touching, sorted
  std::vector<int> bending;  ///< per body: which `Bending` of the forces it is a point of, or −1;
                             ///< empty where nothing bends
  std::vector<char> solidBends;  ///< per row of `solid` whether it is such a point; or empty
  std::string_view runs;         ///< def.method, or what "auto" chose
  /// [m] of the world, for tolerances: the largest bounding radius of what moves or, where that is
  /// more, a hundredth of how far anything reaches from the origin at the start.
  double size = 1.0;
  Workers workers;  ///< lent by who runs the world

  int count() const { return static_cast<int>(shapes.size()); }
  bool fixed(int body) const { return def.bodies[body].fixed; }
  bool bends(int body) const { return !bending.empty() && bending[body] >= 0; }
  /// Whether two bodies may touch: one of them moves, no joint keeps them from it, and they are not
  /// both points of something that bends.
  bool mayTouch(int a, int b) const;
  /// e = max(e1, e2), but 0 of a point of what bends, mu = √(mu1 mu2), unless a row of the pairs
  /// table says otherwise.
  Surface surface(int a, int b) const;
};

}  // namespace tumble
