#version 330 core
// A wall seen from behind: a faint tint, and a line along its outline.

#include "frame.glsl"

in float inside;
in vec4 untilEnds;

out vec4 result;

const float kTint = 0.05;
const float kLine = 0.5;
const float kWidth = 0.0016;  // of the line, in heights of the picture; at least one pixel

void main() {
  float pixels = inside / max(length(vec2(dFdx(inside), dFdy(inside))), 1e-20);
  float width = max(kWidth / occlusion.w, 1.0);
  float line = min(clamp(pixels, 0.0, 1.0), clamp(width + 1.0 - pixels, 0.0, 1.0));
  vec2 untilEnd = min(untilEnds.xy, untilEnds.zw);
  float seen = smoothstep(0.0, 1.0, min(untilEnd.x, untilEnd.y));
  result = vec4(vec3(0.9), seen * mix(kTint, kLine, line));
}
