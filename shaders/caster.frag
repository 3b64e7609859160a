#version 330 core
// Only depth is written.

void main() {}
