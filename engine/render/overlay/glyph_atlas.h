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

/// Glyphs drawn once for each size they are used in, side by side in one image that is as wide as kWidth and
/// grows downward. A glyph stands at a whole row and at a quarter of a column: text stays crisp.
class GlyphAtlas {
 public:
  static constexpr int kWidth = 1024;  ///< [px]

  /// Where the glyphs of a label are and go; those without pixels, such as spaces, are left out. MachineError
  /// if there is no font.
  std::vector<AtlasGlyph> glyphsOf(const Label& label);

  int height() const { return static_cast<int>(coverage_.size()) / kWidth; }
  /// Changes whenever something is drawn into it.
  int revision() const { return revision_; }
  /// Rows from the top, a byte a pixel.
  const std::vector<std::uint8_t>& coverage() const { return coverage_; }
  /// Starts anew if it is higher than that [px]. Between pictures only.
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
  int column_ = 0;  // where the next glyph goes
  int row_ = 0;
  int rowHeight_ = 0;
  int revision_ = 0;
};

}  // namespace careen
