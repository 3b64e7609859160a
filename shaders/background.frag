#version 330 core

#include "frame.glsl"

void write(vec3 dark, vec3 bright, float alpha);

in float height;

void main() {
  vec3 color = mix(backgroundBottom.rgb, backgroundTop.rgb, smoothstep(0.0, 1.0, height));
  write(color, color, 1.0);
}
