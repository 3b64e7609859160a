#version 330 core
// Faces of boxes for their depth, moved inward so far that a coarser picture does not see them beside the
// boxes.

#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 across;
layout(location = 3) in vec3 along;
layout(location = 4) in vec4 place;

uniform float shrink;  // [rad]

void main() {
  float inward = shrink * length(position);
  vec2 aside = min(vec2(inward), place.zw) * sign(place.xy);
  gl_Position = clipFromOffset * vec4(position - inward * normal - aside.x * across - aside.y * along, 1.0);
}
