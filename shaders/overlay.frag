#version 330 core
// Coverage of a pixel by a shape, from the signed distance of the pixel's centre to its edge [px].

in vec2 at;
in vec4 ink;
in vec2 across;
flat in vec4 where;
flat in vec4 shape;  // w: which kind of shape

uniform sampler2D atlas;

out vec4 result;  // colour times alpha, alpha

const int kStroke = 0;
const int kPlate = 1;
const int kGlyph = 2;
const vec4 kRim = vec4(vec3(19.0, 23.0, 28.0) / 255.0, 0.6);
const float kHeadSlope = 0.38;  // half an arrow head's width over its length

float covered(float distance) { return clamp(0.5 - distance, 0.0, 1.0); }

// where: from, to; shape: half width, length of the arrow head, width of the rim.
float strokeDistance() {
  vec2 line = where.zw - where.xy;
  float size = length(line);
  vec2 along = size > 0.0 ? line / size : vec2(1.0, 0.0);
  vec2 to = at - where.xy;
  vec2 p = vec2(dot(to, along), abs(dot(to, vec2(-along.y, along.x))));
  float head = shape.y;
  float shaft = size - 0.8 * head;
  float result = length(vec2(p.x - clamp(p.x, 0.0, shaft), p.y)) - shape.x;
  if (head > 0.0) {
    float slanted = dot(vec2(p.x - size, p.y), normalize(vec2(kHeadSlope, 1.0)));
    result = min(result, max(slanted, size - head - p.x));
  }
  return result;
}

vec4 stroke() {
  float distance = strokeDistance();
  float body = covered(distance) * ink.a;
  float rim = covered(distance - shape.z) * kRim.a * ink.a * (shape.z > 0.0 ? 1.0 : 0.0);
  return vec4(ink.rgb, 1.0) * body + vec4(kRim.rgb, 1.0) * rim * (1.0 - covered(distance));
}

// where: two corners; shape: corner radius, stripe spacing.
vec4 plate() {
  vec2 middle = 0.5 * (where.xy + where.zw);
  vec2 beyond = abs(at - middle) - (0.5 * (where.zw - where.xy) - shape.x);
  float distance = length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0) - shape.x;
  float alpha = covered(distance) * ink.a;
  if (shape.y > 0.0) {
    float stripe = abs(mod((at.x + at.y) * 0.70710678, shape.y) - 0.5 * shape.y) - 0.25 * shape.y;
    alpha *= mix(0.3, 1.0, covered(stripe));
  }
  return vec4(ink.rgb, 1.0) * alpha;
}

// where.xy: offset from a pixel of the picture to a pixel of the atlas.
vec4 glyph() {
  float coverage = texelFetch(atlas, ivec2(floor(at)) + ivec2(where.xy), 0).r;
  return vec4(ink.rgb, 1.0) * coverage * ink.a;
}

vec4 ribbon() { return vec4(ink.rgb, 1.0) * covered(abs(across.x) - across.y) * ink.a; }

void main() {
  int kind = int(shape.w);
  if (kind == kStroke) {
    result = stroke();
  } else if (kind == kPlate) {
    result = plate();
  } else if (kind == kGlyph) {
    result = glyph();
  } else {
    result = ribbon();
  }
}
