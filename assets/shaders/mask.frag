// What a body is, and how far it is: its colour as it stands, and the distance along the sight [m].
#include "stage.glsl"
in vec3 worldPoint;
flat in vec3 half_B, centre, colour;
layout(location = 0) out vec4 identity;
layout(location = 1) out float depth;

void main() {
  vec3 point = worldPoint;
#ifdef BALL
  // Where the sight line first meets the sphere, as in body.frag.
  vec3 sight = normalize(worldPoint - eye.xyz), p = worldPoint - centre;
  float along = dot(p, sight);
  point -= (along + sqrt(max(0.0, along * along - dot(p, p) + half_B.x * half_B.x))) * sight;
#endif
  vec4 place = viewProjection * vec4(point, 1.0);
  gl_FragDepth = 0.5 + 0.5 * place.z / place.w;
  identity = vec4(colour, 1.0);
  depth = dot(point - eye.xyz, forward.xyz);
}
