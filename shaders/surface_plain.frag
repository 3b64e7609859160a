#version 330 core
// Paint.

#include "frame.glsl"

vec3 patterned(vec3 base) { return base; }

float roughnessHere() { return surfaceLook.y; }
