#version 330 core

#include "frame.glsl"

in float height;
out vec4 result;

void main() { result = vec4(mix(backgroundBottom.rgb, backgroundTop.rgb, smoothstep(0.0, 1.0, height)), 1.0); }
