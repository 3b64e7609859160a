#include "render/overlay/glyph_atlas.h"

#include <gtest/gtest.h>

#include <cmath>

namespace careen {
namespace {

Label written(const std::string& text, double size = 20, double x = 0) {
  return {.text = text, .at = Vec2(x, 50), .size = size, .ink = {}};
}

std::uint8_t atlasPixel(const GlyphAtlas& atlas, int column, int row) {
  return atlas.coverage().at(static_cast<std::size_t>(row) * GlyphAtlas::kWidth +
                             static_cast<std::size_t>(column));
}

TEST(GlyphAtlas, glyphStandsWhereTheFontPutsIt) {
  GlyphAtlas atlas;
  const std::vector<AtlasGlyph> glyphs = atlas.glyphsOf(written("HH", 20, 7));
  ASSERT_EQ(glyphs.size(), 2U);
  const Glyph alone = findFont(kPlainFont).draw(U'H', 20, 0);
  EXPECT_EQ(glyphs[0].x, 7 + alone.left);
  EXPECT_EQ(glyphs[0].y, 50 + alone.top);
  for (int row = 0; row < alone.height; ++row) {
    for (int column = 0; column < alone.width; ++column) {
      ASSERT_EQ(atlasPixel(atlas, glyphs[0].column + column, glyphs[0].row + row),
                alone.coverage.at(static_cast<std::size_t>(row * alone.width + column)));
    }
  }
  const double pen = findFont(kPlainFont).width("H", 20);  // 15.04 px: a whole pixel, within an eighth
  EXPECT_EQ(glyphs[1].x, 7 + static_cast<int>(std::lround(pen)) + alone.left);
}

TEST(GlyphAtlas, glyphIsDrawnOnceForEachSizeAndPlaceWithinAPixel) {
  GlyphAtlas atlas;
  atlas.glyphsOf(written("a"));
  const int once = atlas.revision();
  atlas.glyphsOf(written("a", 20, 3));
  EXPECT_EQ(atlas.revision(), once);
  atlas.glyphsOf(written("a", 21));
  EXPECT_EQ(atlas.revision(), once + 1);
  atlas.glyphsOf(written("a", 20, 0.5));
  EXPECT_EQ(atlas.revision(), once + 2);
}

TEST(GlyphAtlas, spacesTakeNoPixels) {
  GlyphAtlas atlas;
  EXPECT_EQ(atlas.glyphsOf(written("a b")).size(), 2U);
  EXPECT_TRUE(atlas.glyphsOf(written("")).empty());
}

TEST(GlyphAtlas, glyphsDoNotShareAPixel) {
  GlyphAtlas atlas;
  std::vector<AtlasGlyph> all;
  for (const double size : {12.0, 60.0, 31.0}) {
    for (const AtlasGlyph& glyph :
         atlas.glyphsOf(written("The quick brown fox jumps 0123456789 äöü", size))) {
      all.push_back(glyph);
    }
  }
  for (const AtlasGlyph& a : all) {
    EXPECT_LE(a.column + a.width, GlyphAtlas::kWidth);
    EXPECT_LE(a.row + a.height, atlas.height());
    for (const AtlasGlyph& b : all) {
      const bool same = a.column == b.column && a.row == b.row;
      const bool apart = a.column + a.width <= b.column || b.column + b.width <= a.column ||
                         a.row + a.height <= b.row || b.row + b.height <= a.row;
      EXPECT_TRUE(same || apart);
    }
  }
}

TEST(GlyphAtlas, startsAnewWhenItIsTooHigh) {
  GlyphAtlas atlas;
  const std::vector<AtlasGlyph> before = atlas.glyphsOf(written("abc", 40));
  atlas.keepBelow(atlas.height());
  EXPECT_GT(atlas.height(), 0);
  atlas.keepBelow(atlas.height() - 1);
  EXPECT_EQ(atlas.height(), 0);
  EXPECT_EQ(atlas.glyphsOf(written("abc", 40)).size(), before.size());
}

}  // namespace
}  // namespace careen
