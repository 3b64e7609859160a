#version 330 core
// The part of ambient light that neighbours leave to a point of a box.

#include "frame.glsl"
#include "form_factor.glsl"

// Five texels for each box: its axes with minus its centre's coordinate along them, half extents, and the
// light that comes back from it; then lists of places of boxes, with a weight.
uniform sampler2D neighbors;

vec4 texel(float place) {
  int index = int(place);
  return texelFetch(neighbors, ivec2(index & 1023, index >> 10), 0);
}

// Clipped at the horizon of the point.
float formFactor(vec3 p, vec3 normal, vec3 extents) {
  vec3 corners[6];
  silhouette(p, extents, corners);
  float sum = 0.0;
  vec3 entered = vec3(0.0);
  vec3 left = vec3(0.0);
  bool isOut = false;
  bool hasEntered = false;
  for (int i = 0; i < 6; ++i) {
    vec3 a = corners[i];
    vec3 b = corners[i == 5 ? 0 : i + 1];
    float above = dot(a, normal);
    float next = dot(b, normal);
    if (above < 0.0 && next < 0.0) continue;
    vec3 crossing = normalize(mix(a, b, above / (above - next + 1e-30)));
    vec3 from = above < 0.0 ? crossing : normalize(a);
    vec3 to = next < 0.0 ? crossing : normalize(b);
    if (above < 0.0) {
      if (isOut) {
        sum += edgeTerm(left, crossing, normal);
      } else {
        entered = crossing;
        hasEntered = true;
      }
      isOut = false;
    }
    sum += edgeTerm(from, to, normal);
    if (next < 0.0) {
      left = crossing;
      isOut = true;
    }
  }
  if (isOut && hasEntered) sum += edgeTerm(left, entered, normal);
  return min(abs(sum), 1.0);
}

vec3 openAt(vec3 offset, vec3 normal, vec2 list) {
  vec3 open = vec3(1.0);
  for (float i = 0.0; i < list.y; i += 1.0) {
    vec4 entry = texel(list.x + i);
    vec4 x = texel(entry.x);
    vec4 y = texel(entry.x + 1.0);
    vec4 z = texel(entry.x + 2.0);
    vec4 size = texel(entry.x + 3.0);
    vec3 at = vec3(dot(x.xyz, offset) + x.w, dot(y.xyz, offset) + y.w, dot(z.xyz, offset) + z.w);
    vec3 turned = vec3(dot(x.xyz, normal), dot(y.xyz, normal), dot(z.xyz, normal));
    vec3 folded = turned * vec3(at.x < 0.0 ? -1.0 : 1.0, at.y < 0.0 ? -1.0 : 1.0, at.z < 0.0 ? -1.0 : 1.0);
    vec3 p = abs(at);
    float covered = all(lessThanEqual(p, size.xyz * 1.0001)) ? 0.5 : formFactor(p, folded, size.xyz);
    open *= 1.0 - entry.y * covered * (1.0 - texel(entry.x + 4.0).rgb);
  }
  return open;
}
