// Chapter 11: a World owns Model, State and Report and lets the chosen method advance them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/method/model.h"
#include "sim/method/report.h"
#include "sim/method/stages.h"
#include "sim/method/workers.h"
#include "sim/state_check.h"

namespace tumble {

struct State;

/// Motion of one body at one time. World frame, SI.
struct BodySample {
  Vec3 x = Vec3::Zero();
  Quat q = Quat::Identity();
  Vec3 v = Vec3::Zero();
  Vec3 omega = Vec3::Zero();
  /// With attitude = "matrix": R as it was integrated; q is the rotation nearest to it.
  std::optional<Mat3> R = {};
};

/// One contact point at one time: separation ≤ 1e-9 m, or a force. Force [N] on a, friction
/// included.
struct ContactSample {
  int a = 0, b = 0;
  Vec3 p = Vec3::Zero(), n = Vec3::UnitY();
  double separation = 0.0;
  Vec3 force = Vec3::Zero();
};

/// Everything about one instant.
struct Sample {
  double t = 0.0;
  std::vector<BodySample> bodies;  ///< in scene order, fixed ones too
  std::vector<ContactSample> contacts;
  double kinetic = 0.0, potential = 0.0;  ///< [J]
  std::vector<JointForce> joints = {};    ///< in scene order
};

/// What is wrong with a start, and the start itself, with the contact forces of this instant.
struct StartCheck {
  std::vector<StateFault> faults;  ///< positions, then velocities, then accelerations
  double unheld = 0.0;  ///< [m/s²] most negative n·p″ of resting contacts without contact forces
  int resting = 0;      ///< contact points at rest
  Sample sample;
};

/// A world at one moment, with all that its method remembers: a value that World::save makes and
/// that the same world restores, as often as one likes. Copies share their content.
class SavedWorld {
 public:
  struct Held;

 private:
  friend class World;
  std::shared_ptr<const Held> held_;
};

/// A scene that lives.
class World {
 public:
  /// @throws Refusal for a definition that cannot be simulated.
  explicit World(const WorldDef& def);
  /// The same definition, under settings that may have changed, from an instant of a run of it:
  /// bodies stand and move as the sample has them, while pivots, joints and what bends are those of
  /// the definition's start. Its own time begins at 0. A matrix that was sheared is a rotation
  /// again.
  /// @throws Refusal as above; std::invalid_argument for a sample of other bodies
  World(const WorldDef& def, const Sample& from);
  ~World();

  /// Holds the start of a definition against the three layers of a state; bodies may overlap.
  /// @throws Refusal for anything else that is wrong.
  static StartCheck checkStart(const WorldDef& def);

  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Lets islands of many contacts be solved side by side from now on. The motion stays the same to
  /// the bit.
  void lend(Workers workers);

  /// Lets a clock [s] count from now on what `stepping` and the audit spend their time on.
  void countTime(std::function<double()> clock);
  const StageTimes& times() const;

  /// Lets time run until the state at t [s] is known, or the report says stopped. The method keeps
  /// its own steps: where it is asked to pause never changes the motion. Times must not decrease;
  /// beyond the duration nothing moves.
  /// @throws std::invalid_argument for what is no number, or infinite.
  void advance(double t);

  /// The instant t ≤ the last advance, and no earlier than the one before. At an event: the state
  /// after it.
  Sample sample(double t) const;

  /// The world as it is now; from there, `restore` lets it go on again to the same bits. Costs a
  /// copy of the state and of the events so far.
  SavedWorld save() const;
  /// Back to a moment: times of `advance` and `sample` begin again where they were then.
  /// @throws std::invalid_argument for what another world saved.
  void restore(const SavedWorld& saved);

  /// What the world was made to run: all its places are as the scene has them less `origin`.
  const Model& model() const;
  /// The place [m] that the model counts from; zero but for scenes far from zero.
  const Vec3& origin() const;
  /// The scene's method; of "auto", what it chose: "auto: exact", "auto: exact, then stepping".
  std::string method() const;
  /// The row of the table of methods that is at work: "exact", "stepping" ….
  std::string_view runs() const;
  /// Certificate and events so far; complete once advance(duration) has returned.
  const Report& report() const;
  /// What this scene uses of the machinery, or, for false, leaves out: "friction", "wind" ….
  std::vector<std::string> features(bool used = true) const;

 private:
  struct Parts;
  void openBooks();

  std::unique_ptr<Parts> parts_;
};

/// A row of the table of methods, for lists and refusals.
struct MethodName {
  std::string_view name, summary;
};
std::vector<MethodName> methodNames();

}  // namespace tumble
