#include "image/png.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <gtest/gtest.h>
#include <libdeflate.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "image/deep_picture.h"
#include "pictures.h"
#include "support/process.h"

namespace careen {
namespace {

double coreSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string pngErrorOf(std::string_view bytes) {
  try {
    decodePng(bytes, "frame.png");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Png, readsBackTheSamePixels) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {2, 3}, {17, 5}, {640, 360}}) {
    const Picture picture = shadedTiles(width, height);
    const Picture back = decodePng(encodePng(picture), "frame.png");
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.rgb, picture.rgb);
  }
}

std::uint32_t numberAt(const std::string& bytes, std::size_t place) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    number = number << 8U | static_cast<unsigned char>(bytes.at(place + i));
  }
  return number;
}

/// The pixels of a file of our own, by the specification and libdeflate, which tests the checksum.
std::vector<std::uint8_t> pixelsOf(const std::string& bytes, std::size_t width, std::size_t height) {
  constexpr std::size_t kData = 33;  // signature and the whole of IHDR
  EXPECT_EQ(bytes.substr(kData + 4, 4), "IDAT");
  const std::size_t size = numberAt(bytes, kData);
  EXPECT_EQ(bytes.size(), kData + 12 + size + 12);
  std::vector<std::uint8_t> rows(height * (3 * width + 1));
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> reader(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  EXPECT_EQ(libdeflate_zlib_decompress(reader.get(), bytes.data() + kData + 8, size, rows.data(), rows.size(),
                                       nullptr),
            LIBDEFLATE_SUCCESS);
  std::vector<std::uint8_t> pixels(height * 3 * width);
  for (std::size_t y = 0; y < height; ++y) {
    EXPECT_EQ(rows[y * (3 * width + 1)], 4);  // Paeth
    for (std::size_t x = 0; x < 3 * width; ++x) {
      const std::size_t place = y * 3 * width + x;
      const int left = x < 3 ? 0 : pixels[place - 3];
      const int above = y < 1 ? 0 : pixels[place - 3 * width];
      const int aboveLeft = x < 3 || y < 1 ? 0 : pixels[place - 3 * width - 3];
      const int toLeft = std::abs(above - aboveLeft);
      const int toAbove = std::abs(left - aboveLeft);
      const int toBoth = std::abs(left + above - 2 * aboveLeft);
      const int prediction = toLeft <= toAbove && toLeft <= toBoth ? left
                             : toAbove <= toBoth                   ? above
                                                                   : aboveLeft;
      pixels[place] = static_cast<std::uint8_t>(rows[y * (3 * width + 1) + 1 + x] + prediction);
    }
  }
  return pixels;
}

std::size_t expectReadBack(const Picture& picture) {
  const std::string bytes = encodePng(picture);
  EXPECT_TRUE(decodePng(bytes, "frame.png").rgb == picture.rgb) << picture.width << " x " << picture.height;
  EXPECT_TRUE(pixelsOf(bytes, static_cast<std::size_t>(picture.width),
                       static_cast<std::size_t>(picture.height)) == picture.rgb)
      << picture.width << " x " << picture.height;
  return bytes.size();
}

TEST(Png, readsBackPicturesOfEveryWidth) {
  for (int width = 1; width <= 70; ++width) {
    expectReadBack(shadedTiles(width, 1 + width % 9));
    expectReadBack(noise(width, 1 + width % 5, static_cast<unsigned>(width)));
  }
}

// A piece that is compressed at once is a quarter of a megabyte.
TEST(Png, readsBackPicturesOfSeveralPieces) {
  expectReadBack(shadedTiles(1280, 300));
  expectReadBack(shadedTiles(100'000, 3));
  expectReadBack(shadedTiles(1, 100'000));
}

TEST(Png, flatAndGradedPicturesAreSmall) {
  EXPECT_LT(expectReadBack(flat(1280, 720, 77)), 4200U);  // measured 4137
  EXPECT_LT(expectReadBack(flat(1280, 720, 0)), 4200U);   // measured 4133
  Picture graded{.width = 600, .height = 256, .rgb = {}};
  for (int y = 0; y < 256; ++y) {
    graded.rgb.insert(graded.rgb.end(), graded.rowBytes(), static_cast<std::uint8_t>(y));
  }
  EXPECT_LT(expectReadBack(graded), 1500U);  // measured 1250
}

// Signature, three chunks and zlib's own are 63 bytes; each row has one of filter, a stored block five.
TEST(Png, whatCannotBeCompressedGrowsLittle) {
  for (const auto& [width, height] : {std::pair{1, 1}, {101, 67}, {1280, 720}}) {
    const std::size_t rows = static_cast<std::size_t>(height) * (3 * static_cast<std::size_t>(width) + 1);
    const std::size_t size = expectReadBack(noise(width, height, 7));
    EXPECT_LE(size, 63 + rows + 5 * (rows / 50'000 + 1));
    EXPECT_GE(size, 60 + rows);
  }
}

// ffmpeg, told to stop at a wrong checksum, stands for all the other readers.
TEST(Png, otherReadersSeeTheSamePixels) {
  const TemporaryFolder folder;
  const Picture picture = shadedTiles(321, 123);
  writePng(folder / "frame.png", picture);
  const Ended ended = Process({"ffmpeg", "-nostdin", "-loglevel", "error", "-err_detect", "crccheck+explode",
                               "-i", "frame.png", "-f", "rawvideo", "-pix_fmt", "rgb24", "frame.rgb"},
                              folder.path())
                          .wait();
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_EQ(textOf(folder / "frame.rgb"), std::string(picture.rgb.begin(), picture.rgb.end()));
}

struct Cost {
  double bytes = 0;
  double seconds = 0;
};

// Code with sanitizers or without optimisation does not tell what it takes otherwise.
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr double kMostTime = 1.0 / 7;
#else
constexpr double kMostTime = 3;  // measured 1.2
#endif

// The least of a few runs, and stb's own in between.
Cost shareOfStbs(const Picture& picture) {
  constexpr int kRuns = 3;
  Cost ours{.seconds = 1e9};
  Cost stbs{.seconds = 1e9};
  for (int run = 0; run < kRuns; ++run) {
    const double begun = coreSeconds();
    const std::string bytes = encodePng(picture);
    const double between = coreSeconds();
    int size = 0;
    std::free(stbi_write_png_to_mem(picture.rgb.data(), 0, picture.width, picture.height, 3, &size));
    const double ended = coreSeconds();
    ours = {.bytes = static_cast<double>(bytes.size()), .seconds = std::min(ours.seconds, between - begun)};
    stbs = {.bytes = static_cast<double>(size), .seconds = std::min(stbs.seconds, ended - between)};
  }
  const Cost share{.bytes = ours.bytes / stbs.bytes, .seconds = ours.seconds / stbs.seconds};
  std::cout << "ours " << ours.bytes << " bytes, " << 1000 * ours.seconds << " ms: " << share.bytes << " and "
            << share.seconds << " of stb's\n";
  return share;
}

TEST(Png, isAboutAsSmallAsStbsOwnAndTakesLessThanASeventhOfTheTime) {
  const Cost rendered = shareOfStbs(readPng(CAREEN_SOURCE_DIR "/assets/pictures/careen.png"));
  // Measured 1.12: noise of the dither in two dimensions leaves less to find than its lines did, 0.787 then.
  EXPECT_LT(rendered.bytes, 1.2);
  EXPECT_LT(rendered.seconds, kMostTime);  // measured 0.024 to 0.034
  const Cost grained = shareOfStbs(shadedTiles(1280, 720));
  EXPECT_LT(grained.bytes, 1);            // measured 0.964
  EXPECT_LT(grained.seconds, kMostTime);  // measured 0.065 to 0.08
}

TEST(Png, damageIsToldAndNamed) {
  const std::string whole = encodePng(shadedTiles(64, 48));
  ASSERT_EQ(pngErrorOf(whole), "");
  EXPECT_EQ(pngErrorOf(""), "frame.png: is no PNG");
  EXPECT_EQ(pngErrorOf("GIF89a"), "frame.png: is no PNG");
  EXPECT_EQ(pngErrorOf(whole.substr(0, whole.size() / 2)), "frame.png: is a PNG cut short");
  EXPECT_EQ(pngErrorOf(whole.substr(0, whole.size() - 1)), "frame.png: is a PNG cut short");
  for (const std::size_t place : {std::size_t{18}, whole.size() / 2, whole.size() - 20}) {
    std::string changed = whole;
    changed[place] = static_cast<char>(changed[place] ^ 4);
    EXPECT_EQ(pngErrorOf(changed), "frame.png: is a damaged PNG: a checksum is wrong") << place;
  }
}

TEST(Png, isWholeOnlyWithEveryByteAndTheSize) {
  const TemporaryFolder folder;
  const std::string whole = encodePng(shadedTiles(64, 48));
  folder.write("whole.png", whole);
  folder.write("cut.png", whole.substr(0, whole.size() - 1));
  folder.write("empty.png", "");
  std::string changed = whole;
  changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 1);
  folder.write("changed.png", changed);
  EXPECT_TRUE(isWholePng(folder / "whole.png", 64, 48));
  EXPECT_FALSE(isWholePng(folder / "whole.png", 48, 64));
  EXPECT_FALSE(isWholePng(folder / "cut.png", 64, 48));
  EXPECT_FALSE(isWholePng(folder / "changed.png", 64, 48));
  EXPECT_FALSE(isWholePng(folder / "empty.png", 64, 48));
  EXPECT_FALSE(isWholePng(folder / "none.png", 64, 48));
}

TEST(Png, missingFileAndUnwritablePlaceAreErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(readPng(folder / "none.png"), InputError);
  EXPECT_THROW(writePng(folder / "none/frame.png", shadedTiles(4, 4)), MachineError);
  EXPECT_THROW(encodePng(Picture{}), InputError);
  EXPECT_THROW(encodePng(Picture{.width = 2, .height = 2, .rgb = {1, 2, 3}}), InputError);
}

TEST(Png, keepsAlpha) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {17, 5}, {640, 360}}) {
    Picture picture = shadedTiles(width, height);
    for (std::size_t i = 0; i < picture.rgb.size() / 3; ++i) {
      picture.alpha.push_back(static_cast<std::uint8_t>(7 * i + i / 300));
    }
    const std::string bytes = encodePng(picture);
    const Picture back = decodePng(bytes, "frame.png");
    EXPECT_EQ(back.rgb, picture.rgb);
    EXPECT_EQ(back.alpha, picture.alpha);
    EXPECT_EQ(decodeDeepPng(bytes, "").samples8, rgbaOf(picture)) << "by libpng";
  }
  EXPECT_THROW(encodePng({.width = 1, .height = 1, .rgb = {1, 2, 3}, .alpha = {4, 5}}), InputError);
}

TEST(Png, oneColourMayBeTransparent) {
  const Picture picture{.width = 2, .height = 1, .rgb = {0, 0, 0, 0, 200, 1}};
  const DeepPicture clear = decodeDeepPng(encodePng(picture, PngColor{0, 200, 1}), "");
  EXPECT_EQ(clear.samples8, (std::vector<std::uint8_t>{0, 0, 0, 255, 0, 200, 1, 0}));
}

}  // namespace
}  // namespace careen
