// What all engines are asked through: a world made from a scene, its step, its states.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/scene/scene.h"
#include "sim/world.h"

namespace tumble::peers {

/// What an engine has no words for: it is left out of that scene, and the reason is told.
struct CannotExpress : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A world of one engine at one step size.
class Engine {
 public:
  virtual ~Engine() = default;
  /// Lets one step of time pass; the only call that is timed.
  virtual void step() = 0;
  /// Poses and velocities of all bodies, in scene order; world frame, SI. Those of fixed bodies are
  /// the scene's.
  virtual void read(std::vector<BodySample>& bodies) const = 0;
};

/// Which scenes a setup is meant for: what solves stacks better only costs where one body moves,
/// and dense pivoting takes minutes where more than fifty do.
enum class Meant { Always, OneMoves, ManyMove, FewMove };

/// How an engine is set up: as it comes, or as well as we know to.
struct EngineSetup {
  std::string engine, name;
  std::string why = {};    ///< one sentence: what is set, and what for
  bool asItComes = false;  ///< the engine's own default
  Meant meant = Meant::Always;
  bool stepless = false;   ///< its own clock: h is only how often it is asked
  bool askedOnce = false;  ///< and for the clock, it is asked for the end alone
  /// @param h  [s]
  /// @throws CannotExpress
  std::function<std::unique_ptr<Engine>(const Scene& scene, double h)> make = {};
};

/// Whether a setup is meant for a scene.
bool meantFor(const EngineSetup& setup, const WorldDef& world);

/// The scene of a run, held to what every engine here is asked for: balls, boxes and planes, one
/// friction and one restitution.
/// @throws CannotExpress
Surface commonSurface(const WorldDef& world);

std::vector<EngineSetup> tumbleSetups();
std::vector<EngineSetup> bulletSetups();
std::vector<EngineSetup> odeSetups();
std::vector<EngineSetup> mujocoSetups();
std::vector<EngineSetup> dartSetups();
std::vector<EngineSetup> simbodySetups();

/// Those of all engines that this program was built with, tumble's first.
std::vector<EngineSetup> allSetups();

}  // namespace tumble::peers
