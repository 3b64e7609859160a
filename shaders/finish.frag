#version 330 core
// The last stage of a colour: tone curve, dither, and the nearest edge encoded in alpha.

#include "frame.glsl"

const float kSteps = 63.0;  // of the distance to the next pixel; see edge_blend.h

// Khronos PBR Neutral: colours are unchanged up to the start of the shoulder; brighter ones are compressed
// below 1 and lose saturation.
vec3 toned(vec3 color) {
  float start = finish.x;
  float peak = max(color.r, max(color.g, color.b));
  if (peak <= start) return color;
  float room = 1.0 - start;
  float pressed = 1.0 - room * room / (peak + room - start);
  float faded = 1.0 / (0.15 * (peak - pressed) + 1.0);
  return mix(vec3(pressed), color * (pressed / peak), faded);
}

// Ranks of 8 x 8 pixels, each in the largest void that those below it leave (after R. Ulichney, "The void-and-cluster
// method for dither array generation", 1993), with as many of them in each row and column up to one: neither clumps nor
// lines.
const int kRanks[64] = int[](
     7, 42, 20, 57, 15, 39, 26, 48,
    60, 24, 37,  0, 50, 22, 41, 12,
    16, 53, 10, 44, 31, 62,  2, 35,
    46,  5, 58, 19, 33,  9, 55, 28,
    14, 38, 27, 49,  6, 43, 21, 56,
    51, 23, 40, 13, 61, 25, 36,  1,
    30, 63,  3, 34, 17, 52, 11, 45,
    32,  8, 54, 29, 47,  4, 59, 18);

// Dithers by half an 8-bit step either way against banding. A step of sRGB is about 2 sqrt(c) / 255 of linear
// light.
vec3 dithered(vec3 color) {
  ivec2 at = ivec2(gl_FragCoord.xy) & 7;
  float threshold = (float(kRanks[8 * at.y + at.x]) + 0.5) / 64.0;
  vec3 stepped = max(2.0 * sqrt(color), vec3(0.0774)) * (1.0 / 255.0);
  return color + finish.z * (threshold - 0.5) * stepped;
}

// So far an edge counts as within a pixel: where it passes from one column or row to the next, rounding would leave it
// to neither. See edge_blend.cpp.
const float kReach = 1.01;

// Alpha that encodes where an edge crosses: `inside` is the pixel's distance inside the edge, in any unit in
// which it is linear in the picture, and `slope` is how that grows from pixel to pixel, to the right and up.
float edgeAlpha(float inside, vec2 slope) {
  vec2 steep = abs(slope);
  bool level = steep.x > steep.y;  // the edge lies to the right or left
  float at = inside / max(max(steep.x, steep.y), 1e-20);
  float along = level ? slope.x : slope.y;
  float direction = (level ? 0.0 : 2.0) + (along > 0.0 ? 1.0 : 0.0);
  if (!(at < kReach) || finish.y < 0.5) return 1.0;
  return (1.0 + kSteps * direction + floor(kSteps * clamp(at, 0.0, 0.999))) / 255.0;
}

vec4 finished(vec3 color, float alpha) { return vec4(dithered(toned(color)), alpha); }
