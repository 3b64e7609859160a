// What all shaders of a frame share; FrameBlock in C++. An offset is a point of the world less the eye.
layout(std140) uniform Frame {
  mat4 clipFromOffset;
  mat4 shadowFromOffset;  // to texture coordinates and depth, 0 to 1
  vec4 shadowBounds;      // of what casts shadows, in texture coordinates: least, then greatest
  vec4 towardsLight;      // unit
  vec4 lightColor;        // linear, as all colours here; what a white face turned to the light sends back
  vec4 up;                // unit
  vec4 sky;               // what a white face turned up gets from all around
  vec4 ground;            // the same for one turned down
  vec4 backgroundTop;
  vec4 backgroundBottom;
  vec4 finish;    // where the tone curve's shoulder begins, 1 with edges in alpha, dither [steps of 8 bits]
  vec4 boxLook;   // roughness, 1 with marks on faces, part of a box's own colour, lines along edges
  vec4 material;  // colour of all boxes, as far as they have none of their own
  vec4 lines;     // colour of lines along edges, and of a floor's joints
  vec4 surfaceLook;  // roughness of tiles and of walls, contrast of tiles, strength of joints
};
