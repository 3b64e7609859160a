#include "image/deep_picture.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <numeric>
#include <string>

#include "core/error.h"
#include "image/png.h"
#include "pictures.h"
#include "support/png_by_hand.h"
#include "support/process.h"

namespace careen {
namespace {

std::string errorOf(std::string_view bytes) {
  try {
    decodeDeepPng(bytes, "frame.png");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

using Bytes = std::vector<std::uint8_t>;
using Words = std::vector<std::uint16_t>;

TEST(DeepPicture, isThePictureOfTheProgramsOwnFrames) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2, 3}, {3, 2}, {7, 9}, {321, 123}}) {
    const Picture picture = noise(width, height, 5);
    const DeepPicture deep = decodeDeepPng(encodePng(picture), "frame.png");
    EXPECT_EQ(deep.width, width);
    EXPECT_EQ(deep.height, height);
    EXPECT_EQ(deep.channels, 3);
    EXPECT_FALSE(deep.deep);
    EXPECT_EQ(deep.samples8, picture.rgb);
  }
}

TEST(DeepPicture, greyOfEveryDepthIsSpreadToItsShareOfFull) {
  using namespace std::string_literals;
  const PngByHand one{.width = 9, .bits = 1, .color = 0, .rows = "\0\xa5\x80"s};
  EXPECT_EQ(decodeDeepPng(one.bytes(), "").samples8,
            (Bytes{255, 255, 255, 0,   0, 0, 255, 255, 255, 0,   0,   0,   0,  0,
                   0,   255, 255, 255, 0, 0, 0,   255, 255, 255, 255, 255, 255}));
  const PngByHand two{.width = 4, .bits = 2, .color = 0, .rows = "\0\x1b"s};
  EXPECT_EQ(decodeDeepPng(two.bytes(), "").samples8,
            (Bytes{0, 0, 0, 85, 85, 85, 170, 170, 170, 255, 255, 255}));
  const PngByHand four{.width = 3, .bits = 4, .color = 0, .rows = "\0\x08\xf0"s};
  EXPECT_EQ(decodeDeepPng(four.bytes(), "").samples8, (Bytes{0, 0, 0, 136, 136, 136, 255, 255, 255}));
  const PngByHand eight{.width = 2, .bits = 8, .color = 0, .rows = "\0\x07\xfe"s};
  EXPECT_EQ(decodeDeepPng(eight.bytes(), "").samples8, (Bytes{7, 7, 7, 254, 254, 254}));
  const PngByHand sixteen{.width = 2, .bits = 16, .color = 0, .rows = "\0\x01\x02\xff\xfe"s};
  const DeepPicture deep = decodeDeepPng(sixteen.bytes(), "");
  EXPECT_TRUE(deep.deep);
  EXPECT_EQ(deep.samples16, (Words{258, 258, 258, 65534, 65534, 65534}));
}

// One bit of grey becomes three bytes: 8192 x 8192 of them in 8 kB would be 200 MB.
TEST(DeepPicture, isNoMoreThanAThousandTimesItsFile) {
  const PngByHand bomb{
      .width = 8192, .height = 8192, .bits = 1, .color = 0, .rows = std::string(8192 * 1025, '\0')};
  const std::string error = errorOf(bomb.bytes());
  EXPECT_NE(error.find("frame.png: has 8192 x 8192 pixels, which take 201326592 bytes, in "),
            std::string::npos)
      << error;
  const PngByHand few{
      .width = 4096, .height = 4096, .bits = 1, .color = 0, .rows = std::string(4096 * 513, '\0')};
  EXPECT_EQ(decodeDeepPng(few.bytes(), "").samples(), std::size_t{4096} * 4096 * 3);
}

TEST(DeepPicture, isRefusedBeyondTheBytesAskedFor) {
  const std::string bytes = encodePng(noise(20, 10, 1));
  EXPECT_EQ(decodeDeepPng(bytes, "", 600).width, 20);
  EXPECT_THROW(decodeDeepPng(bytes, "", 599), InputError);
}

