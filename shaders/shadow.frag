#version 330 core
// The part of a light of finite size that a box covers. Of what others leave of the light, it keeps off as
// much: where penumbras overlap, boxes cover parts of it that have nothing to do with each other.

#include "frame.glsl"

in vec3 fromAxis;
in vec3 passing;
flat in vec3 halfSlab;
flat in vec3 halfPassing;
flat in float weight;

out vec4 result;

// What a straight edge leaves of the light's disc, within 1 %, and of a pixel: `at` in units of the curve's half
// width, of which a fifth of the square is its variance, as are the disc's and the pixel's together.
const float kPixel = 5.0 / 12.0;  // of squares
vec3 covered(vec3 at) {
  vec3 t = clamp(0.5 + 0.5 * at, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

void main() {
  vec3 enters = passing - halfPassing;
  vec3 leaves = passing + halfPassing;
  float first = max(enters.x, max(enters.y, enters.z));
  float last = min(leaves.x, min(leaves.y, leaves.z));
  float penumbra = towardsLight.w * max(0.5 * (first + last), 0.0);
  // A pixel's own width, so that edges are smooth where the penumbra is narrower.
  vec3 right = dFdx(fromAxis);
  vec3 above = dFdy(fromAxis);
  vec3 scale = inversesqrt(penumbra * penumbra + kPixel * (right * right + above * above) + 1e-20);
  vec3 inside = covered((halfSlab - fromAxis) * scale) + covered((halfSlab + fromAxis) * scale) - 1.0;
  float part = last > 0.0 ? weight * inside.x * inside.y * inside.z : 0.0;
  result = vec4(vec3(part), 0.0);
}
