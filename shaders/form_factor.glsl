// Form factors of boxes: the part of a surface's ambient light that a box covers.

// Angle between two directions over its sine and 2 pi, by a rational fit (E. Heitz, S. Hill, "LTC area lights",
// 2016), from its cosine.
float angleOverSine(float cosine) {
  float y = abs(cosine);
  float v = (0.8543985 + (0.4965155 + 0.0145206 * y) * y) / (3.4175940 + (4.1616724 + y) * y);
  return cosine > 0.0 ? v : 0.5 * inversesqrt(max(1.0 - cosine * cosine, 1e-7)) - v;
}

// Lambert's sum, one edge of it.
float edgeTerm(vec3 a, vec3 b, vec3 normal) { return angleOverSine(dot(a, b)) * dot(cross(a, b), normal); }

// Corners of the silhouette of a box of these half extents about the origin, relative to a point p whose
// coordinates are all positive. They are always six: a side that is not seen makes two edges cancel.
void silhouette(vec3 p, vec3 extents, out vec3 corners[6]) {
  vec3 near = extents - p;
  vec3 far = -extents - p;
  corners[0] = p.x < extents.x ? near : vec3(near.x, far.y, far.z);
  corners[1] = vec3(near.x, near.y, far.z);
  corners[2] = p.y < extents.y ? near : vec3(far.x, near.y, far.z);
  corners[3] = vec3(far.x, near.y, near.z);
  corners[4] = p.z < extents.z ? near : vec3(far.x, far.y, near.z);
  corners[5] = vec3(near.x, far.y, near.z);
}
