// The uniforms that all shaders of a frame share; FrameBlock in C++. An offset is a point in the world minus
// the eye.
layout(std140) uniform Frame {
  mat4 clipFromOffset;
  vec4 towardsLight;      // unit; w: [1] how wide penumbras are on each side of an edge, of the distance
  vec4 lightColor;        // linear, like all colours here; radiance of a white face turned to the light
  vec4 up;                // unit; w: part of what a box far away covers that comes back from it
  vec4 sky;               // ambient radiance of a white face turned up
  vec4 ground;            // the same for a face turned down
  vec4 backgroundTop;
  vec4 backgroundBottom;
  vec4 finish;    // start of the tone curve's shoulder, 1 with edges in alpha, dither [steps of 8 bits], least form factor on boxes
  vec4 boxLook;   // roughness, 1 with marks on faces, share of a box's own colour, lines along edges
  vec4 material;  // colour of all boxes, for the share without a colour of their own
  vec4 lines;     // colour of lines along edges, and of floor joints
  vec4 surfaceLook;  // roughness of tiles and of walls, contrast of tiles, strength of joints
  vec4 occlusion;    // shade of a room's corners, least form factor drawn on surfaces, 1 / size of the picture [px]
};
