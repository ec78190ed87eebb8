// The tables of a scene that hold single settings: [world] [course] [stepping] [image] [show].
#pragma once

#include "app/scene/section.h"

namespace tumble {

void readTexts(Section& root, Scene& scene);
void readWorld(Section& root, Scene& scene);
void readCourse(Section& root, CourseSettings& course);
/// A run shorter than some default steps has shorter ones, to be seen at all.
void readStepping(Section& root, WorldDef& world);
void readImage(Section& root, ImageFormat& image);
void readShow(Section& root, ShowFlags& show);

/// The colour at a key, sRGB in [0, 1].
void readColour(Section& section, std::string_view key, std::optional<Rgb>& colour);

}  // namespace tumble
