// Surface of a body: form, edge line, bevel and spin mark, then light by its finish.
#include "given.glsl"
#include "light.glsl"
in vec3 worldPoint;
in vec3 bodyPoint;
flat in vec3 bodyNormal, half_B, centre, colour, colourBack;
flat in vec4 turnBody;
flat in float alpha, banded;
flat in vec2 pass;                // opacity, keepAbove as in body.vert
#ifdef FACETS
in vec3 smoothNormal, toEdge;
flat in float thickness;
#endif
layout(location = 0) out vec4 result;

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }

// Light comes first in each, while there is little to keep over nine looks at a map.
struct Surface {
  float sun;                      // share of the key light that arrives
  vec3 point, normal;             // in the world
  vec3 point_B;                   // in the body
  float edge;                     // 1 on an edge line
};

// Size of a pixel at a point, and the width of an edge line in pixels (never below a visible one).
float pixelSize(vec3 p) { return dot(p - eye.xyz, forward.xyz) * eye.w; }
// What a coordinate of the surface changes by from pixel to pixel; never nothing, in a world of any size.
float perPixel(float x, float pixel) { return max(fwidth(x), 1e-3 * pixel); }
vec3 perPixel(vec3 x, float pixel) { return max(fwidth(x), vec3(1e-3 * pixel)); }
float lineScale() { return max(forward.w, 0.75); }

float edgeLine(float pixels, float smallest, float pixel) {
  float scale = lineScale();
  return (1.0 - smoothstep(0.35 * scale, 1.5 * scale, pixels)) * clamp(smallest / (4.0 * pixel * scale), 0.0, 1.0);
}

Surface boxSurface() {
  float sun = lit(worldPoint);
  vec3 away = 1e3 * abs(bodyNormal);
  vec3 toEdge = half_B - abs(bodyPoint);
  float smallest = min(half_B.x, min(half_B.y, half_B.z)), pixel = pixelSize(worldPoint);
  vec3 pixels = toEdge / perPixel(bodyPoint, pixel) + away;
  vec3 bevel = clamp(1.0 - (toEdge + smallest * away) / max(0.06 * smallest, 0.5 * pixel), 0.0, 1.0);
  vec3 tilted = bodyNormal + 0.9 * bevel * sign(bodyPoint);
  return Surface(sun, worldPoint, rotate(turnBody, normalize(tilted)), bodyPoint,
                 edgeLine(min(pixels.x, min(pixels.y, pixels.z)), smallest, pixel));
}

Surface cylinderSurface() {
  float sun = lit(worldPoint);
  bool cap = abs(bodyNormal.y) > 0.5;
  vec3 outward = vec3(bodyPoint.x, 0.0, bodyPoint.z) / max(length(bodyPoint.xz), 1e-30);
  vec3 upward = vec3(0.0, sign(bodyPoint.y), 0.0);
  float toRim = cap ? half_B.x - length(bodyPoint.xz) : half_B.y - abs(bodyPoint.y);
  float smallest = min(half_B.x, half_B.y), pixel = pixelSize(worldPoint);
  float bevel = clamp(1.0 - toRim / max(0.06 * smallest, 0.5 * pixel), 0.0, 1.0);
  vec3 tilted = cap ? upward + 0.9 * bevel * outward : outward + 0.9 * bevel * upward;
  return Surface(sun, worldPoint, rotate(turnBody, normalize(tilted)), bodyPoint,
                 edgeLine(toRim / perPixel(toRim, pixel), smallest, pixel));
}

#ifdef FACETS
Surface facetSurface() {
  float sun = lit(worldPoint);
  float pixel = pixelSize(worldPoint);
  vec3 pixels = toEdge / perPixel(toEdge, pixel);
  return Surface(sun, worldPoint, rotate(turnBody, normalize(smoothNormal)), bodyPoint,
                 edgeLine(min(pixels.x, min(pixels.y, pixels.z)), thickness, pixel));
}
#endif
// With lines where the planes of the principal axes cut it.
Surface ellipsoidSurface() {
  float sun = lit(worldPoint);
  vec3 normal = normalize(bodyPoint / (half_B * half_B)), pixels = abs(bodyPoint) / perPixel(bodyPoint, pixelSize(worldPoint));
  return Surface(sun, worldPoint, rotate(turnBody, normal), bodyPoint, edgeLine(min(pixels.x, min(pixels.y, pixels.z)), 1.0, 1e-6));
}

