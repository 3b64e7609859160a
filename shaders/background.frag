#version 330 core

#include "frame.glsl"
#include "background.glsl"

void write(vec3 dark, vec3 bright, float alpha);

in float height;

void main() {
  vec3 color = background(height);
  write(color, color, 1.0);
}
