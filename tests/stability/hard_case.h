// Hard cases: each a scene under the default settings, one number that an oracle knows, and how far
// off it may be.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/world/scenes.h"

namespace tumble::test {

struct HardCase {
  std::string name, oracle;
  std::string unit;  ///< of measured and allowed; "1" is a share
  double allowed;
  std::function<double()> measure;  ///< the error; NaN if the run stopped
};

/// A chapter of the table, one file each.
std::vector<HardCase> hardStatics(), hardMotions(), hardShapes(), hardForces();

/// A world that `auto` runs to its end, or to t [s].
World ranTo(const WorldDef& def, double t);

/// The number, or NaN for a world that stopped.
double unlessStopped(const World& world, double number);

}  // namespace tumble::test
