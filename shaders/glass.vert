#version 330 core
// Floor and walls seen from behind, a little nearer than they are, so that boxes that touch them lie behind them.

#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 5) in float fromRim;
layout(location = 6) in vec4 fromEnds;

out float inside;
out vec4 untilEnds;

void main() {
  inside = fromRim;
  untilEnds = fromEnds;
  gl_Position = clipFromOffset * vec4(0.999 * position, 1.0);
}
