// A round arrow, its thickness given in pixels where it starts.
#include "stage.glsl"
layout(location = 0) in vec4 ring;           // x, y on the unit circle; z: radius 0 none, 1 shaft, 2 head; w: where
layout(location = 1) in vec3 slope;          // normal: outward, along
layout(location = 2) in vec4 baseRadius;     // [m]; w: radius of the shaft [px]
layout(location = 3) in vec3 reach;          // from base to tip [m]
layout(location = 4) in vec3 ink;
uniform float halo;                          // [px] by which the arrow is thicker
out vec3 normal;
flat out vec3 colour;

void main() {
  float size = length(reach), pixel = dot(baseRadius.xyz - eye.xyz, forward.xyz) * eye.w * forward.w;
  float shaft = baseRadius.w * pixel;
  float headLength = min(6.6 * shaft, 0.45 * size), head = min(2.5 * shaft, 0.42 * headLength);
  shaft = min(shaft, 0.55 * head);
  // The outline of the half section: base, shaft, step to the head, tip.
  float radius = ring.z == 0.0 ? 0.0 : (ring.z == 1.0 ? shaft : head) + halo * pixel;
  float along = ring.w == 0.0 ? -halo * pixel : ring.w == 1.0 ? size - headLength - halo * pixel : size + 2.0 * halo * pixel;
  vec3 axis = reach / size;
  vec3 side = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
  vec3 outward = ring.x * side + ring.y * cross(axis, side);
  normal = normalize(slope.x * outward + slope.y * axis);
  colour = ink;
  gl_Position = viewProjection * vec4(baseRadius.xyz + along * axis + radius * outward, 1.0);
}
