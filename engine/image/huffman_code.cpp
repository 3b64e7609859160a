#include "image/huffman_code.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace careen {
namespace {

constexpr std::size_t kMostSymbols = 288;  // RFC 1951, 3.2.5
constexpr std::size_t kMostBits = 15;      // RFC 1951, 3.2.7

/// A symbol and its count; ordered by count.
class Leaf {
 public:
  Leaf() = default;
  Leaf(std::uint32_t count, std::uint32_t symbol) : both_(std::uint64_t{count} << 32U | symbol) {}
  std::uint64_t count() const { return both_ >> 32U; }
  std::uint32_t symbol() const { return static_cast<std::uint32_t>(both_); }
  bool operator<(Leaf other) const { return both_ < other.both_; }

 private:
  std::uint64_t both_ = 0;
};

// Counts the leaves at each depth of the Huffman tree, from leaves sorted by count: repeatedly merge the two
// nodes with the smallest counts. New nodes are created in order of count, so the smallest is either the
// first remaining leaf or the first remaining node. Leaves deeper than `longest` are counted at `longest`.
void countDepths(std::span<const Leaf> leaves, std::size_t longest, std::span<std::uint32_t> atDepth) {
  struct Node {
    std::uint64_t count;
    std::size_t parent;
  };
  std::array<Node, kMostSymbols> nodes;
  std::array<std::size_t, kMostSymbols> parentOfLeaf;
  const std::size_t joined = leaves.size() - 1;
  std::size_t leaf = 0;
  std::size_t node = 0;
  for (std::size_t made = 0; made < joined; ++made) {
    nodes[made].count = 0;
    for (int child = 0; child < 2; ++child) {
      if (leaf < leaves.size() && (node == made || leaves[leaf].count() <= nodes[node].count)) {
        nodes[made].count += leaves[leaf].count();
        parentOfLeaf[leaf++] = made;
      } else {
        nodes[made].count += nodes[node].count;
        nodes[node++].parent = made;
      }
    }
  }
  std::array<std::size_t, kMostSymbols> depths;
  depths[joined - 1] = 0;
  for (std::size_t i = joined - 1; i-- > 0;) {
    depths[i] = depths[nodes[i].parent] + 1;
  }
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    ++atDepth[std::min(depths[parentOfLeaf[i]] + 1, longest)];
  }
}

// After clipping to `longest`, the leaves may exceed the room of a code. Each step frees one place: a leaf of
// the next shorter length in use moves down by one and takes one of the longest with it.
void makeRoom(std::size_t longest, std::span<std::uint32_t> atDepth) {
  std::size_t taken = 0;
  for (std::size_t depth = 1; depth <= longest; ++depth) {
    taken += std::size_t{atDepth[depth]} << (longest - depth);
  }
  for (; taken > std::size_t{1} << longest; --taken) {
    std::size_t depth = longest - 1;
    while (atDepth[depth] == 0) {
      --depth;
    }
    --atDepth[depth];
    atDepth[depth + 1] += 2;
    --atDepth[longest];
  }
}

// Reverses 16 bits: swaps the halves, then the halves of these, and so on.
std::uint32_t reversed(std::uint32_t bits) {
  bits = (bits & 0xffU) << 8U | bits >> 8U;
  bits = (bits & 0x0f0fU) << 4U | (bits & 0xf0f0U) >> 4U;
  bits = (bits & 0x3333U) << 2U | (bits & 0xccccU) >> 2U;
  return (bits & 0x5555U) << 1U | (bits & 0xaaaaU) >> 1U;
}

}  // namespace

void findCodeLengths(std::span<const std::uint32_t> counts, int longest, std::span<std::uint8_t> lengths) {
  std::array<Leaf, kMostSymbols> all;
  std::size_t used = 0;
  for (std::uint32_t symbol = 0; symbol < counts.size(); ++symbol) {
    if (counts[symbol] != 0) {
      all[used++] = Leaf(counts[symbol], symbol);
    }
  }
  for (std::uint32_t symbol = 0; used < 2; ++symbol) {
    if (counts[symbol] == 0) {
      all[used++] = Leaf(0, symbol);
    }
  }
  const std::span leaves(all.data(), used);
  std::sort(leaves.begin(), leaves.end());
  std::array<std::uint32_t, kMostBits + 1> atDepth{};
  const auto deepest = static_cast<std::size_t>(longest);
  countDepths(leaves, deepest, atDepth);
  makeRoom(deepest, atDepth);
  std::fill(lengths.begin(), lengths.end(), std::uint8_t{0});
  std::size_t leaf = 0;
  for (std::size_t depth = deepest; depth > 0; --depth) {
    for (std::uint32_t i = 0; i < atDepth[depth]; ++i) {
      lengths[leaves[leaf++].symbol()] = static_cast<std::uint8_t>(depth);
    }
  }
}

void findCodes(std::span<const std::uint8_t> lengths, std::span<std::uint16_t> codes) {
  // At first next[n + 1] counts the codes of n bits, then next[n] is the next code of n bits.
  std::array<std::uint32_t, kMostBits + 2> next{};
  for (const std::uint8_t length : lengths) {
    next[length + std::size_t{1}] += length == 0 ? 0 : 1;
  }
  for (std::size_t bits = 1; bits < next.size(); ++bits) {
    next[bits] = (next[bits] + next[bits - 1]) << 1U;
  }
  for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
    const std::uint32_t code = lengths[symbol] == 0 ? 0 : next[lengths[symbol]]++;
    codes[symbol] = static_cast<std::uint16_t>(reversed(code) >> (16U - lengths[symbol]));
  }
}

}  // namespace careen
