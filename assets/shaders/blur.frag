// Gaussian of 13 texels along one axis: wide for contact and height, narrow for the cast shadow.
uniform sampler2D map;
uniform vec2 axis;
layout(location = 0) out vec4 result;

void main() {
  ivec2 last = textureSize(map, 0) - 1, here = ivec2(gl_FragCoord.xy);
  vec3 sum = vec3(0.0), total = vec3(0.0);
  for (int i = -6; i <= 6; ++i) {
    float d2 = float(i * i);
    vec3 weight = vec3(vec2(exp(-d2 / (2.0 * 3.2 * 3.2))), exp(-d2 / (2.0 * 0.9 * 0.9)));
    sum += weight * texelFetch(map, clamp(here + i * ivec2(axis), ivec2(0), last), 0).rgb;
    total += weight;
  }
  result = vec4(sum / total, 1.0);
}
