#version 330 core
// Replaces neighbors.vert where nothing occludes boxes.

vec3 openAt(vec3 offset, vec3 normal, vec3 tangent, vec2 list) { return vec3(1.0); }