// Where the sight line through this fragment first meets the exact sphere.
Surface ballSurface() {
  vec3 sight = normalize(worldPoint - eye.xyz), p = worldPoint - centre;
  float r = half_B.x, along = dot(p, sight);
  float root = sqrt(max(0.0, along * along - dot(p, p) + r * r));
  vec3 normal = normalize(p - (along + root) * sight);
  vec4 back = vec4(-turnBody.xyz, turnBody.w);
  return Surface(lit(centre + r * normal), centre + r * normal, normal, r * rotate(back, normal), 0.0);
}

// The colour of the half of the body that the point lies in.
vec3 sideColour(Surface s) {
  float front = clamp(0.5 + s.point_B.z / perPixel(s.point_B.z, pixelSize(s.point)), 0.0, 1.0);
  return colourBack + front * (colour - colourBack);
}

// A band about an axis of the body, that its spin can be seen; left out on bodies too small for it. That
// of a ball leans to every axis, for a ball that rolls along any of them to show it from every side.
vec3 spinMark(vec3 base, Surface s) {
#if defined(BOX) || defined(FACETS)
  return base;
#else
#ifdef BALL
  float along = dot(s.point_B, vec3(2.0, 2.0, 1.0) / 3.0);
#else
  float along = s.point_B.z;
#endif
  float distance = abs(along) - 0.16 * half_B.x, pixel = pixelSize(s.point);
  float band = clamp(0.5 - distance / pixel, 0.0, 1.0) * clamp((half_B.x / (pixel * lineScale()) - 8.0) / 8.0, 0.0, 1.0);
  return mix(base, 0.45 * base + 0.42, banded * band);
#endif
}

// Share of this fragment on the wanted side of the floor; all but balls are cut before.
float kept(Surface s) {
#ifdef BALL
  return pass.y == 0.0 ? 1.0 : clamp(0.5 + pass.y * s.point.y / perPixel(s.point.y, pixelSize(s.point)), 0.0, 1.0);
#else
  return 1.0;
#endif
}

// Solid balls are as deep as their surface, so that they reach through what stands in their outline.
#if defined(SOLID) && defined(BALL)
flat in vec4 depthRow, weightRow;
void setDepth(vec3 point) {
  gl_FragDepth = 0.5 + 0.5 * dot(depthRow, vec4(point, 1.0)) / dot(weightRow, vec4(point, 1.0));
}
#endif

void main() {
#if defined(BOX)
  Surface s = boxSurface();
#elif defined(ELLIPSOID)
  Surface s = ellipsoidSurface();
#elif defined(BALL)
  Surface s = ballSurface();
#elif defined(FACETS)
  Surface s = facetSurface();
#else
  Surface s = cylinderSurface();
#endif
#if defined(SOLID) && defined(BALL)
  setDepth(s.point);
#endif
  float share = kept(s);
  if (share == 0.0) discard;
  vec3 toEye = normalize(eye.xyz - s.point);
  float facing = abs(dot(s.normal, toEye));
  vec3 base = sideColour(s);
#if defined(GLASS)
  float rim = 1.0 - facing;
  vec3 c = mix(shadePlain(base, s.normal), 0.55 * base, s.edge);
  result = vec4(c, pass.x * mix(0.18 + 0.25 * rim * rim * rim, 0.85, s.edge));
#else
#if defined(GHOST)
  vec3 c = shadePlain(spinMark(base, s), s.normal);
#else
  vec3 c = shadeSolid(spinMark(base, s), s.point, s.normal, toEye, s.sun);
#endif
  c = mix(c, 0.52 * c, 0.75 * s.edge);
#ifdef BALL
  float limb = (1.0 - facing) * (1.0 - facing);
  c *= sqrt(1.0 - 0.38 * limb * limb);
#endif
  result = vec4(c, pass.x * alpha * share);
#endif
}
