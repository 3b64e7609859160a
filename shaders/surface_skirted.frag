#version 330 core
// Paint with a skirting board, averaged over the pixel, which prevents shimmer at any distance.

#include "frame.glsl"

in vec2 onSurface;
flat in vec4 edges;

const float kSkirting = 0.22;  // height of the skirting board
const float kLip = 0.02;       // of the line along its edge

vec3 patterned(vec3 base) {
  float width = max(fwidth(onSurface.y), 1e-5);
  float board = clamp((kSkirting - onSurface.y) / width + 0.5, 0.0, 1.0) * edges.z;
  float lip = clamp(0.5 * kLip + 0.5 * width - abs(onSurface.y - kSkirting), 0.0, width) / width * edges.z;
  return base * mix(mix(1.0, 0.62, board), 0.4, lip);
}

float roughnessHere() { return surfaceLook.y; }
