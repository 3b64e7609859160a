#version 330 core
// Overlay shapes, in pixels from the upper left corner of the picture.

layout(location = 0) in vec2 position;
layout(location = 1) in vec4 color;   // sRGB
layout(location = 2) in vec4 place;   // see overlay.frag
layout(location = 3) in vec4 form;
layout(location = 4) in vec2 ribbon;  // how far across, and half its width there

uniform vec2 pictureSize;

out vec2 at;
out vec4 ink;
out vec2 across;
flat out vec4 where;
flat out vec4 shape;

void main() {
  at = position;
  ink = color;
  across = ribbon;
  where = place;
  shape = form;
  gl_Position = vec4(2.0 * position.x / pictureSize.x - 1.0, 1.0 - 2.0 * position.y / pictureSize.y, 0.0, 1.0);
}
