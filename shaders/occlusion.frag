#version 330 core
// The part of ambient light that a box leaves to a point of a surface near it.

#include "frame.glsl"
#include "form_factor.glsl"

in vec3 at;
flat in vec3 bodyNormal;
flat in vec3 extents;
flat in vec3 returned;
flat in vec2 split;

out vec4 result;

// Of what is left, as one box of its body, or as one of several copies.
vec3 counted(vec3 left);

void main() {
  vec3 p = abs(at);
  vec3 normal = bodyNormal * vec3(at.x < 0.0 ? -1.0 : 1.0, at.y < 0.0 ? -1.0 : 1.0, at.z < 0.0 ? -1.0 : 1.0);
  vec3 corners[6];
  silhouette(p, extents, corners);
  vec3 first = normalize(corners[0]);
  vec3 last = first;
  float sum = 0.0;
  for (int i = 1; i < 6; ++i) {
    vec3 next = normalize(corners[i]);
    sum += edgeTerm(last, next, normal);
    last = next;
  }
  sum = abs(sum + edgeTerm(last, first, normal));
  // Inside, half: the limit at the line where box and surface touch.
  float covered = all(lessThanEqual(p, extents)) ? 0.5 : min(sum, 0.5);
  covered = max(covered - occlusion.y, 0.0) / (1.0 - 2.0 * occlusion.y);
  // far_occlusion.frag has the rest.
  covered *= 1.0 - smoothstep(split.x, split.y, dot(at, at));
  result = vec4(counted(1.0 - covered * (1.0 - returned)), 1.0);
}
