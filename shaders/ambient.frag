#version 330 core
// Replaces light.frag in a look without a light source: ambient light only.

#include "frame.glsl"

vec3 lit(vec3 albedo, float roughness, vec3 normal, vec3 offset) {
  return albedo * mix(ground.rgb, sky.rgb, 0.5 + 0.5 * dot(normal, up.xyz));
}
