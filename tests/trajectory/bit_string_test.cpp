#include "trajectory/bit_string.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace careen {
namespace {

// 1, then 01, then eight ones, from the lowest bit on: 1111 1101, 0000 0111.
TEST(BitString, beginsAtTheLowestBit) {
  BitWriter writer;
  writer.put(1, 1);
  writer.put(0b10, 2);
  writer.put(0xff, 8);
  EXPECT_EQ(writer.bytes(), "\xfd\x07");
}

TEST(BitString, bringsBackNumbersOfEveryWidth) {
  const auto number = [](int width) {  // of so many ones, less some of them
    return width == 0 ? 0 : (~std::uint64_t{0} >> (64 - width)) & ~(std::uint64_t{0x10} >> (width % 5));
  };
  BitWriter writer;
  for (int width = 0; width <= 64; ++width) {
    writer.put(number(width), width);
  }
  const std::string bytes = writer.bytes();
  EXPECT_EQ(bytes.size(), 64 * 65 / 2 / 8);
  BitReader reader(bytes);
  for (int width = 0; width <= 64; ++width) {
    EXPECT_FALSE(reader.atEnd() && width < 64);
    EXPECT_EQ(reader.get(width), number(width)) << width;
  }
  EXPECT_TRUE(reader.atEnd());
  EXPECT_FALSE(reader.isBeyond());
}

TEST(BitString, isZeroBeyondItsEnd) {
  BitReader reader("\xff");
  EXPECT_EQ(reader.get(12), 0xffU);
  EXPECT_TRUE(reader.isBeyond());
  EXPECT_EQ(reader.get(64), 0U);
}

}  // namespace
}  // namespace careen
