// What the fonts cannot write of a scene's words.
#pragma once

#include <string>
#include <vector>

#include "app/scene/scene.h"
#include "render/font.h"

namespace tumble {

/// For each text that pictures show with letters which the fonts lack, a line that says where it is
/// written and which these are.
std::vector<std::string> lackingLetters(const Scene& scene, const Fonts& fonts);

/// Notes these lines, if there are any. @throws NoContext if the fonts cannot be read.
void noteLackingLetters(const Scene& scene);

}  // namespace tumble
