// Paper with two families of grid lines, contact shadow and cast shadow, fading into the page.
#include "stage.glsl"
#include "page.glsl"
uniform sampler2D aboveMap;
uniform vec2 gridShift, fineShift;   // where the middle of the stage lies between grid lines, in lines
uniform vec2 gridStep;               // coarse and fine [m]; 0 draws none
in vec2 place;
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
  if (gridStep.x > 0.0) c = mix(c, kInk, 0.26 * lines(place / gridStep.x + gridShift, 1.15 * scale));
  if (gridStep.y > 0.0) c = mix(c, kInk, 0.10 * lines(place / gridStep.y + fineShift, 0.90 * scale));
  vec3 map = texture(aboveMap, 0.5 + 0.5 * vec2(place.x, -place.y) / extent.y).rgb;
  c *= mix(vec3(1.0), vec3(0.66, 0.69, 0.75), map.b) * mix(vec3(1.0), vec3(0.60, 0.60, 0.63), map.r);
  result = vec4(c * fade, fade);
}
