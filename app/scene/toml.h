// TOML text to nodes. The only place that knows the TOML library.
#pragma once

#include <optional>
#include <stdexcept>
#include <string_view>

#include "app/scene/node.h"

namespace tumble {

/// Text that is not TOML.
struct TomlError : std::runtime_error {
  TomlError(Spot where, const std::string& what) : std::runtime_error(what), spot(where) {}
  Spot spot;
};

/// The table that a TOML document is. All spots get source 0.
/// @throws TomlError at its first mistake, or if keys nest deeper than any scene does.
Node parseToml(std::string_view text);

/// A single TOML value, such as `[0, -9.81, 0]`, all of it at one spot; nothing if the text is not
/// one.
std::optional<Node> parseTomlValue(std::string_view text, Spot spot);

}  // namespace tumble
