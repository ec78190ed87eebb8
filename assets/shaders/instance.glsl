// One body, as it comes from the instance buffer.
layout(location = 0) in vec3 corner;         // of the unit mesh
layout(location = 1) in vec3 cornerNormal;
layout(location = 2) in vec4 centreAlpha;
layout(location = 3) in vec4 turn;           // quaternion x, y, z, w: body to world
layout(location = 4) in vec4 halfExtent;     // w: 1 for a body that is there, 0 for a ghost of the past
layout(location = 5) in vec4 albedo;         // sRGB; w: half the shortest edge of the box around it
layout(location = 6) in vec4 albedoBack;     // of the half with z < 0; w: 1 with a band for its spin
layout(location = 7) in float hidden;        // faces of a box that are not drawn: bit 2·axis, the next on the positive side

vec3 rotate(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
