#version 330 core
// One of several copies of a body: what they share counts once.

flat in float share;

vec3 counted(vec3 left) { return pow(left, vec3(share)); }
