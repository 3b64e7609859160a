#version 330 core
// The part of ambient light that a box leaves to a point of a surface far from it: what covers as much of the
// view at the box's centre. For a sphere above the horizon that is exact.

#include "frame.glsl"

in vec3 at;
flat in vec3 bodyNormal;
flat in vec3 extents;
flat in vec3 returned;
flat in vec2 split;

out vec4 result;

void main() {
  float squared = dot(at, at);
  float silhouette = 4.0 * dot(extents.yzx * extents.zxy, abs(at));  // times the distance
  float covered = silhouette * max(-dot(at, bodyNormal), 0.0) / (3.14159265 * squared * squared);
  covered = max(min(covered, 0.5) - occlusion.y, 0.0) / (1.0 - 2.0 * occlusion.y);
  covered *= smoothstep(split.x, split.y, squared);
  result = vec4(1.0 - covered * (1.0 - returned), 1.0);
}
