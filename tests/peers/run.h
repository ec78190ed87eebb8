// Every engine, setting and step on a scene: errors first, then costs by turns.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/peers/engine.h"
#include "tests/peers/measure.h"

namespace tumble::peers {

/// One engine, setting and step on one scene.
struct Point {
  std::string scene, engine, setting;
  bool asItComes = false;
  bool recorded = false;      ///< on another machine, not measured here
  double rate = 0.0;          ///< [1/s] steps a second, or how often it was asked
  double error = 0.0;         ///< as the trial has it; infinite for a run that was lost
  std::vector<double> costs;  ///< [CPU s per simulated s] of each repeat
};

/// What could not be run, and why.
struct Gap {
  std::string scene, engine, setting, why;
};

/// How much is measured.
struct Plan {
  int repeats = 5;
  double most = 30.0;  ///< [s] of CPU time for one run; slower ones are lost, finer ones not begun
  double patience = 4.0;  ///< [s] that all repeats of a point may take: then there are three, or of
                          ///< longer runs one
};

/// All points of a trial that end, and what did not. Errors come from a run in a process of its
/// own, which may fail; costs from runs that do nothing but step, all points by turns.
std::vector<Point> runTrial(const Trial& trial, const Scene& scene,
                            const std::vector<EngineSetup>& setups, const Plan& plan,
                            std::vector<Gap>& gaps, const std::function<void(double)>& progress);

}  // namespace tumble::peers
