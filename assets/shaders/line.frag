// A round-ended stroke. Neighbours share a seam, the bisector at their joint, so that no pixel is
// drawn twice; an end has none (zero).
#include "stage.glsl"
flat in vec2 from, to;
flat in vec4 seam;
flat in vec4 colour;
uniform float opacity;
layout(location = 0) out vec4 result;

void main() {
  vec2 p = gl_FragCoord.xy, along = to - from;
  if (dot(p - from, seam.xy) < 0.0 || (dot(p - to, seam.zw) >= 0.0 && seam.zw != vec2(0.0))) discard;
  float t = clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0);
  float coverage = clamp(max(colour.w, 0.5) + 0.5 - distance(p, from + t * along), 0.0, 1.0) * min(1.0, 2.0 * colour.w);
  result = vec4(colour.rgb, opacity * coverage);
}
