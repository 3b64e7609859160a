#version 330 core
// Light reflected to the eye from a point of a surface, for every shader that draws one.

#include "frame.glsl"

// Cook and Torrance's specular term with the GGX distribution of Walter et al. (2007) and Smith visibility in
// Karis's approximation. Fresnel by Schlick, 0.04 at normal incidence: paint, stone.
float glossy(float roughness, vec3 normal, vec3 toEye, float facing) {
  vec3 between = normalize(toEye + towardsLight.xyz);
  float a2 = roughness * roughness * roughness * roughness;
  float nh = max(dot(normal, between), 0.0);
  float nv = max(dot(normal, toEye), 1e-4);
  float spread = nh * nh * (a2 - 1.0) + 1.0;
  float k = 0.5 * roughness * roughness;
  float visible = 0.25 / ((nv * (1.0 - k) + k) * (facing * (1.0 - k) + k));
  float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(toEye, between), 0.0), 5.0);
  return a2 / (spread * spread) * visible * fresnel;  // times pi, because lightColor is divided by it
}

vec3 ambient(vec3 albedo, vec3 normal) {
  return albedo * mix(ground.rgb, sky.rgb, 0.5 + 0.5 * dot(normal, up.xyz));
}

vec3 direct(vec3 albedo, float roughness, vec3 normal, vec3 offset) {
  float facing = max(dot(normal, towardsLight.xyz), 0.0);
  float gloss = glossy(roughness, normal, normalize(-offset), facing);
  return (albedo + gloss) * facing * lightColor.rgb;
}
