#version 330 core
// What is left of the light: multiplied with what is there.

in vec2 at;
flat in float most;
out vec4 result;

const float kRim = 0.0111;  // exp(-9/2): the spot ends where its rectangle does

void main() {
  float dark = max(exp(-0.5 * dot(at, at)) - kRim, 0.0);
  result = vec4(vec3(1.0 - most * dark), 1.0);
}
