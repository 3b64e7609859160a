#version 330 core
// One face of one box. Points are offsets from the eye along the world's axes.

#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 across;
layout(location = 3) in vec3 along;
layout(location = 4) in vec4 place;  // [m] on the face, from its centre; half its size
layout(location = 5) in vec4 color;  // alpha 1: with marks on the faces
layout(location = 6) in vec4 about;  // pips, smaller width [px], place and length of the list of neighbours
layout(location = 7) in vec3 eye;    // [m] its foot on the face's plane; part of the way there of the opposite face

invariant gl_Position;
out vec3 offset;
out vec3 openness;          // part of ambient light that neighbours leave
out vec2 onFace;            // [m] from the centre of the face
flat out vec2 halfFace;     // [m]
flat out vec3 eyeFoot;
flat out vec3 faceNormal;
flat out vec3 faceAcross;   // directions of onFace
flat out vec3 faceAlong;
flat out vec4 baseColor;
flat out float pips;        // opposite faces add up to seven
flat out float thickness;   // [px] smaller width of the face

vec3 openAt(vec3 offset, vec3 normal, vec3 tangent, vec2 list);

void main() {
  offset = position;
  onFace = place.xy;
  halfFace = place.zw;
  eyeFoot = eye;
  faceNormal = normal;
  faceAcross = across;
  faceAlong = along;
  baseColor = color;
  pips = about.x;
  thickness = about.y;
  openness = openAt(offset, faceNormal, across, about.zw);
  gl_Position = clipFromOffset * vec4(position, 1.0);
}
