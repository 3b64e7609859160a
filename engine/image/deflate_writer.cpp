#include "image/deflate_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "image/huffman_code.h"

namespace careen {
namespace {

// Tokens: a literal byte; the end of the block; 256 + n for a run of n copies of the previous byte.
constexpr std::size_t kEnd = 256;
constexpr std::size_t kShortestRun = 3;
constexpr std::size_t kLongestRun = 258;
constexpr std::size_t kTokens = kEnd + kLongestRun + 1;

constexpr std::size_t kWord = 8;            // [byte] compared and written at once
constexpr std::size_t kMostLiterals = 286;  // literals, end of block and length codes
constexpr std::size_t kMostPrecodes = 19;
constexpr int kLongestCode = 12;
// Three tokens and the bits of an unfinished byte fit a word: a run has a code, at most 5 extra bits, and a
// distance code.
static_assert(7 + 3 * (kLongestCode + 5 + 1) < 64);
constexpr int kLongestPrecode = 7;       // RFC 1951, 3.2.7: three bits hold it
constexpr std::size_t kStored = 0xffff;  // [byte] of one stored block

// Converts to and from the byte order of the stream, lowest byte first.
constexpr std::uint64_t inStreamOrder(std::uint64_t word) {
  if constexpr (std::endian::native == std::endian::little) {
    return word;
  }
  std::uint64_t reversed = 0;
  for (std::size_t i = 0; i < kWord; ++i, word >>= 8U) {
    reversed = reversed << 8U | (word & 0xffU);
  }
  return reversed;
}

std::uint64_t loadWord(const std::uint8_t* bytes) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, kWord);
  return inStreamOrder(word);
}

void storeWord(std::uint64_t word, std::uint8_t* bytes) {
  word = inStreamOrder(word);
  std::memcpy(bytes, &word, kWord);
}

/// The code of a run length, RFC 1951, 3.2.5: each group of four codes has one more extra bit, except that
/// the first eight codes have none and 258 has its own.
struct RunCode {
  std::uint16_t symbol;
  std::uint8_t extraBits;
  std::uint8_t extra;
};

constexpr std::array<RunCode, kLongestRun + 1> runCodes() {
  std::array<RunCode, kLongestRun + 1> codes{};
  for (std::size_t length = kShortestRun; length < kLongestRun; ++length) {
    const std::size_t offset = length - kShortestRun;
    const std::size_t extraBits = offset < 8 ? 0 : std::bit_width(offset >> 3U);
    codes[length] = {.symbol = static_cast<std::uint16_t>(257 + 4 * extraBits + (offset >> extraBits)),
                     .extraBits = static_cast<std::uint8_t>(extraBits),
                     .extra = static_cast<std::uint8_t>(offset & ((1U << extraBits) - 1))};
  }
  codes[kLongestRun] = {.symbol = 285, .extraBits = 0, .extra = 0};
  return codes;
}
constexpr std::array<RunCode, kLongestRun + 1> kRunCodes = runCodes();

std::uint16_t* addRun(std::uint8_t value, std::size_t length, std::uint16_t* token) {
  for (; length > kLongestRun; length -= kLongestRun) {
    *token++ = kEnd + kLongestRun;
  }
  if (length >= kShortestRun) {
    *token++ = static_cast<std::uint16_t>(kEnd + length);
    return token;
  }
  return std::fill_n(token, length, value);
}

// Finds runs of at least eight bytes, a word at a time; shorter ones would save 1.5 % of a frame at most.
// `tokens` has room for one per byte, the end and one more word; the function returns their number.
std::size_t findTokens(std::span<const std::uint8_t> bytes, std::uint16_t* tokens) {
  std::uint16_t* token = tokens;
  const std::uint8_t* next = bytes.data();
  const std::uint8_t* const end = next + bytes.size();
  const auto wordIsLeft = [end](const std::uint8_t* place) {
    return static_cast<std::size_t>(end - place) >= kWord;
  };
  const auto changes = [](const std::uint8_t* place) { return loadWord(place) ^ loadWord(place - 1); };
  if (next != end) {
    *token++ = *next++;
  }
  while (wordIsLeft(next)) {
    if (const std::uint64_t changed = changes(next); changed != 0) {
      // Copy up to the last byte that differs; what follows it may be a run.
      std::copy_n(next, kWord, token);
      const auto literals = kWord - static_cast<std::size_t>(std::countl_zero(changed)) / 8;
      token += literals;
      next += literals;
      continue;
    }
    const std::uint8_t* const begun = next;
    for (next += kWord; wordIsLeft(next); next += kWord) {
      if (const std::uint64_t changed = changes(next); changed != 0) {
        next += static_cast<std::size_t>(std::countr_zero(changed)) / 8;
        break;
      }
    }
    token = addRun(*begun, static_cast<std::size_t>(next - begun), token);
  }
  token = std::copy(next, end, token);
  *token++ = kEnd;
  return static_cast<std::size_t>(token - tokens);
}

using TokenCounts = std::array<std::uint32_t, kTokens>;

