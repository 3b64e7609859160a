#version 330 core
// Fraction of the light that arrives: 3 x 3 filtered comparisons with the shadow map.

#include "frame.glsl"

uniform sampler2DShadow shadowMap;

const float kSpread = 1.6 / 2048.0;  // between comparisons: each blends 2 x 2 texels already

// A loop, because llvmpipe exits a loop early if no pixel of a block needs it, but runs both sides of an if.
float lightArriving(vec3 offset, float facing) {
  vec3 at = (shadowFromOffset * vec4(offset, 1.0)).xyz;
  at.z = min(at.z, 1.0);  // nothing beyond the map's range is in shadow
  bool needed = facing > 0.0 && all(greaterThan(at.xy, shadowBounds.xy)) && all(lessThan(at.xy, shadowBounds.zw));
  int taps = needed ? 9 : 0;
  float sum = needed ? 0.0 : 9.0;
  for (int tap = 0; tap < taps; ++tap) {
    vec2 place = vec2(float(tap % 3), float(tap / 3)) - 1.0;
    sum += textureLod(shadowMap, at + vec3(kSpread * place, 0.0), 0.0);
  }
  return sum / 9.0;
}
