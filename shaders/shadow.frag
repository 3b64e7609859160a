#version 330 core
// How much of the light arrives: 3 x 3 filtered comparisons with the shadow map.

#include "frame.glsl"

uniform sampler2DShadow shadowMap;

const float kSpread = 1.6 / 2048.0;  // between comparisons: each is a blend of 2 x 2 texels already

float lightArriving(vec3 offset) {
  vec3 at = (shadowFromOffset * vec4(offset, 1.0)).xyz;
  at.z = min(at.z, 1.0);  // beyond the map's reach nothing is hidden
  float sum = 0.0;
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      sum += texture(shadowMap, at + vec3(kSpread * vec2(column, row), 0.0));
    }
  }
  return sum / 9.0;
}
