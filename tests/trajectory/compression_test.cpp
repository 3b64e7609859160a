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
