// What every shader knows of the picture. Lengths in metres, about a point on the floor, Y up.
layout(std140) uniform Stage {
  mat4 viewProjection;
  mat4 lightProjection;
  vec4 eye;       // w: size of a pixel at depth 1 m
  vec4 forward;   // w: pixels per pixel of a page 720 high
  vec4 light;     // towards the key light; w: its strength
  vec4 extent;    // radius of the scene, half width of the map from above, reach of contact shadow, its full height
  vec4 image;     // width, height; size of a shadow-map texel; 1 on a floor, else 0
};
