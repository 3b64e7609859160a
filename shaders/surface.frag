#version 330 core
// A surface in its light, with what boxes keep off. llvmpipe takes all branches, so there is a program for each
// covering.

#include "frame.glsl"

in vec3 offset;
in float inside;
in vec2 onSurface;
flat in vec3 surfaceNormal;
flat in vec2 size;
flat in vec4 edges;
flat in vec4 baseColor;

vec3 ambient(vec3 albedo, vec3 normal);
vec3 direct(vec3 albedo, float roughness, vec3 normal, vec3 offset);
vec3 opennessHere();
vec3 patterned(vec3 base);
float roughnessHere();
vec3 faded(vec3 color);
float edgeAlpha(float inside, vec2 slope);
void write(vec3 dark, vec3 bright, float alpha);

const float kRim = 0.05;        // width of the line at the border of a surface

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
  vec3 albedo = patterned(baseColor.rgb);
  albedo *= 1.0 - 0.45 * rim();
  albedo *= openness();
  vec3 dark = ambient(albedo, surfaceNormal) * opennessHere();
  vec3 bright = dark + direct(albedo, roughnessHere(), surfaceNormal, offset);
  float linear = inside * gl_FragCoord.w;  // in the picture
  write(faded(dark), faded(bright), edgeAlpha(linear, vec2(dFdx(linear), dFdy(linear))));
}