TEST(DeepPicture, tellsInWhichColoursItIsMeant) {
  PngByHand png{.rows = std::string(4, '\0')};
  EXPECT_EQ(decodeDeepPng(png.bytes(), "").colorSpace, "sRGB");
  png.before = pngChunk("gAMA", bigEndianBytes(100000));
  EXPECT_EQ(decodeDeepPng(png.bytes(), "").colorSpace, "gamma 1/1");
  png.before += pngChunk("sRGB", std::string(1, '\0'));
  EXPECT_EQ(decodeDeepPng(png.bytes(), "").colorSpace, "sRGB");
  png.before += pngChunk("iCCP", std::string("mine\0\0", 6) + zlibStream("profile"));
  EXPECT_TRUE(decodeDeepPng(png.bytes(), "").colorSpace.starts_with("ICC profile 'mine' "));
  png.before += pngChunk("cICP", std::string("\x09\x10\x00\x01", 4));
  EXPECT_EQ(decodeDeepPng(png.bytes(), "").colorSpace, "code points 9 16 0 1");
  EXPECT_EQ(deepened(withAlpha(decodeDeepPng(png.bytes(), ""))).colorSpace, "code points 9 16 0 1");
}

TEST(DeepPicture, keepsSixteenBitsAndAlpha) {
  using namespace std::string_literals;
  const PngByHand rgb{.bits = 16, .color = 2, .rows = "\0\x00\x01\x10\x00\xff\xff"s};
  EXPECT_EQ(decodeDeepPng(rgb.bytes(), "").samples16, (Words{1, 4096, 65535}));
  const PngByHand rgba{.bits = 16, .color = 6, .rows = "\0\x00\x01\x10\x00\xff\xff\x12\x34"s};
  const DeepPicture deep = decodeDeepPng(rgba.bytes(), "");
  EXPECT_EQ(deep.channels, 4);
  EXPECT_EQ(deep.samples16, (Words{1, 4096, 65535, 0x1234}));
  const PngByHand shallow{.bits = 8, .color = 6, .rows = "\0\x01\x02\x03\x04"s};
  EXPECT_EQ(decodeDeepPng(shallow.bytes(), "").samples8, (Bytes{1, 2, 3, 4}));
  const PngByHand greyAlpha{.bits = 8, .color = 4, .rows = "\0\x09\x80"s};
  EXPECT_EQ(decodeDeepPng(greyAlpha.bytes(), "").samples8, (Bytes{9, 9, 9, 128}));
  const PngByHand deepGreyAlpha{.bits = 16, .color = 4, .rows = "\0\x09\x01\x80\x02"s};
  EXPECT_EQ(decodeDeepPng(deepGreyAlpha.bytes(), "").samples16, (Words{0x901, 0x901, 0x901, 0x8002}));
}

TEST(DeepPicture, palettesAndColoursThatMeanTransparentAreSpread) {
  using namespace std::string_literals;
  const std::string palette = pngChunk("PLTE", "\x01\x02\x03\x0a\x0b\x0c\x15\x16\x17"s);
  for (const auto& [bits, row] : {std::pair{2, "\0\x18"s}, {4, "\0\x01\x20"s}, {8, "\0\x00\x01\x02"s}}) {
    PngByHand png{.width = 3, .bits = bits, .color = 3, .before = palette, .rows = row};
    EXPECT_EQ(decodeDeepPng(png.bytes(), "").samples8, (Bytes{1, 2, 3, 10, 11, 12, 21, 22, 23})) << bits;
    png.before += pngChunk("tRNS", "\x40\x00"s);  // the third stays opaque
    EXPECT_EQ(decodeDeepPng(png.bytes(), "").samples8, (Bytes{1, 2, 3, 64, 10, 11, 12, 0, 21, 22, 23, 255}))
        << bits;
  }
  const PngByHand grey{
      .width = 2, .bits = 4, .color = 0, .before = pngChunk("tRNS", "\x00\x02"s), .rows = "\0\x12"s};
  EXPECT_EQ(decodeDeepPng(grey.bytes(), "").samples8, (Bytes{17, 17, 17, 255, 34, 34, 34, 0}));
  const PngByHand rgb{.width = 2,
                      .bits = 16,
                      .color = 2,
                      .before = pngChunk("tRNS", "\x01\x02\x03\x04\x05\x06"s),
                      .rows = "\0\x01\x02\x03\x04\x05\x06\x01\x02\x03\x04\x05\x07"s};
  EXPECT_EQ(decodeDeepPng(rgb.bytes(), "").samples16, (Words{258, 772, 1286, 0, 258, 772, 1287, 65535}));
}

