// The page behind everything; s = 0 at the top, 1 at the bottom.
vec3 page(float s) { return mix(vec3(235.0, 239.0, 244.0), vec3(250.0, 249.0, 246.0), s) / 255.0; }
