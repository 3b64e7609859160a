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

// Ranks of 8 x 8 pixels by void and cluster (R. Ulichney, "The void-and-cluster method for dither array generation",
// 1993): those below any rank are spread evenly, which leaves neither lines nor clumps.
const int kRanks[64] = int[](
    36, 28, 46, 58, 38, 10, 56, 22,
    60, 12, 24,  6, 34, 26, 50,  8,
    16, 54, 40, 18, 62, 14, 42, 32,
    48,  3, 30, 44,  5, 52,  1, 20,
    39, 11, 57, 23, 37, 29, 47, 59,
    35, 27, 51,  9, 61, 13, 25,  7,
    63, 15, 43, 33, 17, 55, 41, 19,
     4, 53,  0, 21, 49,  2, 31, 45);

// Dithers by half an 8-bit step either way against banding. A step of sRGB is about 2 sqrt(c) / 255 of linear
// light.
vec3 dithered(vec3 color) {
  ivec2 at = ivec2(gl_FragCoord.xy) & 7;
  float threshold = (float(kRanks[8 * at.y + at.x]) + 0.5) / 64.0;
  vec3 stepped = max(2.0 * sqrt(color), vec3(0.0774)) * (1.0 / 255.0);
  return color + finish.z * (threshold - 0.5) * stepped;
}

// Alpha that encodes where an edge crosses: `inside` is the pixel's distance inside the edge, in any unit,
// and `slope` is how that grows from pixel to pixel, to the right and up.
float edgeAlpha(float inside, vec2 slope) {
  vec2 steep = abs(slope);
  bool level = steep.x > steep.y;  // the edge lies to the right or left
  float at = inside / max(max(steep.x, steep.y), 1e-20);
  float along = level ? slope.x : slope.y;
  float direction = (level ? 0.0 : 2.0) + (along > 0.0 ? 1.0 : 0.0);
  return at < 1.0 && finish.y > 0.5 ? (1.0 + kSteps * direction + floor(kSteps * clamp(at, 0.0, 0.999))) / 255.0 : 1.0;
}

vec4 finished(vec3 color, float alpha) { return vec4(dithered(toned(color)), alpha); }
