// The floor: a disc about the middle of the stage.
#include "stage.glsl"
layout(location = 0) in vec3 corner;
out vec2 place;

void main() {
  place = 2.0 * extent.x * corner.xy;
  gl_Position = viewProjection * vec4(place.x, 0.0, place.y, 1.0);
}
