#version 330 core
// The part of ambient light that neighbours leave to a point of a box.

#include "frame.glsl"
#include "form_factor.glsl"

// Five texels for each box: its axes with minus its centre's coordinate along them, half extents, and the
// light that comes back from it; then lists: places of near boxes, with a weight; centres of far ones, with
// their size over pi.
uniform sampler2D neighbors;

vec4 texel(float place) {
  int index = int(place);
  return texelFetch(neighbors, ivec2(index & 1023, index >> 10), 0);
}

// Clipped at the horizon of the point.
float formFactor(vec3 p, vec3 normal, vec3 extents) {
  vec3 corners[6];
  silhouette(p, extents, corners);
  float sum = 0.0;
  vec3 entered = vec3(0.0);
  vec3 left = vec3(0.0);
  vec3 a = normalize(corners[5]);
  float above = dot(a, normal);
  for (int i = 0; i < 6; ++i) {
    vec3 b = normalize(corners[i]);
    float next = dot(b, normal);
    // Where the edge passes the horizon, if it does.
    vec3 crossing = above < 0.0 ? next * a - above * b : above * b - next * a;
    crossing *= inversesqrt(dot(crossing, crossing) + 1e-30);
    sum += edgeTerm(above < 0.0 ? crossing : a, next < 0.0 ? crossing : b, normal);
    entered = above < 0.0 && next >= 0.0 ? crossing : entered;
    left = above >= 0.0 && next < 0.0 ? crossing : left;
    a = b;
    above = next;
  }
  sum += edgeTerm(left, entered, normal);
  return min(abs(sum), 1.0);
}

// What covers less than the least does not count, so that it may be left out.
float counted(float covered) { return covered * clamp(covered / finish.w - 1.0, 0.0, 1.0); }

// The view is divided among five directions: the normal, and four that lean towards the sides. Boxes in one
// direction hide each other, those in different directions do not.
const float kLean = 0.783;      // sine and cosine of the angle
const float kUpright = 0.622;
const float kAbove = 0.235;   // part of the ambient light that comes from about the normal
const float kAside = 0.25 * (1.0 - kAbove);

struct View {
  float above;  // open part of each direction
  vec4 aside;
  vec3 back;    // light that comes back from what covers it, and how much that is
  float covered;
};

// `along`: unit vector to the box, by the normal and the two tangents.
void cover(inout View view, float part, vec3 along, vec3 back) {
  float above = max(along.x, 0.0);
  vec4 aside = max(kUpright * along.x + kLean * vec4(along.yz, -along.yz), 0.0);
  above *= above;
  aside *= aside;
  above *= above;
  aside *= aside;
  // The more of the view a box covers, the more evenly it covers all directions.
  float even = part * part;
  float share = (part - even) / (above + dot(aside, vec4(1.0)) + 1e-6);
  view.above *= max(1.0 - even - share * above / kAbove, 0.0);
  view.aside *= max(1.0 - even - share * aside / kAside, 0.0);
  view.back += part * back;
  view.covered += part;
}

vec3 openAt(vec3 offset, vec3 normal, vec3 tangent, vec2 list) {
  View view = View(1.0, vec4(1.0), vec3(0.0), 1e-6);
  mat3 frame = transpose(mat3(normal, tangent, cross(normal, tangent)));
  float farCount = floor(list.y / 64.0);
  float begin = list.x + list.y - 64.0 * farCount;
  for (float i = list.x; i < begin; i += 1.0) {
    vec4 entry = texel(i);
    vec4 x = texel(entry.x);
    vec4 y = texel(entry.x + 1.0);
    vec4 z = texel(entry.x + 2.0);
    vec4 size = texel(entry.x + 3.0);
    vec3 at = vec3(dot(x.xyz, offset) + x.w, dot(y.xyz, offset) + y.w, dot(z.xyz, offset) + z.w);
    vec3 turned = vec3(dot(x.xyz, normal), dot(y.xyz, normal), dot(z.xyz, normal));
    vec3 folded = turned * vec3(at.x < 0.0 ? -1.0 : 1.0, at.y < 0.0 ? -1.0 : 1.0, at.z < 0.0 ? -1.0 : 1.0);
    vec3 p = abs(at);
    float covered = all(lessThanEqual(p, size.xyz * 1.0001)) ? 0.5 : formFactor(p, folded, size.xyz);
    vec3 to = -(at.x * x.xyz + at.y * y.xyz + at.z * z.xyz);
    to *= inversesqrt(dot(to, to) + 1e-30);
    cover(view, entry.y * counted(covered), frame * to, texel(entry.x + 4.0).rgb);
  }
  for (float i = begin; i < begin + farCount; i += 1.0) {
    vec4 entry = texel(i);
    vec3 to = entry.xyz - offset;
    float inverse = inversesqrt(dot(to, to) + 1e-30);
    vec3 along = frame * (to * inverse);
    cover(view, counted(min(entry.w * max(along.x, 0.0) * inverse * inverse, 0.5)), along, vec3(up.w));
  }
  float open = kAbove * view.above + kAside * dot(view.aside, vec4(1.0));
  return 1.0 - (1.0 - open) * (1.0 - view.back / view.covered);
}
