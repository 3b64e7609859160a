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

/// Draws overlays over a finished picture in one call. Edges are antialiased by computing the coverage of
/// each pixel.
class OverlayBatch {
 public:
  /// `width`, `height` of the pictures [px].
  OverlayBatch(const Gl& gl, const std::filesystem::path& shaders, int width, int height);

  /// Draws to a separate layer, which is then composited over the picture, independent of its antialiasing.
  /// MachineError if there is text and no font.
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

/// Triangles for the shaders, 16 floats a vertex; adds glyphs to the atlas.
std::vector<float> overlayVertices(const OverlayShapes& shapes, GlyphAtlas& atlas);

}  // namespace careen
