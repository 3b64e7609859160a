#include "render/overlay/glyph_atlas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace careen {
namespace {

constexpr int kQuarters = 4;

}  // namespace

const Font& GlyphAtlas::font(Typeface typeface) {
  std::optional<Font>& font = typeface == Typeface::kPlain ? plain_ : monospaced_;
  if (!font) {
    font.emplace(findFont(typeface == Typeface::kPlain ? kPlainFont : kMonospacedFont));
  }
  return *font;
}

const GlyphAtlas::Entry& GlyphAtlas::entry(const Label& label, char32_t character, int quarters) {
  const Key key(label.typeface, character, label.size, quarters);
  const auto known = entries_.find(key);
  if (known != entries_.end()) {
    return known->second;
  }
  Entry entry;
  entry.glyph = font(label.typeface).draw(character, label.size, static_cast<double>(quarters) / kQuarters);
  const int width = std::min(entry.glyph.width, kWidth);
  if (column_ + width > kWidth) {
    column_ = 0;
    row_ += rowHeight_;
    rowHeight_ = 0;
  }
  entry.column = column_;
  entry.row = row_;
  column_ += width;
  rowHeight_ = std::max(rowHeight_, entry.glyph.height);
  const std::size_t rows = static_cast<std::size_t>(row_) + static_cast<std::size_t>(rowHeight_);
  coverage_.resize(std::max(coverage_.size(), rows * kWidth));
  for (int row = 0; row < entry.glyph.height; ++row) {
    const auto from = entry.glyph.coverage.begin() + static_cast<std::ptrdiff_t>(row) * entry.glyph.width;
    const std::ptrdiff_t place = std::ptrdiff_t{kWidth} * (entry.row + row) + entry.column;
    std::copy_n(from, width, coverage_.begin() + place);
  }
  ++revision_;
  return entries_.emplace(key, std::move(entry)).first->second;
}

std::vector<AtlasGlyph> GlyphAtlas::glyphsOf(const Label& label) {
  constexpr double kFar = 1e6;  // [px] of any picture: nothing is seen there
  if (!(std::fabs(label.at.x()) < kFar && std::fabs(label.at.y()) < kFar)) {
    return {};
  }
  std::vector<AtlasGlyph> glyphs;
  const int baseline = static_cast<int>(std::lround(label.at.y()));
  for (const PlacedGlyph& placed : font(label.typeface).place(label.text, label.size)) {
    if (placed.character == 0) {
      continue;
    }
    const double place = std::round(kQuarters * (label.at.x() + placed.pen)) / kQuarters;
    const double whole = std::floor(place);
    const auto column = static_cast<int>(whole);
    const Entry& found = entry(label, placed.character, static_cast<int>(kQuarters * (place - whole)));
    if (!found.glyph.coverage.empty()) {
      glyphs.push_back({.column = found.column,
                        .row = found.row,
                        .width = std::min(found.glyph.width, kWidth),
                        .height = found.glyph.height,
                        .x = column + found.glyph.left,
                        .y = baseline + found.glyph.top});
    }
  }
  return glyphs;
}

void GlyphAtlas::keepBelow(int most) {
  if (height() > most) {
    entries_.clear();
    coverage_.clear();
    column_ = row_ = rowHeight_ = 0;
  }
}

}  // namespace careen
