#version 330 core
// The piece of floor or wall that a box keeps ambient light from.

#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 inBody;      // the vertex in the box's frame
layout(location = 2) in vec3 normal;      // of the surface, in the box's frame
layout(location = 3) in vec3 halfExtents;
layout(location = 4) in vec3 back;        // light that comes back from the box
layout(location = 5) in vec3 part;        // [m2] squares of distances from the box, between which its near part
                                          // becomes its far part; what it counts beside copies

out vec3 at;
flat out vec3 bodyNormal;
flat out vec3 extents;
flat out vec3 returned;
flat out vec2 split;
flat out float share;

void main() {
  at = inBody;
  bodyNormal = normal;
  extents = halfExtents;
  returned = back;
  split = part.xy;
  share = part.z;
  gl_Position = clipFromOffset * vec4(position, 1.0);
}
