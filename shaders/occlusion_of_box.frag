#version 330 core
// A box that is the only one of its body.

vec3 counted(vec3 left) { return left; }
