#version 330 core
// Cells of a picture that nothing is drawn in: as if something were right before the eye there.

layout(location = 0) in vec2 position;  // in the picture, -1 ... 1

void main() { gl_Position = vec4(position, -1.0, 1.0); }
