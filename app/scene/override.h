// --set key.path=value: changes the text's tree before it gets a meaning.
#pragma once

#include <stdexcept>

#include "app/scene/findings.h"

namespace tumble {

/// A command line that makes no sense.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// "key.path" and the value behind the first '='.
struct Override {
  std::string key, value;
};

/// Whether the text can stand before the '=': parts between dots, none of them empty.
bool isKeyPath(const std::string& text);

/// @throws UsageError if there is no '=' or what stands before it is no key path.
Override splitOverride(const std::string& text);

/// Replaces the value at the key, or makes it. Elements of an array of tables are addressed by
/// their `name` or by number from 0; a name with dots is found too. The value is TOML, or else a
/// string. Complains about an element or material that is not there, at the spot.
void apply(const Override& override, Spot spot, Node& root, Findings& findings);

}  // namespace tumble
