#version 330 core
// A pixel of what hides boxes, in a picture of boxes alone.

out vec4 result;

void write(vec3 dark, vec3 bright, float alpha) { result = vec4(0.0, 0.0, 0.0, alpha); }
