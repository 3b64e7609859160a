// What is behind everything, by height in the picture: 0 at the bottom, 1 at the top.
vec3 background(float height) {
  return mix(backgroundBottom.rgb, backgroundTop.rgb, smoothstep(0.0, 1.0, height));
}
