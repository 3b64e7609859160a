#include "core/hash.h"

#include <limits>

#include <gtest/gtest.h>

namespace careen {
namespace {

template <class Value>
std::uint64_t hashOf(Value value) {
  Hash hash;
  hash.add(value);
  return hash.value();
}

// Test values published with the algorithm.
TEST(Hash, isFnv1aWith64Bits) {
  EXPECT_EQ(Hash().value(), 0xcbf29ce484222325U);
  EXPECT_EQ(hashOf(std::string_view("a")), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(hashOf(std::string_view("foobar")), 0x85944171f73967e8U);
}

TEST(Hash, takesBytesAsUnsigned) {
  // By hand: (offset ^ 0xff) · prime; a signed char would flip all upper bits first.
  EXPECT_EQ(hashOf(std::string_view("\xff")), (0xcbf29ce484222325U ^ 0xffU) * 0x100000001b3U);
}

TEST(Hash, doesNotCareHowBytesArePortioned) {
  Hash parts;
  parts.add(std::string_view("foo"));
  parts.add(std::string_view("bar"));
  EXPECT_EQ(parts.value(), hashOf(std::string_view("foobar")));
}

TEST(Hash, readsANumberFromItsLowestByteUp) {
  EXPECT_EQ(hashOf(std::uint64_t{0x7261626f6f66}), hashOf(std::string_view("foobar\0\0", 8)));
}

TEST(Hash, tellsDoublesApartByTheirBits) {
  EXPECT_EQ(hashOf(1.0), hashOf(std::uint64_t{0x3ff0000000000000}));
  EXPECT_NE(hashOf(0.0), hashOf(-0.0));
  EXPECT_NE(hashOf(1.0), hashOf(1.0 + std::numeric_limits<double>::epsilon()));
}

TEST(Hash, hasSixteenDigits) {
  EXPECT_EQ(Hash().text(), "cbf29ce484222325");
  Hash foobar;
  foobar.add(std::string_view("foobar"));
  EXPECT_EQ(foobar.text(), "85944171f73967e8");
}

// One value in 16 begins with a zero.
TEST(Hash, keepsLeadingZeros) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    Hash hash;
    hash.add(i);
    ASSERT_EQ(hash.text().size(), 16U);
    ASSERT_EQ(std::stoull(hash.text(), nullptr, 16), hash.value());
  }
}

}  // namespace
}  // namespace careen
