// A stretch of a line, already projected: a quad around it, one pixel wider than the line.
#include "stage.glsl"
layout(location = 0) in vec2 corner;         // x: 0 start, 1 end; y: −1, 1
layout(location = 1) in vec3 start;          // [px], z: depth in [−1, 1]
layout(location = 2) in vec3 end;
layout(location = 3) in vec4 seams;          // unit normals of the seams at start and end
layout(location = 4) in vec4 ink;            // sRGB, w: half width [px]
flat out vec2 from, to;
flat out vec4 seam;
flat out vec4 colour;

void main() {
  from = start.xy;
  to = end.xy;
  seam = seams;
  colour = ink;
  float reach = ink.w + 1.0;
  vec2 along = normalize(to - from);
  vec2 point = mix(from - reach * along, to + reach * along, corner.x) + corner.y * reach * vec2(-along.y, along.x);
  gl_Position = vec4(2.0 * point / image.xy - 1.0, mix(start.z, end.z, corner.x) - 5e-4, 1.0);
}
