#version 330 core
// Tiles, averaged over the pixel, which prevents shimmer at any distance.

#include "frame.glsl"

in vec2 onSurface;

const float kJoint = 0.02;  // width of the joint between tiles

// Integral from 0 to x of a comb that is 1 within half a joint of every integer.
vec2 combIntegral(vec2 x) {
  vec2 shifted = x + 0.5 * kJoint;
  return floor(shifted) * kJoint + min(fract(shifted), kJoint);
}

// Integral of a wave that is 1 on even tiles and -1 on odd ones.
vec2 waveIntegral(vec2 x) { return 1.0 - abs(2.0 * fract(0.5 * x) - 1.0); }

vec3 patterned(vec3 base) {
  vec2 width = max(fwidth(onSurface), 1e-5);
  vec2 from = onSurface - 0.5 * width;
  vec2 to = onSurface + 0.5 * width;
  vec2 joints = (combIntegral(to) - combIntegral(from)) / width;
  vec2 wave = (waveIntegral(to) - waveIntegral(from)) / width;
  vec3 tile = base * (1.0 + surfaceLook.z * wave.x * wave.y);
  float joint = 1.0 - (1.0 - joints.x) * (1.0 - joints.y);
  return mix(tile, lines.a > 0.5 ? lines.rgb : 0.55 * base, surfaceLook.w * joint);
}

float roughnessHere() { return surfaceLook.x; }
