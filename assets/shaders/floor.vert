// The floor: a disc about the middle of the stage.
#define GIVES
#include "given.glsl"
layout(location = 0) in vec3 corner;
uniform vec2 gridShift, fineShift;   // where the middle of the stage lies between grid lines, in lines
uniform vec2 gridStep;               // coarse and fine [m]; 0 draws none
out vec2 place;
flat out vec4 shifts;
flat out vec2 steps;

void main() {
  give();
  shifts = vec4(gridShift, fineShift);
  steps = gridStep;
  place = 2.0 * extent.x * corner.xy;
  gl_Position = viewProjection * vec4(place.x, 0.0, place.y, 1.0);
}
