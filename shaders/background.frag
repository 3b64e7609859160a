#version 330 core

#include "frame.glsl"

vec4 finished(vec3 color, float alpha);

in float height;
out vec4 result;

void main() { result = finished(mix(backgroundBottom.rgb, backgroundTop.rgb, smoothstep(0.0, 1.0, height)), 1.0); }
