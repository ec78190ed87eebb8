// Matte surfaces under one key light and a sky. Working space is gamma 2: in squared, out by root.
uniform sampler2DShadow shadowMap;
uniform sampler2D aboveMap;

const vec3 kKey = vec3(0.92, 0.89, 0.84);
const vec3 kGround = vec3(0.36, 0.345, 0.33), kSky = vec3(0.46, 0.485, 0.52);

vec3 ambient(vec3 n) { return mix(kGround, kSky, 0.5 + 0.5 * n.y); }

// Share of the key light that arrives: 3 by 3 comparisons, weighted by a quadratic spline about the
// point, so that the edge of a shadow moves smoothly from texel to texel.
float lit(vec3 p) {
  vec3 m = (lightProjection * vec4(p, 1.0)).xyz * 0.5 + 0.5;
  float t = image.z;
  vec2 f = m.xy / t - floor(m.xy / t) - 0.5, near = 0.5 * (0.5 - f) * (0.5 - f), far = 0.5 * (0.5 + f) * (0.5 + f);
  vec3 wx = vec3(near.x, 0.75 - f.x * f.x, far.x), wy = vec3(near.y, 0.75 - f.y * f.y, far.y);
  float sum = 0.0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      sum += wx[i] * wy[j] * texture(shadowMap, m + t * vec3(float(i - 1), float(j - 1), 0.0));
  return sum;
}

vec2 aboveCoordinate(vec3 p) { return 0.5 + 0.5 * vec2(p.x, -p.z) / extent.y; }

// How open the sky is: less where the mean height around, from the floor up, stands above this point, and below overhangs.
float openness(vec3 p, vec3 n) {
  float height = texture(aboveMap, aboveCoordinate(p)).g * extent.w;
  return (1.0 - 0.70 * image.w * clamp((height - p.y) * 3.52 / extent.x, 0.0, 1.0)) * mix(1.0, 0.80, max(0.0, -n.y));
}

vec3 develop(vec3 radiance) { return sqrt(radiance / (1.0 + 0.55 * max(radiance - 0.8, 0.0))); }

// s: share of the key light that arrives. The 15 % that wrap around keep grazing faces from showing the texels of the shadow map.
vec3 shadeSolid(vec3 colour, vec3 p, vec3 n, vec3 toEye, float s) {
  float nd = dot(n, light.xyz), ao = openness(p, n);
  float diffuse = 0.85 * max(nd, 0.0) * s + 0.15 * (0.5 + 0.5 * nd) * (0.6 + 0.4 * s);
  float nh = max(dot(n, normalize(light.xyz + toEye)), 0.0);
  float gloss = nh * nh, gloss4 = gloss * gloss, gloss16 = gloss4 * gloss4 * gloss4 * gloss4;
  vec3 key = kKey * light.w;
  return develop(colour * colour * (key * diffuse * (0.55 + 0.45 * ao) + ambient(n) * ao) +
                 0.10 * gloss16 * gloss16 * s * light.w);
}

// Ghosts and glass: no shadow, occlusion or gloss; paler and calmer.
vec3 shadePlain(vec3 colour, vec3 n) {
  float nd = dot(n, light.xyz);
  float diffuse = 0.85 * max(nd, 0.0) + 0.15 * (0.5 + 0.5 * nd);
  return develop(colour * colour * (kKey * light.w * diffuse + ambient(n)));
}
