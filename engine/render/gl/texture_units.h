#pragma once

namespace careen {

/// Texture units, which belong to whole contexts: what stays bound from frame to frame has one of its own.
enum TextureUnit : unsigned {
  kMapUnit = 0,       ///< maps of occlusion, bound for each drawing; the picture in a window
  kNeighborUnit = 1,  ///< boxes and lists of neighbours
  kGlyphUnit = 2,     ///< the atlas of glyphs
};

}  // namespace careen
