// Pictures for the tests and benchmarks of the renderer: made up, not simulated.
#pragma once

#include "render/picture.h"

namespace tumble::plates {

Picture strobe();               ///< a thrown brick: ghosts, path, dotted curve, marks, colour bar
Picture tower();                ///< ten see-through boxes with force arrows and a ladder of bars
Picture fan();                  ///< eleven balls, 33 ghosts each
Picture pile(int boxes = 200);  ///< solid boxes, balls and cylinders heaped up
Picture sunk();                 ///< a ball, a box and a cylinder that stick through the floor

}  // namespace tumble::plates
