#version 330 core
// One face of one box. Points are offsets from the eye along the world's axes.

#include "frame.glsl"

layout(location = 0) in vec3 corner;  // of the cube from -1 to 1
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 position;
layout(location = 3) in vec3 axisX;  // columns of the body's rotation
layout(location = 4) in vec3 axisY;
layout(location = 5) in vec3 axisZ;
layout(location = 6) in vec3 halfExtents;
layout(location = 7) in vec4 color;  // alpha 1: with marks on the faces

out vec3 offset;
out vec2 onFace;            // [m] from the centre of the face
flat out vec2 halfFace;     // [m]
flat out vec3 faceNormal;
flat out vec3 faceAcross;   // directions of onFace
flat out vec3 faceAlong;
flat out vec4 baseColor;
flat out float pips;        // opposite faces add up to seven

void main() {
  mat3 worldFromBody = mat3(axisX, axisY, axisZ);
  offset = position + worldFromBody * (halfExtents * corner);
  faceNormal = worldFromBody * normal;

  vec3 size = abs(normal);
  vec3 at = halfExtents * corner;
  if (size.x > 0.5) {
    onFace = at.yz;
    halfFace = halfExtents.yz;
    faceAcross = axisY;
    faceAlong = axisZ;
    pips = normal.x > 0.0 ? 1.0 : 6.0;
  } else if (size.y > 0.5) {
    onFace = at.zx;
    halfFace = halfExtents.zx;
    faceAcross = axisZ;
    faceAlong = axisX;
    pips = normal.y > 0.0 ? 2.0 : 5.0;
  } else {
    onFace = at.xy;
    halfFace = halfExtents.xy;
    faceAcross = axisX;
    faceAlong = axisY;
    pips = normal.z > 0.0 ? 3.0 : 4.0;
  }
  baseColor = color;
  gl_Position = clipFromOffset * vec4(offset, 1.0);
}
