#include "image/deflate_writer.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

#include <algorithm>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace careen {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string compressed(const std::vector<Bytes>& pieces) {
  std::string out;
  DeflateWriter writer(out);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    writer.write(pieces[i], i + 1 == pieces.size());
  }
  return out;
}

/// Decodes with libdeflate, which rejects truncated streams and trailing bytes.
void expectLibdeflateReads(const std::string& stream, const Bytes& expected) {
  Bytes back(expected.size() + 1);
  std::size_t used = 0;
  std::size_t size = 0;
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> reader(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  ASSERT_EQ(libdeflate_deflate_decompress_ex(reader.get(), stream.data(), stream.size(), back.data(),
                                             back.size(), &used, &size),
            LIBDEFLATE_SUCCESS);
  back.resize(size);
  EXPECT_EQ(used, stream.size());
  EXPECT_TRUE(back == expected);
}

/// stb needs the four bytes of a checksum after the end; without them it stops earlier.
void expectStbReads(std::string stream, const Bytes& expected) {
  stream.append(4, '\0');
  Bytes back(expected.size() + 1);
  const int size =
      stbi_zlib_decode_noheader_buffer(reinterpret_cast<char*>(back.data()), static_cast<int>(back.size()),
                                       stream.data(), static_cast<int>(stream.size()));
  ASSERT_EQ(size, static_cast<int>(expected.size()));
  back.resize(expected.size());
  EXPECT_TRUE(back == expected);
}

std::size_t expectReadable(const std::vector<Bytes>& pieces) {
  const std::string stream = compressed(pieces);
  Bytes whole;
  std::size_t most = 0;
  for (const Bytes& piece : pieces) {
    whole.insert(whole.end(), piece.begin(), piece.end());
    most += piece.size() + 5 * std::max<std::size_t>(1, (piece.size() + 65534) / 65535);
  }
  expectLibdeflateReads(stream, whole);
  expectStbReads(stream, whole);
  EXPECT_LE(stream.size(), most);
  return stream.size();
}

Bytes noiseBytes(std::size_t size, unsigned seed, unsigned values = 256) {
  std::mt19937 random(seed);
  Bytes bytes(size);
  std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random() % values); });
  return bytes;
}

TEST(DeflateWriter, nothingIsReadAsNothing) {
  expectReadable({{}});
  expectReadable({{}, {}});
  expectReadable({{1, 2, 3}, {}});
}

TEST(DeflateWriter, runsOfEveryLengthAreReadBack) {
  Bytes bytes;
  for (std::size_t length = 1; length <= 800; ++length) {
    bytes.push_back(static_cast<std::uint8_t>(1 + length % 7));
    bytes.insert(bytes.end(), length, static_cast<std::uint8_t>(length % 3 == 0 ? 0 : 200));
  }
  EXPECT_LT(expectReadable({bytes}), 2300U);              // of 321,200; measured 2222
  for (std::size_t length = 1; length <= 40; ++length) {  // at both ends of a piece
    expectReadable({Bytes(length, 0), Bytes(length, 7)});
  }
}

TEST(DeflateWriter, aFlatPieceIsNearlyNothing) {
  EXPECT_LT(expectReadable({Bytes(262144, 9)}), 273U);  // measured 272
}

TEST(DeflateWriter, whatIsNoisyIsStoredAndGrowsByFiveBytesInSixtyFourThousand) {
  EXPECT_EQ(expectReadable({noiseBytes(65535, 1)}), 65535U + 5);
  EXPECT_EQ(expectReadable({noiseBytes(65536, 1)}), 65536U + 10);
  EXPECT_EQ(expectReadable({noiseBytes(200000, 1)}), 200000U + 20);
}

// Stored pieces start at a whole byte wherever the previous one ended.
TEST(DeflateWriter, piecesOfAllKindsFollowEachOther) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::vector<Bytes> pieces;
    for (unsigned i = 0; i < 6; ++i) {
      const unsigned values = 1U << (random() % 9);
      pieces.push_back(noiseBytes(random() % 300, seed * 6 + i, values));
    }
    expectReadable(pieces);
  }
}

// Of 16 values 15 get four bits and one gets five, because the end symbol needs a code as well.
TEST(DeflateWriter, isAsSmallAsTheCodesAllow) {
  const std::size_t size = expectReadable({noiseBytes(100000, 4, 16)});
  EXPECT_GE(size, 50000U);
  EXPECT_LT(size, 50800U);  // measured 50780; 50000 and an eighth of the 6250 of one value are 50781
}

// With Fibonacci numbers as counts, unlimited codes would have 23 bits.
TEST(DeflateWriter, codesThatHadToBeCutAreReadBack) {
  Bytes bytes;
  std::size_t count = 1;
  for (std::size_t value = 0, before = 0; value < 24; ++value) {
    bytes.insert(bytes.end(), count, static_cast<std::uint8_t>(value * 5));
    before = std::exchange(count, count + before);
  }
  std::shuffle(bytes.begin(), bytes.end(), std::mt19937(6));
  expectReadable({bytes});
}

TEST(DeflateWriter, randomMixturesOfRunsAndLiteralsAreReadBack) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    Bytes bytes;
    while (bytes.size() < 5000) {
      bytes.insert(bytes.end(), 1 + random() % (1U << (random() % 10)),
                   static_cast<std::uint8_t>(random() % (1U << (random() % 9))));
    }
    expectReadable({bytes});
  }
}

}  // namespace
}  // namespace careen
