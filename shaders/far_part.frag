#version 330 core
// The part of ambient light that boxes leave to what is far from them, drawn before in few pixels.

in vec2 place;

uniform sampler2D farMap;

out vec4 result;

void main() { result = textureLod(farMap, place, 0.0); }
