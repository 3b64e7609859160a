#version 330 core
// Boxes as seen from the light.

#include "frame.glsl"

layout(location = 0) in vec3 corner;
layout(location = 2) in vec3 position;
layout(location = 3) in vec3 axisX;
layout(location = 4) in vec3 axisY;
layout(location = 5) in vec3 axisZ;
layout(location = 6) in vec3 halfExtents;

void main() {
  vec3 offset = position + mat3(axisX, axisY, axisZ) * (halfExtents * corner);
  gl_Position = vec4((shadowFromOffset * vec4(offset, 1.0)).xyz * 2.0 - 1.0, 1.0);
}
