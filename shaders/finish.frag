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

// Dithers by half an 8-bit step either way against banding: each of four rows rounds at another quarter of a
// step. Neighbouring pixels in a row round alike, so that a PNG is a third of what noise makes it. A step of
// sRGB is about 2 sqrt(c) / 255 of linear light.
vec3 dithered(vec3 color) {
  float row = mod(floor(gl_FragCoord.y), 4.0);
  float threshold = (mod(2.0 * row, 4.0) + floor(0.5 * row) + 0.5) / 4.0;  // 0, 2, 1, 3: neighbours far apart
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
