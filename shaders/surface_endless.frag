#version 330 core
// Replaces surface_fading.frag for surfaces that do not fade.

vec3 faded(vec3 color) { return color; }