// Four sets of counters, because reading one that was just written is slow.
TokenCounts countTokens(std::span<const std::uint16_t> tokens) {
  std::array<TokenCounts, 4> counts{};
  std::size_t i = 0;
  for (; i + 4 <= tokens.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      ++counts[k][tokens[i + k]];
    }
  }
  for (; i < tokens.size(); ++i) {
    ++counts[0][tokens[i]];
  }
  for (std::size_t token = 0; token < kTokens; ++token) {
    counts[0][token] += counts[1][token] + counts[2][token] + counts[3][token];
  }
  return counts[0];
}

/// The bits of a token in the stream, lowest first.
struct Bits {
  std::uint32_t value = 0;
  std::uint32_t count = 0;
};

/// The header of a block: the code lengths, RFC 1951, 3.2.7.
struct Head {
  std::array<Bits, 4 + kMostPrecodes + 2 * (kMostLiterals + 1)> bits;
  std::size_t used = 0;

  void add(std::uint32_t value, std::uint32_t count) { bits[used++] = {.value = value, .count = count}; }
};

/// A code length, or a repetition of one, as encoded in the header.
struct HeadSymbol {
  std::uint8_t symbol;
  std::uint8_t extraBits;
  std::uint8_t extra;
};

// 16: repeat the previous one 3 to 6 times; 17: 3 to 10 zeros; 18: 11 to 138 zeros.
std::size_t findHeadSymbols(std::span<const std::uint8_t> lengths, HeadSymbol* symbols) {
  const HeadSymbol* const begun = symbols;
  for (std::size_t i = 0; i < lengths.size();) {
    const std::uint8_t length = lengths[i];
    std::size_t same = 1;
    while (i + same < lengths.size() && lengths[i + same] == length) {
      ++same;
    }
    i += same;
    if (length != 0) {
      *symbols++ = {.symbol = length, .extraBits = 0, .extra = 0};
      --same;
    }
    while (same >= 3) {
      const bool many = length == 0 && same > 10;
      const std::size_t least = many ? 11 : 3;
      const std::size_t count = std::min<std::size_t>(same, many ? 138 : (length == 0 ? 10 : 6));
      *symbols++ = {.symbol = static_cast<std::uint8_t>(many ? 18 : (length == 0 ? 17 : 16)),
                    .extraBits = static_cast<std::uint8_t>(many ? 7 : (length == 0 ? 3 : 2)),
                    .extra = static_cast<std::uint8_t>(count - least)};
      same -= count;
    }
    symbols = std::fill_n(symbols, same, HeadSymbol{.symbol = length, .extraBits = 0, .extra = 0});
  }
  return static_cast<std::size_t>(symbols - begun);
}

// `lengths`: of the literal codes, then of the single distance code.
Head makeHead(std::span<const std::uint8_t> lengths, bool last) {
  constexpr std::array<std::uint8_t, kMostPrecodes> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                              11, 4,  12, 3, 13, 2, 14, 1, 15};
  std::array<HeadSymbol, kMostLiterals + 1> symbols;
  const std::size_t used = findHeadSymbols(lengths, symbols.data());
  std::array<std::uint32_t, kMostPrecodes> counts{};
  for (std::size_t i = 0; i < used; ++i) {
    ++counts[symbols[i].symbol];
  }
  std::array<std::uint8_t, kMostPrecodes> precodeLengths;
  std::array<std::uint16_t, kMostPrecodes> precodes;
  findCodeLengths(counts, kLongestPrecode, precodeLengths);
  findCodes(precodeLengths, precodes);
  std::uint32_t listed = kMostPrecodes;
  while (precodeLengths[kOrder[listed - 1]] == 0) {
    --listed;
  }
  Head head;
  head.add((last ? 1U : 0U) | 2U << 1U, 3);                           // BFINAL, BTYPE: dynamic Huffman codes
  head.add(static_cast<std::uint32_t>(lengths.size() - 1 - 257), 5);  // HLIT
  head.add(0, 5);                                                     // HDIST: one code
  head.add(listed - 4, 4);                                            // HCLEN
  for (std::uint32_t i = 0; i < listed; ++i) {
    head.add(precodeLengths[kOrder[i]], 3);
  }
  for (std::size_t i = 0; i < used; ++i) {
    head.add(precodes[symbols[i].symbol], precodeLengths[symbols[i].symbol]);
    head.add(symbols[i].extra, symbols[i].extraBits);
  }
  return head;
}

using Codes = std::array<Bits, kTokens>;

struct Block {
  Codes codes;
  Head head;
  std::size_t bits = 0;  // header and tokens
};

