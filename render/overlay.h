// What is written onto a finished drawing: rule, dotted curves, marks, labels, ladder, colour bar,
// titles.
#pragma once

#include "render/camera.h"
#include "render/canvas.h"
#include "render/picture.h"

namespace tumble {

/// @param projection  of world points onto the page of 720 pixels' height
void drawOverlay(const Picture& picture, const Projection& projection, Canvas& canvas);

/// A measured line on the floor in front of the bodies, along the world axis that lies most across
/// the image.
void drawRule(const Picture& picture, const Projection& projection, Canvas& canvas);

/// A colour scale of 220 by 10 pixels at the lower right.
void drawColourBar(const ColourBar& bar, Canvas& canvas);

/// A number as it is written on a scale: no exponent, as few digits as the step needs, a true minus
/// sign.
std::string formatTick(double value, double step);

}  // namespace tumble
