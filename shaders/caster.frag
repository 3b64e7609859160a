#version 330 core
// Depth is all there is to write.

void main() {}
