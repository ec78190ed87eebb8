// The stage for fragment shaders, handed on by vertex shaders that define GIVES and call give(): what
// is flat, llvmpipe reads once a triangle, but uniforms anew for each lane of each group of pixels.
// WebGL knows no blocks between shaders and reads the uniforms.
#if defined(GIVES) || defined(GL_ES)
#include "stage.glsl"
#endif
#ifdef GL_ES
void give() {}
#else
#define GIVEN flat vec4 eye, forward, light, extent, image; flat mat4 lightProjection;
#ifdef GIVES
out Given { GIVEN } given;
void give() {
  given.eye = eye;
  given.forward = forward;
  given.light = light;
  given.extent = extent;
  given.image = image;
  given.lightProjection = lightProjection;
}
#else
in Given { GIVEN };
#endif
#endif
