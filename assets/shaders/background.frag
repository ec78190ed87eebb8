// The page alone.
#include "stage.glsl"
#include "page.glsl"
layout(location = 0) out vec4 result;

void main() { result = vec4(page(1.0 - gl_FragCoord.y / image.y), 1.0); }
