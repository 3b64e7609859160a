#version 330 core
// One of several copies of a body: what they share counts once.

flat in float share;

vec3 counted(vec3 left) { return pow(max(left, vec3(1e-6)), vec3(share)); }
