#version 330 core
// A soft spot on a surface: a rectangle large enough to contain it.

#include "frame.glsl"

layout(location = 0) in vec2 corner;  // in standard deviations
layout(location = 1) in vec3 centre;
layout(location = 2) in vec3 first;
layout(location = 3) in vec3 second;
layout(location = 4) in float strength;

out vec2 at;
flat out float most;

void main() {
  at = corner;
  most = strength;
  gl_Position = clipFromOffset * vec4(centre + corner.x * first + corner.y * second, 1.0);
}
