// Bounding boxes, as the broad phase sees them.
#pragma once

#include "app/record/recording.h"
#include "render/picture.h"

namespace tumble {

/// The twelve edges of the axis-aligned box around each moving body.
void addBoundingBoxes(const Scene& scene, const Sample& sample, Picture& picture);

/// The twelve edges of each moving body's box in its own axes, which turns with it – as a rotation,
/// even where the body is drawn as a matrix has sheared it.
void addBodyBoxes(const Scene& scene, const Sample& sample, Picture& picture);

/// The boxes at one level of the trees over the faces of meshes and the parts of compounds, in body
/// axes; leaves above that level too.
void addTreeBoxes(const Scene& scene, const Sample& sample, int level, Picture& picture);

}  // namespace tumble
