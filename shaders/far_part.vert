#version 330 core
// One triangle that covers a picture.

out vec2 place;  // 0 ... 1

void main() {
  vec2 at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  place = 0.5 * at + 0.5;
  gl_Position = vec4(at, 0.0, 1.0);
}
