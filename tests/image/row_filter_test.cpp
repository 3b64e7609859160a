#include "image/row_filter.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <vector>

namespace careen {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// As in the PNG specification, 9.4.
int paethPredictor(int a, int b, int c) {
  const int p = a + b - c;
  const int pa = std::abs(p - a);
  const int pb = std::abs(p - b);
  const int pc = std::abs(p - c);
  if (pa <= pb && pa <= pc) {
    return a;
  }
  return pb <= pc ? b : c;
}

Bytes bySpecification(const Bytes& row, const Bytes& above, std::size_t pixelBytes) {
  Bytes difference;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int left = i < pixelBytes ? 0 : row[i - pixelBytes];
    const int aboveLeft = i < pixelBytes ? 0 : above[i - pixelBytes];
    difference.push_back(static_cast<std::uint8_t>(row[i] - paethPredictor(left, above[i], aboveLeft)));
  }
  return difference;
}

void expectAsSpecified(const Bytes& row, const Bytes& above, std::size_t pixelBytes = 3) {
  const Bytes expected = bySpecification(row, above, pixelBytes);
  Bytes chosen(row.size());
  Bytes plain(row.size());
  subtractPaeth(row, above, pixelBytes, chosen);
  subtractPaethBaseline(row, above, pixelBytes, plain);
  ASSERT_EQ(chosen, expected) << row.size() << " bytes";
  ASSERT_EQ(plain, expected) << row.size() << " bytes";
}

TEST(RowFilter, isThatOfTheSpecificationForAllNeighboursThereAre) {
  for (int left = 0; left < 256; ++left) {
    Bytes row;
    Bytes above;
    for (int aboveLeft = 0; aboveLeft < 256; ++aboveLeft) {
      for (int b = 0; b < 258; b += 3) {
        for (int channel = 0; channel < 3; ++channel) {
          row.push_back(static_cast<std::uint8_t>(left));
          above.push_back(static_cast<std::uint8_t>(aboveLeft));
        }
        for (int channel = 0; channel < 3; ++channel) {
          row.push_back(static_cast<std::uint8_t>(7 * b + aboveLeft));
          above.push_back(static_cast<std::uint8_t>(b + channel));
        }
      }
    }
    expectAsSpecified(row, above);
  }
}

TEST(RowFilter, isThatOfTheSpecificationForRowsOfAnyWidth) {
  std::mt19937 random(5);
  for (const std::size_t pixelBytes : {3U, 4U}) {
    for (std::size_t width = 0; width <= 70; ++width) {
      Bytes row(pixelBytes * width);
      Bytes above(row.size());
      for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = static_cast<std::uint8_t>(random());
        above[i] = static_cast<std::uint8_t>(random());
      }
      expectAsSpecified(row, above, pixelBytes);
      expectAsSpecified(row, Bytes(row.size()), pixelBytes);
    }
  }
}

}  // namespace
}  // namespace careen
