// The page under the drawing, and the layers put together on it.
#pragma once

#include "render/image.h"
#include "render/picture.h"

namespace tumble {

struct Layer;  // of targets.h

/// Colour of the page at a height, s = 0 at the top of the image and 1 at the bottom.
Colour pageColour(double s);

/// Bodies over floor over a page that brightens downwards. Layers are premultiplied:
///   c = c_bodies + (1 − α_bodies) (c_floor + (1 − α_floor) c_page), in 8-bit sRGB, rounded once a
///   layer.
/// An empty layer is left out.
Image composePage(int width, int height, const Layer& floor, const Layer& bodies);

/// Bodies over floor over nothing: colours are multiplied by the alpha that the image then has.
Image composeFigure(int width, int height, const Layer& floor, const Layer& bodies);

/// Divides the colours of an image that has an alpha channel by it; another stays as it is.
void straighten(Image& image);

/// The image at half the size, each pixel the mean of four. Width and height are even.
Image halved(const Image& image);

}  // namespace tumble
