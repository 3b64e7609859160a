#version 330 core
// A box's face: a rounded panel in a darker frame, and the pips of a die, so that rotation is visible.

#include "frame.glsl"

in vec3 offset;
in vec3 openness;
in vec2 onFace;
flat in vec2 halfFace;
flat in vec4 beyondEdges;
flat in vec3 faceNormal;
flat in vec3 faceAcross;
flat in vec3 faceAlong;
flat in vec4 baseColor;
flat in float pips;
flat in float thickness;

vec3 ambient(vec3 albedo, vec3 normal);
vec3 direct(vec3 albedo, float roughness, vec3 normal, vec3 offset);
float edgeAlpha(float inside, vec2 slope);
void write(vec3 dark, vec3 bright, float alpha);

const vec3 kIvory = vec3(0.86, 0.82, 0.72);
const vec3 kInk = vec3(0.05, 0.05, 0.06);

// Coverage of the pixel, from the signed distance to the edge [m] (negative inside).
float covered(float distance) {
  float perPixel = length(vec2(dFdx(distance), dFdy(distance)));
  return clamp(0.5 - distance / max(perPixel, 1e-9), 0.0, 1.0);
}

float pipDistance(vec2 p, float spacing, float radius) {
  float nearest = 1e9;
  bool odd = mod(pips, 2.0) > 0.5;
  if (odd) nearest = length(p);
  if (pips > 3.5) {
    nearest = min(nearest, length(abs(p) - spacing));
  } else if (pips > 1.5) {
    nearest = min(nearest, length((p.x + p.y < 0.0 ? -p : p) - spacing));
  }
  if (pips > 5.5) nearest = min(nearest, length(vec2(abs(p.x) - spacing, p.y)));
  return nearest - radius;
}

// Alpha for the edge of the box's outline if that is within a pixel, be it beyond a face too thin for a pixel of its own;
// else for the edge of the face that is the fewest pixels away.
float nearestEdge() {
  vec2 right = dFdx(onFace);
  vec2 up = dFdy(onFace);
  vec2 steep = max(max(abs(right), abs(up)), 1e-20);
  vec2 low = (halfFace + onFace + beyondEdges.yw) / steep;
  vec2 high = (halfFace - onFace + beyondEdges.xz) / steep;
  vec2 pixels = min(low, high);
  vec2 outward = mix(vec2(1.0), vec2(-1.0), lessThan(low, high));
  if (min(pixels.x, pixels.y) >= 1.0) {
    outward = sign(onFace);
    pixels = (halfFace - abs(onFace)) / steep;
  }
  return pixels.x < pixels.y ? edgeAlpha(pixels.x * steep.x, -outward.x * vec2(right.x, up.x))
                             : edgeAlpha(pixels.y * steep.y, -outward.y * vec2(right.y, up.y));
}

void main() {
  vec3 albedo = mix(material.rgb, baseColor.rgb, boxLook.z);
  vec3 normal = faceNormal;
  if (baseColor.a > 0.5 && boxLook.y > 0.5) {
    float unit = min(halfFace.x, halfFace.y);
    float inset = 0.13 * unit;
    float rounding = 0.16 * unit;
    vec2 beyond = abs(onFace) - (halfFace - inset - rounding);
    float panel = length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0) - rounding;
    bool isLight = dot(baseColor.rgb, vec3(0.2126, 0.7152, 0.0722)) > 0.4;
    float pip = pipDistance(onFace, 0.44 * unit, 0.165 * unit);
    vec3 plain = 0.72 * albedo;  // the mean of panel and frame, where a face is too thin for them
    vec3 marked = mix(0.42 * albedo, albedo, covered(panel));
    marked = mix(marked, isLight ? kInk : kIvory, covered(pip));
    albedo = mix(plain, marked, clamp((thickness - 1.0) / 3.0, 0.0, 1.0));

    // Edges reflect light as if worn round: the mean over the pixel, or thin ones are rows of dots.
    float wear = 0.07 * unit;
    vec2 pixel = max(abs(dFdx(onFace)) + abs(dFdy(onFace)), 1e-9);
    vec2 from = max(halfFace - abs(onFace) - 0.5 * pixel, 0.0);
    vec2 to = max(halfFace - abs(onFace) + 0.5 * pixel, from + 1e-9);
    vec2 wornFrom = min(from, wear);
    vec2 wornTo = min(to, wear);
    vec2 worn = (wornTo - wornFrom) * (1.0 - 0.5 * (wornFrom + wornTo) / wear) / (to - from) * sign(onFace);
    normal = normalize(normal + 0.7 * (worn.x * faceAcross + worn.y * faceAlong));
  }
  vec3 dark = ambient(albedo, normal) * openness;
  // A face turned away from the light has no shadows of others: its worn edges have no light either.
  float turned = smoothstep(0.0, 0.06, dot(faceNormal, towardsLight.xyz));
  vec3 bright = dark + turned * direct(albedo, boxLook.x, normal, offset);
  if (boxLook.w > 0.0) {
    vec2 inside = halfFace - abs(onFace);
    float edge = min(inside.x, inside.y) - boxLook.w * min(halfFace.x, halfFace.y);
    float line = covered(edge);
    dark = mix(dark, lines.rgb, line);
    bright = mix(bright, lines.rgb, line);
  }
  write(dark, bright, nearestEdge());
}