std::string randomBytes(std::size_t size, std::uint32_t seed) {
  std::string bytes;
  for (std::uint32_t random = seed; bytes.size() < size;) {
    random = random * 1664525U + 1013904223U;
    // Some equal, some near each other, so that ties of predictions come up.
    bytes += static_cast<char>(random >> (random % 3 == 0 ? 24U : 30U));
  }
  return bytes;
}

// A grey picture whose pixel k, row by row, has the value k: its passes are put together by table 8.1.
TEST(DeepPicture, interlacedPicturesOfEverySizeAreInterlacedNoMore) {
  constexpr std::array<std::array<int, 4>, 7> kPasses{
      {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
  for (int width = 1; width <= 10; ++width) {
    for (int height = 1; height <= 10; ++height) {
      PngByHand png{.width = static_cast<std::uint32_t>(width),
                    .height = static_cast<std::uint32_t>(height),
                    .color = 0,
                    .interlaced = true};
      for (const auto& [left, top, stepX, stepY] : kPasses) {
        for (int y = top; y < height && left < width; y += stepY) {
          png.rows += '\0';
          for (int x = left; x < width; x += stepX) {
            png.rows += static_cast<char>(y * width + x);
          }
        }
      }
      const DeepPicture picture = decodeDeepPng(png.bytes(), "");
      for (std::size_t i = 0; i < picture.samples8.size(); ++i) {
        ASSERT_EQ(picture.samples8[i], i / 3) << width << " x " << height;
      }
    }
  }
}

TEST(DeepPicture, dataMayBeInSeveralChunksAndOtherChunksMayStandBetween) {
  const Picture picture = noise(40, 30, 3);
  const std::string whole = encodePng(picture);
  const std::string data = whole.substr(41, whole.size() - 41 - 16);
  std::string parts;
  for (std::size_t i = 0; i < data.size(); i += 100) {
    parts += pngChunk("IDAT", data.substr(i, 100));
  }
  const std::string split = whole.substr(0, 33) + pngChunk("tEXt", "Comment") + parts + pngChunk("IEND", "");
  EXPECT_EQ(decodeDeepPng(split, "").samples8, picture.rgb);
  EXPECT_EQ(errorOf(whole.substr(0, 33) + pngChunk("ABCD", "") + whole.substr(33)),
            "frame.png: is a damaged PNG: ABCD: unhandled critical chunk");
}

TEST(DeepPicture, aFileCutAnywhereIsAnError) {
  using namespace std::string_literals;
  const PngByHand palette{
      .width = 3,
      .bits = 8,
      .color = 3,
      .before = pngChunk("PLTE", "\x01\x02\x03\x0a\x0b\x0c\x15\x16\x17"s) + pngChunk("tRNS", "\x7f"s),
      .rows = "\0\x00\x01\x02"s};
  for (const std::string& whole : {encodePng(shadedTiles(20, 10)), palette.bytes()}) {
    ASSERT_EQ(errorOf(whole), "");
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_THROW(decodeDeepPng(whole.substr(0, size), "frame.png"), InputError) << size;
    }
  }
}

// Every chunk has a checksum: no byte can be another one, but for those of the length, which must then not
// fit.
TEST(DeepPicture, anyChangedByteIsAnError) {
  const std::string whole = encodePng(shadedTiles(20, 10));
  for (std::size_t place = 0; place < whole.size(); ++place) {
    for (const int change : {1, 0x80, 0xff}) {
      std::string changed = whole;
      changed[place] = static_cast<char>(changed[place] ^ change);
      EXPECT_THROW(decodeDeepPng(changed, "frame.png"), InputError) << place;
    }
  }
}

// With right checksums of chunks: what is in them must fit, too.
TEST(DeepPicture, contradictionsAreErrors) {
  using namespace std::string_literals;
  const PngByHand right{.width = 2, .height = 1, .rows = "\0abcdef"s};
  ASSERT_EQ(errorOf(right.bytes()), "");
  const auto rowsOf = [&right](const std::string& rows) {
    PngByHand png = right;
    png.rows = rows;
    return errorOf(png.bytes());
  };
  const std::string damaged = "frame.png: is a damaged PNG: ";
  EXPECT_EQ(rowsOf("\0abcde"s), damaged + "Not enough image data");
  EXPECT_EQ(rowsOf("\0abcdefg"s), damaged + "IDAT: Too much image data");
  EXPECT_EQ(rowsOf("\5abcdef"s), damaged + "bad adaptive filter value");
  std::string stream = zlibStream(right.rows);
  stream.back() = static_cast<char>(stream.back() ^ 1);  // Adler-32
  const std::string begin = "\x89PNG\r\n\x1a\n" + right.header();
  EXPECT_EQ(errorOf(begin + pngChunk("IDAT", stream) + pngChunk("IEND", "")),
            damaged + "IDAT: incorrect data check");
  EXPECT_NE(errorOf(begin + pngChunk("IEND", "")), "");
  EXPECT_NE(errorOf("\x89PNG\r\n\x1a\n" + pngChunk("IDAT", stream) + pngChunk("IEND", "")), "");
  const auto headerOf = [](PngByHand png) {
    png.rows = std::string(200, '\0');
    return errorOf(png.bytes());
  };
  for (const auto& [color, bits] :
       {std::pair{2, 4}, {3, 16}, {4, 2}, {6, 1}, {1, 8}, {5, 8}, {7, 8}, {0, 3}}) {
    EXPECT_TRUE(headerOf({.bits = bits, .color = color}).starts_with(damaged + "Invalid "))
        << color << " " << bits;
  }
  EXPECT_NE(headerOf({.color = 3}).find("Missing PLTE"), std::string::npos);
  EXPECT_NE(headerOf({.color = 6, .before = pngChunk("tRNS", "ab")}).find("tRNS"), std::string::npos);
}

TEST(DeepPicture, whatIsClaimedIsNotBelievedBeforeMemoryIsTaken) {
  const auto claim = [](std::uint32_t width, std::uint32_t height) {
    return errorOf(PngByHand{.width = width, .height = height, .bits = 16, .color = 6, .rows = "x"}.bytes());
  };
  EXPECT_EQ(claim(0, 5), "frame.png: claims 0 x 5 pixels; from 1 to 268435456 can be read");
  EXPECT_EQ(claim(0xffffffff, 0xffffffff),
            "frame.png: claims 4294967295 x 4294967295 pixels; from 1 to 268435456 can be read");
  EXPECT_NE(claim(16384, 16384).find("take 2147483648 bytes, in 12; expected at most 64 MiB"),
            std::string::npos)
      << claim(16384, 16384);
  EXPECT_EQ(errorOf(""), "frame.png: is no PNG");
}

// ffmpeg's encoder stands for those of others: another zlib, all filters, other kinds of pixels.
TEST(DeepPicture, readsWhatAnotherProgramWrote) {
  const TemporaryFolder folder;
  for (const auto& [format, channels] :
       {std::pair{"rgb24", 3}, {"rgba", 4}, {"rgb48be", 3}, {"rgba64be", 4}}) {
    const bool deep = std::string(format).find("be") != std::string::npos;
    const std::string raw =
        randomBytes(std::size_t{31} * 17 * static_cast<std::size_t>(channels) * (deep ? 2 : 1), 9);
    folder.write("raw", raw);
    const Ended ended =
        Process({"ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", format, "-s",
                 "31x17", "-i", "raw", "-pred", "mixed", "frame.png"},
                folder.path())
            .wait();
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    const DeepPicture picture = readDeepPng(folder / "frame.png");
    EXPECT_EQ(picture.channels, channels);
    EXPECT_EQ(picture.deep, deep);
    std::string back;
    for (const std::uint8_t sample : picture.samples8) {
      back += static_cast<char>(sample);
    }
    for (const std::uint16_t sample : picture.samples16) {
      back += {static_cast<char>(sample >> 8), static_cast<char>(sample)};
    }
    EXPECT_TRUE(back == raw) << format;
  }
}

TEST(DeepPicture, widenedItIsTheSameShareOfFullAndOpaque) {
  using namespace std::string_literals;
  const DeepPicture picture = decodeDeepPng(PngByHand{.rows = "\0\x00\x80\xff"s}.bytes(), "");
  EXPECT_EQ(deepened(picture).samples16, (Words{0, 0x8080, 65535}));
  EXPECT_EQ(withAlpha(picture).samples8, (Bytes{0, 128, 255, 255}));
  EXPECT_EQ(withAlpha(deepened(picture)).samples16, (Words{0, 0x8080, 65535, 65535}));
}

}  // namespace
}  // namespace careen
