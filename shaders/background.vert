#version 330 core
// One triangle that covers the picture, behind everything else.

out float height;  // 0 at the bottom, 1 at the top

void main() {
  vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  height = 0.5 * at.y + 0.5;
  gl_Position = vec4(at, 1.0, 1.0);
}
