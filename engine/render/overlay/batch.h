#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "image/picture.h"
#include "render/gl/vertex_array.h"
#include "render/overlay/glyph_atlas.h"
#include "render/overlay/shapes.h"

namespace careen {

struct Gl;

/// Draws overlays over a finished picture, all of them at once. Edges are smooth because every pixel works
/// out how much of it is covered.
class OverlayBatch {
 public:
  /// For pictures of this size [px].
  OverlayBatch(const Gl& gl, const std::filesystem::path& shaders, int width, int height);

  /// Onto a layer of its own, which then covers the picture, whatever way its edges were smoothed.
  /// MachineError if text is to be written and there is no font.
  void drawOver(Picture& picture, const OverlayShapes& shapes);

 private:
  void sendAtlas();
  void drawLayer(const OverlayShapes& shapes);

  const Gl& gl_;
  int width_;
  int height_;
  unsigned array_;
  VertexBuffer vertices_;
  unsigned program_;
  unsigned texture_ = 0;
  unsigned layer_ = 0;
  std::vector<std::uint8_t> rgba_;
  GlyphAtlas atlas_;
  int sentRevision_ = 0;
};

/// Triangles for the shaders, 16 floats a vertex; glyphs go into the atlas.
std::vector<float> overlayVertices(const OverlayShapes& shapes, GlyphAtlas& atlas);

}  // namespace careen
