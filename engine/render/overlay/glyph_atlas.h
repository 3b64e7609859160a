#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "image/font.h"
#include "render/overlay/shapes.h"

namespace careen {

/// A glyph's pixels in the atlas, and where they go on the picture.
struct AtlasGlyph {
  int column = 0;  ///< [px] in the atlas
  int row = 0;     ///< [px] likewise
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  int x = 0;       ///< [px] on the picture, of its upper left pixel
  int y = 0;       ///< [px]
};

/// Caches rasterized glyphs, once for each size used, in one image of width kWidth that grows downward.
/// Glyphs are placed at whole rows and quarter columns, so that text is crisp.
class GlyphAtlas {
 public:
  static constexpr int kWidth = 1024;  ///< [px]

  /// The glyphs of a label, with positions in the atlas and the picture; those without pixels, such as
  /// spaces, are omitted. MachineError if there is no font.
  std::vector<AtlasGlyph> glyphsOf(const Label& label);

  int height() const { return static_cast<int>(coverage_.size()) / kWidth; }
  /// Changes whenever a glyph is added.
  int revision() const { return revision_; }
  /// Top row first, one byte a pixel.
  const std::vector<std::uint8_t>& coverage() const { return coverage_; }
  /// Clears the atlas if it is higher than this [px]. Call only between pictures.
  void keepBelow(int height);

 private:
  using Key = std::tuple<Typeface, char32_t, double, int>;  // size; quarters of a pixel
  struct Entry {
    int column = 0;
    int row = 0;
    Glyph glyph;
  };
  const Font& font(Typeface typeface);
  const Entry& entry(const Label& label, char32_t character, int quarters);

  std::optional<Font> plain_;
  std::optional<Font> monospaced_;
  std::map<Key, Entry> entries_;
  std::vector<std::uint8_t> coverage_;
  int column_ = 0;  // position of the next glyph
  int row_ = 0;
  int rowHeight_ = 0;
  int revision_ = 0;
};

}  // namespace careen
