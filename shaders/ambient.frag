#version 330 core
// In place of light.frag where no light shines: what comes from all around.

#include "frame.glsl"

vec3 lit(vec3 albedo, float roughness, vec3 normal, vec3 offset) {
  return albedo * mix(ground.rgb, sky.rgb, 0.5 + 0.5 * dot(normal, up.xyz));
}
