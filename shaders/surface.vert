#version 330 core
// Floor and walls. Lengths on a surface are in tiles.

#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 place;    // coordinates on the surface, then the surface's size
layout(location = 3) in vec4 adjoins;  // 1 where another surface meets this one: left, right, below, above
layout(location = 4) in vec4 color;    // alpha: pattern
layout(location = 5) in float fromRim;  // distance to the outline
layout(location = 6) in vec4 fromEnds;  // distances to the ends of both coordinates, in margins that fade

out vec3 offset;
out vec2 onSurface;
out float inside;
out vec4 untilEnds;
flat out vec3 surfaceNormal;
flat out vec2 size;
flat out vec4 edges;
flat out vec4 baseColor;

void main() {
  offset = position;
  onSurface = place.xy;
  inside = fromRim;
  untilEnds = fromEnds;
  surfaceNormal = normal;
  size = place.zw;
  edges = adjoins;
  baseColor = color;
  gl_Position = clipFromOffset * vec4(position, 1.0);
}
