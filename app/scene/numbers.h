// Numbers that a scene's text gives, by their keys.
#pragma once

#include <map>
#include <string>

#include "app/scene/node.h"

namespace tumble {

/// Every number of the tree by the key that --set would take: "materials.wood.friction",
/// "body.brick.mass", with '_' for '-'; the k-th of a list, from 0, by "world.gravity.1".
std::map<std::string, double> numbersOf(const Node& tree);

}  // namespace tumble
