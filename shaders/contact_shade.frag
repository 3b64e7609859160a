#version 330 core
// The fraction of light that remains; it is multiplied with the picture.

in vec2 at;
flat in float most;
out vec4 result;

const float kRim = 0.0111;  // exp(-9/2): the value at the rectangle's edge

void main() {
  float dark = max(exp(-0.5 * dot(at, at)) - kRim, 0.0);
  result = vec4(vec3(1.0 - most * dark), 1.0);
}