Block planBlock(const TokenCounts& tokens, bool last) {
  std::array<std::uint32_t, kMostLiterals> counts{};
  std::copy_n(tokens.begin(), kEnd + 1, counts.begin());
  for (std::size_t length = kShortestRun; length <= kLongestRun; ++length) {
    counts[kRunCodes[length].symbol] += tokens[kEnd + length];
  }
  std::array<std::uint8_t, kMostLiterals + 1> lengths;
  std::array<std::uint16_t, kMostLiterals> codes;
  const std::span literalLengths(lengths.data(), kMostLiterals);
  findCodeLengths(counts, kLongestCode, literalLengths);
  findCodes(literalLengths, codes);

  Block block;
  for (std::size_t token = 0; token <= kEnd; ++token) {
    block.codes[token] = {.value = codes[token], .count = lengths[token]};
  }
  for (std::size_t length = kShortestRun; length <= kLongestRun; ++length) {
    const RunCode& run = kRunCodes[length];
    const std::uint32_t bits = lengths[run.symbol];
    // The single distance code is the bit 0.
    block.codes[kEnd + length] = {.value = codes[run.symbol] | std::uint32_t{run.extra} << bits,
                                  .count = bits + run.extraBits + 1};
  }
  std::size_t listed = kMostLiterals;
  while (lengths[listed - 1] == 0) {
    --listed;
  }
  lengths[listed] = 1;
  block.head = makeHead({lengths.data(), listed + 1}, last);
  for (std::size_t i = 0; i < block.head.used; ++i) {
    block.bits += block.head.bits[i].count;
  }
  for (std::size_t token = 0; token < kTokens; ++token) {
    block.bits += std::size_t{tokens[token]} * block.codes[token].count;
  }
  return block;
}

/// Writes bits as bytes, a word at a time: it writes up to one word beyond the bytes in use.
class BitSink {
 public:
  BitSink(std::uint8_t* out, std::uint64_t bits, unsigned count) : out_(out), bits_(bits), count_(count) {}

  void add(const Bits& bits) {
    bits_ |= std::uint64_t{bits.value} << count_;
    count_ += bits.count;
  }
  /// Must be called before the buffer holds 64 bits.
  void flush() {
    storeWord(bits_, out_);
    out_ += count_ / 8;
    bits_ >>= count_ & ~7U;
    count_ &= 7U;
  }
  std::uint64_t bits() const { return bits_; }
  unsigned count() const { return count_; }

 private:
  std::uint8_t* out_;
  std::uint64_t bits_;
  unsigned count_;
};

void send(const Head& head, BitSink& sink) {
  for (std::size_t i = 0; i < head.used; ++i) {
    sink.add(head.bits[i]);
    sink.flush();
  }
}

void send(std::span<const std::uint16_t> tokens, const Codes& codes, BitSink& sinkOut) {
  BitSink sink = sinkOut;  // a local copy stays in registers
  std::size_t i = 0;
  for (; i + 3 <= tokens.size(); i += 3) {
    sink.add(codes[tokens[i]]);
    sink.add(codes[tokens[i + 1]]);
    sink.add(codes[tokens[i + 2]]);
    sink.flush();
  }
  for (; i < tokens.size(); ++i) {
    sink.add(codes[tokens[i]]);
    sink.flush();
  }
  sinkOut = sink;
}

}  // namespace

void DeflateWriter::write(std::span<const std::uint8_t> bytes, bool last) {
  if (const std::size_t room = bytes.size() + 1 + kWord; room > tokens_.size()) {
    tokens_.resize(room);
  }
  const std::span tokens(tokens_.data(), findTokens(bytes, tokens_.data()));
  const Block block = planBlock(countTokens(tokens), last);
  if (block.bits / 8 > bytes.size()) {
    store(bytes, last);
    return;
  }
  const std::size_t before = out_->size();
  const std::size_t bits = pendingBits_ + block.bits;
  out_->resize(before + bits / 8 + kWord);
  BitSink sink(reinterpret_cast<std::uint8_t*>(out_->data()) + before, pending_, pendingBits_);
  send(block.head, sink);
  send(tokens, block.codes, sink);
  const bool pads = last && sink.count() != 0;
  out_->resize(before + bits / 8 + (pads ? 1 : 0));
  pending_ = pads ? 0 : sink.bits();
  pendingBits_ = pads ? 0 : sink.count();
}

// RFC 1951, 3.2.4: aligned to a byte, the size, its complement, and the bytes as they are.
void DeflateWriter::store(std::span<const std::uint8_t> bytes, bool last) {
  do {
    const std::span piece = bytes.first(std::min(bytes.size(), kStored));
    bytes = bytes.subspan(piece.size());
    const bool ends = last && bytes.empty();
    const std::uint64_t begin = pending_ | (ends ? 1U : 0U) << pendingBits_;
    out_->push_back(static_cast<char>(begin));
    if (pendingBits_ + 3 > 8) {
      out_->push_back(0);
    }
    pending_ = 0;
    pendingBits_ = 0;
    for (const std::size_t size : {piece.size(), kStored - piece.size()}) {
      out_->push_back(static_cast<char>(size & 0xffU));
      out_->push_back(static_cast<char>(size >> 8U));
    }
    out_->append(reinterpret_cast<const char*>(piece.data()), piece.size());
  } while (!bytes.empty());
}

}  // namespace careen
