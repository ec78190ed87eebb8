// Boxes, cylinders, ellipsoids, balls and facets, seen from the camera, from the light or from above.
#define GIVES
#include "given.glsl"
#include "instance.glsl"

invariant gl_Position;
out vec3 worldPoint;
out vec3 bodyPoint;
out vec2 heights;                 // lowest and highest point of the body above this one
flat out vec3 bodyNormal, half_B, centre, colour, colourBack;
flat out vec4 turnBody;
flat out float alpha, present, banded;
flat out vec2 pass;              // opacity, keepAbove
#ifdef FACETS
layout(location = 8) in vec3 cornerToEdge;
out vec3 smoothNormal, toEdge;
flat out float thickness;
#endif
#if defined(SOLID) && defined(BALL)
flat out vec4 depthRow, weightRow;  // of viewProjection
#endif
uniform float opacity;            // of the whole pass
uniform float keepAbove;          // 1 keeps what is above the floor, −1 what is below, 0 all

// A ball is a disc that faces the onlooker, for the camera the circle where its rays touch the ball.
vec3 ballCorner(vec3 c, float r) {
#if defined(FROM_LIGHT)
  vec3 axis = -light.xyz, middle = c + r * axis;
#elif defined(FROM_ABOVE)
  vec3 axis = vec3(0, -1, 0), middle = c;
#elif defined(CAST)
  vec3 axis = -light.xyz, middle = c;
#else
  vec3 sight = c - eye.xyz;
  float distance = length(sight);
  vec3 axis = sight / distance, middle = c - axis * (r * r / distance);
  r *= sqrt(max(0.0, 1.0 - (r / distance) * (r / distance)));
#endif
  vec3 side = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
  return middle + r * (corner.x * side + corner.y * cross(side, axis));
}

void main() {
  give();
  pass = vec2(opacity, keepAbove);
  centre = centreAlpha.xyz;
  alpha = centreAlpha.w;
  half_B = halfExtent.xyz;
  present = halfExtent.w;
  colour = albedo.rgb;
  colourBack = albedoBack.rgb;
  banded = albedoBack.w;
  turnBody = turn;
  bodyNormal = cornerNormal;
  bodyPoint = corner * half_B;
#ifdef FACETS
  smoothNormal = cornerNormal;
  toEdge = cornerToEdge * half_B.x;
  thickness = albedo.w;
#endif
#ifdef BALL
  worldPoint = ballCorner(centre, half_B.x);
#ifdef SOLID
  mat4 rows = transpose(viewProjection);
  depthRow = rows[2];
  weightRow = rows[3];
#endif
  float rise = half_B.x * sqrt(max(0.0, 1.0 - dot(corner, corner)));
#else
  worldPoint = centre + rotate(turn, bodyPoint);
  float rise = 0.0;
#endif
  heights = worldPoint.y + vec2(-rise, rise);
#ifdef BALL
  gl_ClipDistance[0] = 1.0;         // the fragment knows where the surface is
#else
  gl_ClipDistance[0] = keepAbove * worldPoint.y;
#endif

#if defined(FROM_LIGHT)
  gl_Position = lightProjection * vec4(worldPoint, 1.0);
#elif defined(FROM_ABOVE)
  gl_Position = vec4(worldPoint.x, -worldPoint.z, 0.0, extent.y);
#elif defined(CAST)
  vec3 fallen = worldPoint - light.xyz * (max(worldPoint.y, 0.0) / light.y);
  gl_Position = vec4(fallen.x, -fallen.z, 0.0, extent.y);
#else
  gl_Position = viewProjection * vec4(worldPoint, 1.0);
#ifdef BOX
  int face = int(dot(abs(cornerNormal), vec3(0, 2, 4))) + (cornerNormal.x + cornerNormal.y + cornerNormal.z > 0.0 ? 1 : 0);
  if ((int(hidden) >> face & 1) == 1) gl_Position = vec4(0, 0, 0, 1);
#endif
#endif
}
