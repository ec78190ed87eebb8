#include "stage.glsl"
in vec3 normal;
flat in vec3 colour;
uniform float halo;
uniform float opacity;
layout(location = 0) out vec4 result;

void main() {
  float lightness = 0.62 + 0.55 * (0.5 + 0.5 * dot(normalize(normal), light.xyz));
  result = vec4(halo > 0.0 ? vec3(0.984, 0.980, 0.969) : sqrt(min(colour * colour * lightness, 1.0)), opacity);
}
