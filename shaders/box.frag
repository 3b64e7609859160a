#version 330 core
// A box's face: a rounded panel in a darker frame, and the pips of a die, so that rotation is visible.

#include "frame.glsl"

in vec3 offset;
in vec3 openness;
in vec2 onFace;
flat in vec2 halfFace;
flat in vec3 eyeFoot;
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

// From the middle of the nearest pip.
vec2 fromPip(vec2 p, float spacing) {
  bool odd = mod(pips, 2.0) > 0.5;
  vec2 nearest = odd ? p : vec2(1e9);
  if (pips > 3.5) {
    vec2 corner = abs(p) - spacing;
    nearest = dot(corner, corner) < dot(nearest, nearest) ? corner : nearest;
  } else if (pips > 1.5) {
    vec2 corner = (p.x + p.y < 0.0 ? -p : p) - spacing;
    nearest = dot(corner, corner) < dot(nearest, nearest) ? corner : nearest;
  }
  if (pips > 5.5) {
    vec2 side = vec2(abs(p.x) - spacing, p.y);
    nearest = dot(side, side) < dot(nearest, nearest) ? side : nearest;
  }
  return nearest;
}

// Coverage of the pixel by a disc about p = 0: by the distance to its edge, but no more than its chord has of the
// pixel's length, which is taken where that is longest: there the disc may be thinner than a pixel. `pixel`: what the
// place grows by to the right and up.
float coveredByDisc(vec2 p, float radius, mat2 pixel) {
  float size = length(p);
  vec2 outward = size > 0.0 ? p / size : vec2(1.0, 0.0);
  float byEdge = 0.5 - (size - radius) / max(length(outward * pixel), 1e-9);
  // The pixel's axes are those of the ellipse that it makes of a circle.
  mat2 squares = pixel * transpose(pixel);
  float mean = 0.5 * (squares[0][0] + squares[1][1]);
  float differ = 0.5 * (squares[0][0] - squares[1][1]);
  float spread = sqrt(differ * differ + squares[0][1] * squares[0][1]);
  float far = sqrt(mean + spread);
  float near = sqrt(max(mean - spread, 0.0));
  vec2 axis = differ > 0.0 ? vec2(differ + spread, squares[0][1]) : vec2(squares[0][1], spread - differ);
  axis = spread > 0.0 ? normalize(axis) : vec2(1.0, 0.0);
  float aside = max(abs(dot(p, vec2(-axis.y, axis.x))) - 0.5 * near, 0.0);
  float chord = sqrt(max(radius * radius - aside * aside, 0.0));
  float along = dot(p, axis);
  float byChord = min(chord, along + 0.5 * far) - max(-chord, along - 0.5 * far);
  return clamp(min(byEdge, byChord / max(far, 1e-9)), 0.0, 1.0) * min(2.0 * radius / max(near, 1e-9), 1.0);
}

// A place on the face over how far it is, which makes it linear in the picture: here, and what it grows by to the right
// and up.
mat3 placeHere() {
  vec3 place = vec3(onFace, 1.0) * gl_FragCoord.w;
  return mat3(place, dFdx(place), dFdy(place));
}

// The nearer one of an edge, as its distance in pixels, in some unit, and what that grows by to the right and up; and
// of another along a line, the distance inside of which is line.xy . onFace + line.z.
vec4 nearer(vec4 edge, vec3 line, mat3 place) {
  vec3 inside = line * place;
  float pixels = inside.x / max(max(abs(inside.y), abs(inside.z)), 1e-20);
  return pixels < edge.x ? vec4(pixels, inside) : edge;
}

// Likewise, of the outline's edge from a corner of the face to the box's far side, which leads to the eye's foot.
vec4 nearerFrom(vec2 corner, vec4 edge, mat3 place) {
  vec2 along = eyeFoot.xy - corner;
  vec2 inward = vec2(-along.y, along.x);
  inward *= -sign(dot(inward, corner));  // the face's centre is inside
  return nearer(edge, vec3(inward, -dot(inward, corner)), place);
}

// Alpha for the edge of the box's outline if that is within a pixel, be it beyond a face too thin for a pixel of its
// own; else for the edge of the face that is the fewest pixels away. On the plane of the face and seen from the eye, the
// outline is the hull of the face and of the opposite one, which is the face shrunk towards the eye's foot.
float nearestEdge() {
  mat3 place = placeHere();
  vec2 over = max(abs(eyeFoot.xy) - halfFace, 0.0);  // not 0: the face on that side is seen
  vec2 towards = vec2(eyeFoot.x < 0.0 ? -1.0 : 1.0, eyeFoot.y < 0.0 ? -1.0 : 1.0);
  vec2 reach = halfFace + over * eyeFoot.z;
  vec4 edge = nearer(vec4(1e9), vec3(-towards.x, 0.0, reach.x), place);
  edge = nearer(edge, vec3(0.0, -towards.y, reach.y), place);
  edge = nearer(edge, vec3(towards.x, 0.0, halfFace.x), place);
  edge = nearer(edge, vec3(0.0, towards.y, halfFace.y), place);
  if (max(over.x, over.y) > 0.0) {
    vec2 corner = towards * halfFace;
    edge = nearerFrom(over.x > 0.0 ? vec2(corner.x, -corner.y) : corner, edge, place);
    edge = nearerFrom(over.y > 0.0 ? vec2(-corner.x, corner.y) : corner, edge, place);
  }
  float alpha = edgeAlpha(edge.y, edge.zw);
  if (alpha < 1.0) return alpha;
  edge = nearer(vec4(1e9), vec3(-sign(onFace.x), 0.0, halfFace.x), place);
  edge = nearer(edge, vec3(0.0, -sign(onFace.y), halfFace.y), place);
  return edgeAlpha(edge.y, edge.zw);
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
    float pip = coveredByDisc(fromPip(onFace, 0.44 * unit), 0.165 * unit, mat2(dFdx(onFace), dFdy(onFace)));
    vec3 plain = 0.72 * albedo;  // the mean of panel and frame, where a face is too thin for them
    vec3 marked = mix(0.42 * albedo, albedo, covered(panel));
    marked = mix(marked, isLight ? kInk : kIvory, pip);
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
