#version 330 core
// Surfaces for their depth.

#include "frame.glsl"

layout(location = 0) in vec3 position;

invariant gl_Position;

void main() { gl_Position = clipFromOffset * vec4(position, 1.0); }
