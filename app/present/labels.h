// Names and values beside bodies.
#pragma once

#include <string>

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// The label of a body: its own text, in which {name}, {restitution}, {friction}, {density} and
/// {mass} stand for its values; without one, the body's name if show.labels is set and the body
/// moves.
std::string labelOf(const Scene& scene, int body);

/// Labels to the right of the bodies.
void addLabels(const Scene& scene, const Sample& sample, Picture& picture);

/// The texts of the scene that are seen at the sample's instant.
void addTexts(const Scene& scene, const Sample& sample, Picture& picture);

}  // namespace tumble
