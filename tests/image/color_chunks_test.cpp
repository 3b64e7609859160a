#include "image/color_chunks.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "core/hash.h"
#include "support/png_by_hand.h"

namespace careen {
namespace {

std::string numbers(std::initializer_list<std::uint32_t> values) {
  std::string bytes;
  for (const std::uint32_t value : values) {
    bytes += bigEndianBytes(value);
  }
  return bytes;
}

TEST(ColorChunks, withoutAnyOrWithWhatSrgbIsItIsSrgb) {
  EXPECT_EQ(colorSpaceOf({}), "sRGB");
  EXPECT_EQ(colorSpaceOf({.srgb = "\1"}), "sRGB");
  // What ImageMagick writes.
  const std::string gamma = numbers({45455});
  const std::string primaries = numbers({31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000});
  EXPECT_EQ(colorSpaceOf({.gamma = gamma, .chromaticities = primaries}), "sRGB");
  EXPECT_EQ(colorSpaceOf({.codePoints = std::string_view("\x01\x0d\x00\x01", 4)}), "sRGB");
}

TEST(ColorChunks, gammaAndPrimariesAreTold) {
  const std::string linear = numbers({100000});
  const std::string apple = numbers({55556});  // 1/1.8
  // Rec. 2020.
  const std::string wide = numbers({31270, 32900, 70800, 29200, 17000, 79700, 13100, 4600});
  EXPECT_EQ(colorSpaceOf({.gamma = linear}), "gamma 1/1");
  EXPECT_EQ(colorSpaceOf({.gamma = apple}), "gamma 1/1.8");
  const std::string words = "white and primaries 0.3127 0.329 0.708 0.292 0.17 0.797 0.131 0.046";
  EXPECT_EQ(colorSpaceOf({.chromaticities = wide}), words);
  EXPECT_EQ(colorSpaceOf({.gamma = apple, .chromaticities = wide}), "gamma 1/1.8, " + words);
  EXPECT_EQ(colorSpaceOf({.srgb = "\0", .gamma = linear, .chromaticities = wide}), "sRGB");
}

TEST(ColorChunks, profileIsToldByItsBytesHoweverTheyArePacked) {
  Hash hash;
  hash.add(std::string_view("profile"));
  const std::string head("Display P3\0\0", 12);
  const std::string packed = head + zlibStream("profile");
  // RFC 1950 and 1951: the same, stored as it is.
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const unsigned char each : std::string("profile")) {
    a = (a + each) % 65521;
    b = (b + a) % 65521;
  }
  const std::string stored =
      head + std::string("\x78\x01\x01\x07\x00\xf8\xff", 7) + "profile" + bigEndianBytes(b << 16U | a);
  EXPECT_EQ(colorSpaceOf({.profile = packed}), "ICC profile 'Display P3' " + hash.text());
  EXPECT_EQ(colorSpaceOf({.profile = stored}), "ICC profile 'Display P3' " + hash.text());
  const std::string other = head + zlibStream("another");
  EXPECT_NE(colorSpaceOf({.profile = other}), colorSpaceOf({.profile = packed}));
  const std::string damaged = head + "no stream";
  EXPECT_TRUE(colorSpaceOf({.profile = damaged}).starts_with("ICC profile 'Display P3' "));
}

TEST(ColorChunks, brokenOnesDoNotCount) {
  EXPECT_EQ(colorSpaceOf({.codePoints = "\1"}), "sRGB");
  EXPECT_EQ(colorSpaceOf({.profile = "no end"}), "sRGB");
  const std::string zero = numbers({0});
  EXPECT_EQ(colorSpaceOf({.gamma = zero}), "sRGB");
  EXPECT_EQ(colorSpaceOf({.gamma = "\1", .chromaticities = "\1"}), "sRGB");
}

}  // namespace
}  // namespace careen
