#version 330 core
// A pixel without direct light.

out vec4 result;

vec4 finished(vec3 color, float alpha);

void write(vec3 dark, vec3 bright, float alpha) { result = finished(dark, alpha); }
