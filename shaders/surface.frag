#version 330 core
// Tiles, or paint with a skirting board, both averaged over the pixel, which prevents shimmer at any
// distance.

#include "frame.glsl"
#include "background.glsl"

in vec3 offset;
in float inside;
in vec4 untilEnds;
in vec2 onSurface;
flat in vec3 surfaceNormal;
flat in vec2 size;
flat in vec4 edges;
flat in vec4 baseColor;

vec3 ambient(vec3 albedo, vec3 normal);
vec3 direct(vec3 albedo, float roughness, vec3 normal, vec3 offset);
vec3 opennessHere();
float edgeAlpha(float inside, vec2 slope);
void write(vec3 dark, vec3 bright, float alpha);

const float kSkirted = 1.0;
const float kTiles = 2.0;
const float kJoint = 0.02;      // width of the joint between tiles
const float kSkirting = 0.22;   // height of the skirting board
const float kRim = 0.05;        // width of the line at the border of a surface

// Integral from 0 to x of a comb that is 1 within half a joint of every integer.
vec2 combIntegral(vec2 x) {
  vec2 shifted = x + 0.5 * kJoint;
  return floor(shifted) * kJoint + min(fract(shifted), kJoint);
}

// Integral of a wave that is 1 on even tiles and -1 on odd ones.
vec2 waveIntegral(vec2 x) { return 1.0 - abs(2.0 * fract(0.5 * x) - 1.0); }

vec3 tiles(vec3 base) {
  vec2 width = max(fwidth(onSurface), 1e-5);
  vec2 from = onSurface - 0.5 * width;
  vec2 to = onSurface + 0.5 * width;
  vec2 joints = (combIntegral(to) - combIntegral(from)) / width;
  vec2 wave = (waveIntegral(to) - waveIntegral(from)) / width;
  vec3 tile = base * (1.0 + surfaceLook.z * wave.x * wave.y);
  float joint = 1.0 - (1.0 - joints.x) * (1.0 - joints.y);
  return mix(tile, lines.a > 0.5 ? lines.rgb : 0.55 * base, surfaceLook.w * joint);
}

vec3 skirted(vec3 base) {
  float width = max(fwidth(onSurface.y), 1e-5);
  float board = clamp((kSkirting - onSurface.y) / width + 0.5, 0.0, 1.0) * edges.z;
  float lip = clamp(0.5 * kJoint + 0.5 * width - abs(onSurface.y - kSkirting), 0.0, width) / width * edges.z;
  return base * mix(mix(1.0, 0.62, board), 0.4, lip);
}

// A dark line along a free border of a surface, so that a wall stands out from its background.
float rim() {
  if (size.x <= 0.0) return 0.0;  // no rectangle, no edges known
  vec2 width = max(fwidth(onSurface), 1e-5);
  vec4 inward = vec4(onSurface.x, size.x - onSurface.x, onSurface.y, size.y - onSurface.y);
  vec4 line = clamp((kRim - inward) / width.xxyy + 0.5, 0.0, 1.0) * (1.0 - edges);
  return max(max(line.x, line.y), max(line.z, line.w));
}

// Ambient occlusion: corners of a room receive less ambient light.
float openness() {
  vec4 inward = vec4(onSurface.x, size.x - onSurface.x, onSurface.y, size.y - onSurface.y);
  vec4 shade = 1.0 - occlusion.x * edges * exp(-1.6 * max(inward, 0.0));
  return shade.x * shade.y * shade.z * shade.w;
}

void main() {
  vec3 albedo = baseColor.rgb;
  float roughness = surfaceLook.y;
  if (baseColor.a > kTiles - 0.5) {
    albedo = tiles(albedo);
    roughness = surfaceLook.x;
  } else if (baseColor.a > kSkirted - 0.5) {
    albedo = skirted(albedo);
  }
  albedo *= 1.0 - 0.45 * rim();
  albedo *= openness();
  vec3 dark = ambient(albedo, surfaceNormal) * opennessHere();
  vec3 bright = dark + direct(albedo, roughness, surfaceNormal, offset);
  vec2 untilEnd = min(untilEnds.xy, untilEnds.zw);
  float left = min(untilEnd.x, untilEnd.y);
  if (left < 1.0) {  // it ends here: into the background
    vec3 beyond = background(gl_FragCoord.y * occlusion.w);
    float seen = smoothstep(0.0, 1.0, left);
    dark = mix(beyond, dark, seen);
    bright = mix(beyond, bright, seen);
  }
  float linear = inside * gl_FragCoord.w;  // in the picture
  write(dark, bright, edgeAlpha(linear, vec2(dFdx(linear), dFdy(linear))));
}
