// The map from above: red contact, green height, blue cast shadow; the largest value of each stays.
#include "given.glsl"
in vec3 worldPoint;
in vec2 heights;
flat in float alpha, present;
layout(location = 0) out vec4 result;

void main() {
#ifdef CAST
  result = vec4(0.0, 0.0, max(alpha, 0.35) * exp(-max(worldPoint.y, 0.0) / (0.5 * extent.x)), 1.0);
#else
  result = vec4(alpha * exp(-max(heights.x, 0.0) / extent.z), present * heights.y / extent.w, 0.0, 1.0);
#endif
}
