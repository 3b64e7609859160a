#version 330 core
// Depth, and no shadow yet.

out vec4 result;

void main() { result = vec4(0.0); }
