// What a scene pays for: scenes that differ by one thing, from a ball that flies on, and their
// cost.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/scene/scene.h"

namespace tumble {

/// What one scene costs.
struct Price {
  std::string scene;              ///< title
  std::vector<std::string> uses;  ///< of the machinery
  /// [s] CPU for a simulated second, by each row of the table of methods; nothing where the method
  /// refuses the scene or stops.
  std::vector<std::optional<double>> seconds;
};

/// Runs each scene by every method.
/// @param budget  [s] of CPU time for each cost
std::vector<Price> pricesOf(const std::vector<Scene>& scenes, double budget);

/// scene, method, cpu_seconds_per_second, uses: a row for each scene and method that takes it.
std::string priceCsv(const std::vector<Price>& prices);

/// The table as HTML, in microseconds.
std::string priceTable(const std::vector<Price>& prices);

}  // namespace tumble
