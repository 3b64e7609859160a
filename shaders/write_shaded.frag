#version 330 core
// A pixel in full light and in full shadow; blending takes them by the part of the light that the picture
// says is covered there.

layout(location = 0, index = 0) out vec4 result;
layout(location = 0, index = 1) out vec4 shaded;

vec4 finished(vec3 color, float alpha);

void write(vec3 dark, vec3 bright, float alpha) {
  result = finished(bright, alpha);
  shaded = finished(dark, alpha);
}
