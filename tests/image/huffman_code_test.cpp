#include "image/huffman_code.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <queue>
#include <random>
#include <vector>

namespace careen {
namespace {

std::vector<std::uint8_t> lengthsOf(const std::vector<std::uint32_t>& counts, int longest) {
  std::vector<std::uint8_t> lengths(counts.size(), 99);
  findCodeLengths(counts, longest, lengths);
  return lengths;
}

/// The Kraft sum: 1 for a complete code, in which every bit sequence decodes.
double shareTaken(const std::vector<std::uint8_t>& lengths) {
  double taken = 0;
  for (const std::uint8_t length : lengths) {
    taken += length == 0 ? 0 : 1.0 / static_cast<double>(1U << length);
  }
  return taken;
}

std::uint64_t bitsSent(const std::vector<std::uint32_t>& counts, const std::vector<std::uint8_t>& lengths) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    bits += std::uint64_t{counts[i]} * lengths[i];
  }
  return bits;
}

/// Huffman's theorem: the minimum is the sum of all nodes above the leaves.
std::uint64_t leastBits(const std::vector<std::uint32_t>& counts) {
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> nodes;
  for (const std::uint32_t count : counts) {
    if (count != 0) {
      nodes.push(count);
    }
  }
  std::uint64_t bits = 0;
  while (nodes.size() > 1) {
    std::uint64_t both = nodes.top();
    nodes.pop();
    both += nodes.top();
    nodes.pop();
    bits += both;
    nodes.push(both);
  }
  return bits;
}

TEST(HuffmanCode, sendsInAsFewBitsAsThereCanBe) {
  std::mt19937 random(3);
  for (int run = 0; run < 300; ++run) {
    std::vector<std::uint32_t> counts(2 + random() % 285);
    for (std::uint32_t& count : counts) {
      count = static_cast<std::uint32_t>(random() % 3 == 0 ? 0 : 1 + random() % (1U << (random() % 8)));
    }
    counts[0] = 1;
    counts[1] = 5;
    const std::vector<std::uint8_t> lengths = lengthsOf(counts, 15);
    ASSERT_EQ(bitsSent(counts, lengths), leastBits(counts)) << run;
    ASSERT_EQ(shareTaken(lengths), 1) << run;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      ASSERT_EQ(lengths[i] == 0, counts[i] == 0) << run << ' ' << i;
    }
  }
}

// Fibonacci numbers as counts give the deepest possible tree.
TEST(HuffmanCode, isCutToTheLongestLengthAndStaysComplete) {
  std::vector<std::uint32_t> counts = {1, 1};
  while (counts.size() < 40) {
    counts.push_back(counts[counts.size() - 1] + counts[counts.size() - 2]);
  }
  for (const int longest : {6, 7, 12, 15}) {
    const std::vector<std::uint8_t> lengths = lengthsOf(counts, longest);
    EXPECT_EQ(*std::max_element(lengths.begin(), lengths.end()), longest);
    EXPECT_EQ(shareTaken(lengths), 1) << longest;
    EXPECT_TRUE(std::is_sorted(lengths.rbegin(), lengths.rend())) << longest;
  }
}

TEST(HuffmanCode, ofAsManySymbolsAsFitIsFlat) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t i = 0; i < 128; ++i) {
    counts.push_back(1U << (i / 5));
  }
  EXPECT_EQ(lengthsOf(counts, 7), std::vector<std::uint8_t>(128, 7));
}

TEST(HuffmanCode, aSingleSymbolIsPairedWithAnUnusedOne) {
  EXPECT_EQ(lengthsOf({0, 0, 9, 0}, 7), (std::vector<std::uint8_t>{1, 0, 1, 0}));
  EXPECT_EQ(lengthsOf({9, 0, 0, 0}, 7), (std::vector<std::uint8_t>{1, 1, 0, 0}));
}

// RFC 1951, 3.2.2: the codes of A to H are 010 011 100 101 110 00 1110 1111.
TEST(HuffmanCode, codesAreThoseOfTheSpecificationFirstBitLowest) {
  const std::array<std::uint8_t, 9> lengths = {3, 3, 3, 3, 3, 2, 4, 4, 0};
  std::array<std::uint16_t, 9> codes{};
  findCodes(lengths, codes);
  EXPECT_EQ(codes,
            (std::array<std::uint16_t, 9>{0b010, 0b110, 0b001, 0b101, 0b011, 0b00, 0b0111, 0b1111, 0}));
}

}  // namespace
}  // namespace careen
