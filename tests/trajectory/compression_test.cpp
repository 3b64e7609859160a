#include "trajectory/compression.h"

#include <gtest/gtest.h>

#include <string>

namespace careen {
namespace {

TEST(Compression, bringsBackEveryByte) {
  std::string bytes;
  for (unsigned i = 0; i < 100'000; ++i) {
    bytes.push_back(static_cast<char>(i * i >> 5U));
  }
  const std::string packed = compressed(bytes);
  EXPECT_LT(packed.size(), bytes.size());
  EXPECT_EQ(decompressed(packed, bytes.size()), bytes);
  EXPECT_EQ(decompressed(compressed(""), 0), "");
}

TEST(Compression, makesNoMoreThanSixtyFourBytesOfOne) {
  const std::string zeros(1'000'000, '\0');
  EXPECT_EQ(decompressed(compressed(zeros), zeros.size()), zeros);
  EXPECT_GE(compressed(zeros).size() * kMostRatio, zeros.size());
  // Ten thousand zeros by another compressor, 300 from each byte.
  constexpr std::string_view kBomb(
      "\x78\xda\xed\xc1\x01\x0d\x00\x00\x00\xc2\xa0\xf7\x4f\x6d\x0e\x37\xa0\x00\x00\x00"
      "\x00\x00\x00\x00\x00\x00\xe0\xdf\x00\x27\x10\x00\x01",
      33);
  EXPECT_EQ(decompressed(kBomb, 10'000), std::nullopt);
}

TEST(Compression, refusesWhatItDidNotMake) {
  const std::string packed = compressed("a box careens off a wall");
  EXPECT_EQ(decompressed(packed, 23), std::nullopt);
  EXPECT_EQ(decompressed(packed, 25), std::nullopt);
  EXPECT_EQ(decompressed(packed.substr(1), 24), std::nullopt);
  EXPECT_EQ(decompressed("", 24), std::nullopt);
  EXPECT_EQ(decompressed(packed, std::size_t{1} << 60U), std::nullopt);
}

}  // namespace
}  // namespace careen
