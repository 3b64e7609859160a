#version 330 core
// The part of ambient light that boxes leave to surfaces, drawn before in fewer pixels than the picture's.

#include "frame.glsl"

uniform sampler2D opennessMap;

vec3 opennessHere() { return textureLod(opennessMap, occlusion.zw * gl_FragCoord.xy, 0.0).rgb; }
