// What glTF's physics extensions say of the bodies of a scene.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "app/export/drawn.h"
#include "app/scene/scene.h"

namespace tumble {

/// Collects shapes and materials while nodes are written.
class Physics {
 public:
  explicit Physics(const Scene& scene) : scene_(scene) {}

  /// Puts what moves, weighs and touches into the body's node.
  /// @param shown  the node below it whose mesh a hull collides by
  void add(const DrawnBody& drawn, int shown, nlohmann::ordered_json& node);
  /// Puts the tables of shapes and materials into the document.
  void tell(nlohmann::ordered_json& json) const;

 private:
  int number(nlohmann::ordered_json& table, nlohmann::ordered_json row);

  const Scene& scene_;
  nlohmann::ordered_json shapes_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json materials_ = nlohmann::ordered_json::array();
};

}  // namespace tumble
