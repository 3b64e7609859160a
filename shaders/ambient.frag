#version 330 core
// Replaces light.frag in a look without a light source: ambient light only.

#include "frame.glsl"

vec3 ambient(vec3 albedo, vec3 normal) {
  return albedo * mix(ground.rgb, sky.rgb, 0.5 + 0.5 * dot(normal, up.xyz));
}

vec3 direct(vec3 albedo, float roughness, vec3 normal, vec3 offset) { return vec3(0.0); }
