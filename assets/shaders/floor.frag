// Paper with two families of grid lines, contact shadow and cast shadow, fading into the page.
#include "given.glsl"
#include "page.glsl"
uniform sampler2D aboveMap;
in vec2 place;
flat in vec4 shifts;                 // where the middle of the stage lies between grid lines, in lines
flat in vec2 steps;                  // coarse and fine [m]; 0 draws none
layout(location = 0) out vec4 result;

const vec3 kTint = vec3(0.9569, 0.9529, 0.9412) / vec3(0.9804, 0.9804, 0.9725);
const vec3 kInk = vec3(0.431, 0.478, 0.533);

// Coverage by lines of a family, `width` pixels wide; a family fades before it is too dense to show.
float lines(vec2 q, float width) {
  vec2 t = abs(fract(q - 0.5) - 0.5), d = max(fwidth(q), 1e-6);
  vec2 coverage = clamp(0.5 * max(width, 1.0) + 0.5 - t / d, 0.0, 1.0) * clamp(1.6 - 3.2 * d, 0.0, 1.0);
  return max(coverage.x, coverage.y) * min(width, 1.0);
}

void main() {
  float fade = 1.0 - smoothstep(0.75 * extent.x, 1.96 * extent.x, length(place));
  vec3 c = page(1.0 - gl_FragCoord.y / image.y) * kTint;
  float scale = max(forward.w, 0.75);
  if (steps.x > 0.0) c = mix(c, kInk, 0.26 * lines(place / steps.x + shifts.xy, 1.15 * scale));
  if (steps.y > 0.0) c = mix(c, kInk, 0.10 * lines(place / steps.y + shifts.zw, 0.90 * scale));
  vec3 map = texture(aboveMap, 0.5 + 0.5 * vec2(place.x, -place.y) / extent.y).rgb;
  c *= mix(vec3(1.0), vec3(0.66, 0.69, 0.75), map.b) * mix(vec3(1.0), vec3(0.60, 0.60, 0.63), map.r);
  result = vec4(c * fade, fade);
}
