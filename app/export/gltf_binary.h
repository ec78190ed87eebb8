// The binary half of a glTF file, and what tells of it in the other.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/math/vec.h"

namespace tumble {

class GltfBinary {
 public:
  enum class Use { Animation, Vertices };

  /// Values of `width` components each; the number of the accessor.
  /// @param bounded  whether it says its least and its largest, as places and times must (§3.6.2)
  int floats(const std::vector<float>& values, int width, bool bounded, Use use = Use::Animation);
  int places(const std::vector<Eigen::Vector3f>& points);
  int indices(const std::vector<std::uint32_t>& values);

  void tell(nlohmann::ordered_json& json) const;
  const std::string& bytes() const { return bytes_; }

 private:
  int add(const void* data, std::size_t size, std::size_t count, int component, const char* type,
          int target);

  nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array(),
                         views_ = nlohmann::ordered_json::array();
  std::string bytes_;
};

}  // namespace tumble
