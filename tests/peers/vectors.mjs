// Vectors are arrays of three numbers, quaternions of four, w first.
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export function normalized(v) {
  const length = Math.hypot(...v);
  return v.map((x) => x / length);
}

export function rotated(q, v) {
  const [w, ...u] = q;
  const t = cross(u, v).map((x) => 2 * x);
  const s = cross(u, t);
  return v.map((x, k) => x + w * t[k] + s[k]);
}

// What v is in the frame of a body of that orientation.
export const inFrameOf = (q, v) => rotated([q[0], -q[1], -q[2], -q[3]], v);

// Of a pair of materials.
export const touching = (a, b) => ({
  restitution: Math.max(a.restitution, b.restitution),
  friction: Math.sqrt(a.friction * b.friction),
});

// The boxes of a body, as it has several or is one.
export const partsOf = (box) =>
    box.parts ?? [{half_extents: box.half_extents, middle: box.middle, orientation: [1, 0, 0, 0]}];
