#version 330 core
// A piece of a surface that the shadow of a box lies on. Seen along the light, a box is the part where
// |slab . q| <= half for three slabs, q the offset from its centre: a zonogon. A ray is inside the box where
// it is so for each of its axes. All this is linear in q.

#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 acrossSlabs;
layout(location = 2) in vec3 alongLight;
layout(location = 3) in vec3 slabs;
layout(location = 4) in vec3 depths;
layout(location = 5) in float most;

invariant gl_Position;
out vec3 fromAxis;  // [m] from the middle of each slab, perpendicular to the light
out vec3 passing;   // [m] along the light to where a ray is in the middle of the box, by each axis
flat out vec3 halfSlab;
flat out vec3 halfPassing;
flat out float weight;  // part of the light that is kept off at most

void main() {
  fromAxis = acrossSlabs;
  passing = alongLight;
  halfSlab = slabs;
  halfPassing = depths;
  weight = most;
  gl_Position = clipFromOffset * vec4(position, 1.0);
}
