#version 330 core
// Where a surface ends, it fades into the background.

#include "frame.glsl"
#include "background.glsl"

in vec4 untilEnds;

vec3 faded(vec3 color) {
  vec2 untilEnd = min(untilEnds.xy, untilEnds.zw);
  float left = min(untilEnd.x, untilEnd.y);
  if (left < 1.0) color = mix(background(gl_FragCoord.y * occlusion.w), color, smoothstep(0.0, 1.0, left));
  return color;
}
