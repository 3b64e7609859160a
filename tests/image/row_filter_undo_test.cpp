#include "image/row_filter_undo.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <random>
#include <vector>

namespace careen {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// As the PNG specification has it, 9.2.
int predictionOf(int type, int a, int b, int c) {
  switch (type) {
    case 1:
      return a;
    case 2:
      return b;
    case 3:
      return (a + b) / 2;
    case 4: {
      const int p = a + b - c;
      const int pa = std::abs(p - a);
      const int pb = std::abs(p - b);
      const int pc = std::abs(p - c);
      return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
    }
    default:
      return 0;
  }
}

/// Rows as they are and as their filters leave them, each behind its type.
struct FilteredRows {
  Bytes plain;
  Bytes filtered;
};

FilteredRows filtered(const std::vector<int>& types, std::size_t rowBytes, std::size_t pixel,
                      std::mt19937& random) {
  FilteredRows picture;
  Bytes above(rowBytes);
  for (const int type : types) {
    Bytes row(rowBytes);
    for (std::uint8_t& byte : row) {
      byte = static_cast<std::uint8_t>(random());
    }
    picture.plain.push_back(static_cast<std::uint8_t>(type));
    picture.filtered.push_back(static_cast<std::uint8_t>(type));
    for (std::size_t i = 0; i < rowBytes; ++i) {
      const int left = i < pixel ? 0 : row[i - pixel];
      const int aboveLeft = i < pixel ? 0 : above[i - pixel];
      picture.plain.push_back(row[i]);
      picture.filtered.push_back(
          static_cast<std::uint8_t>(row[i] - predictionOf(type, left, above[i], aboveLeft)));
    }
    above = row;
  }
  return picture;
}

constexpr std::size_t kPixels[] = {1, 2, 3, 4, 6, 8};

// Two rows of Paeth's in turn are undone side by side: runs of one, two and three of them occur.
TEST(RowFilterUndo, bringsBackRowsOfAnyTypeOneAfterAnother) {
  std::mt19937 random(7);
  for (const std::size_t pixel : kPixels) {
    for (std::size_t width = 1; width <= 40; ++width) {
      std::vector<int> types = {4, 4, 0, 4, 1, 4, 4, 4, 2, 3, 4, 4};
      for (int k = 0; k < 12; ++k) {
        types.push_back(static_cast<int>(random() % 5));
      }
      FilteredRows picture = filtered(types, width * pixel, pixel, random);
      EXPECT_EQ(undoFilters(picture.filtered, width * pixel, pixel), std::nullopt);
      EXPECT_EQ(picture.filtered, picture.plain) << pixel << " bytes, width " << width;
    }
  }
}

// All neighbours a, b, c there are of one channel, in steps of 5: ties of Paeth's among them.
TEST(RowFilterUndo, choosesAmongPaethsNeighboursAsTheSpecificationDoes) {
  for (int a = 0; a < 256; a += 5) {
    for (int b = 0; b < 256; b += 5) {
      for (int c = 0; c < 256; c += 5) {
        // Row above: c b. Row below: a, then a zero that becomes the prediction.
        Bytes rows = {0, static_cast<std::uint8_t>(c),     static_cast<std::uint8_t>(b),
                      4, static_cast<std::uint8_t>(a - c), 0};
        ASSERT_EQ(undoFilters(rows, 2, 1), std::nullopt);
        ASSERT_EQ(rows[4], a);
        ASSERT_EQ(rows[5], predictionOf(4, a, b, c)) << a << ' ' << b << ' ' << c;
      }
    }
  }
}

TEST(RowFilterUndo, tellsATypeThatThereIsNot) {
  for (const std::size_t pixel : kPixels) {
    for (const int type : {5, 6, 255}) {
      Bytes rows(3 * (2 * pixel + 1));
      rows[2 * pixel + 1] = static_cast<std::uint8_t>(type);
      EXPECT_EQ(undoFilters(rows, 2 * pixel, pixel), type);
    }
  }
}

TEST(RowFilterUndo, hasNothingToDoForNoRows) { EXPECT_EQ(undoFilters({}, 12, 3), std::nullopt); }

}  // namespace
}  // namespace careen
