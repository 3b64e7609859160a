#include "image/png.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <gtest/gtest.h>
#include <stb/stb_image_write.h>

#include <ctime>
#include <string>
#include <vector>

#include "core/error.h"
#include "pictures.h"
#include "support/process.h"

namespace careen {
namespace {

double coreSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string errorOf(std::string_view bytes) {
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

TEST(Png, readsBackWhatCannotBeCompressed) {
  Picture noise{.width = 101, .height = 67, .rgb = {}};
  std::uint32_t random = 7;
  for (std::size_t i = 0; i < noise.rowBytes() * 67; ++i) {
    random = random * 1664525U + 1013904223U;
    noise.rgb.push_back(static_cast<std::uint8_t>(random >> 24U));
  }
  EXPECT_EQ(decodePng(encodePng(noise), "noise.png").rgb, noise.rgb);
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

TEST(Png, isSmallerAndQuickerThanByTheCompressorThatComesWithStb) {
  const Picture picture = shadedTiles(1280, 720);
  const double begun = coreSeconds();
  const std::string ours = encodePng(picture);
  const double between = coreSeconds();
  int size = 0;
  std::free(stbi_write_png_to_mem(picture.rgb.data(), 0, picture.width, picture.height, 3, &size));
  const double ended = coreSeconds();
  RecordProperty("bytes", static_cast<int>(ours.size()));
  RecordProperty("bytes_stb", size);
  std::cout << "ours " << ours.size() << " bytes, " << 1000 * (between - begun) << " ms; stb's " << size
            << " bytes, " << 1000 * (ended - between) << " ms\n";
  EXPECT_LT(static_cast<double>(ours.size()), 0.9 * size);  // measured 0.77
  EXPECT_LT(between - begun, 0.7 * (ended - between));      // measured 0.30 to 0.35
}

TEST(Png, damageIsToldAndNamed) {
  const std::string whole = encodePng(shadedTiles(64, 48));
  ASSERT_EQ(errorOf(whole), "");
  EXPECT_EQ(errorOf(""), "frame.png: is no PNG");
  EXPECT_EQ(errorOf("GIF89a"), "frame.png: is no PNG");
  EXPECT_EQ(errorOf(whole.substr(0, whole.size() / 2)), "frame.png: is a PNG cut short");
  EXPECT_EQ(errorOf(whole.substr(0, whole.size() - 1)), "frame.png: is a PNG cut short");
  for (const std::size_t place : {std::size_t{18}, whole.size() / 2, whole.size() - 20}) {
    std::string changed = whole;
    changed[place] = static_cast<char>(changed[place] ^ 4);
    EXPECT_EQ(errorOf(changed), "frame.png: is a damaged PNG: a checksum is wrong") << place;
  }
}

TEST(Png, looksWholeOnlyWithBothEndsAndTheSize) {
  const TemporaryFolder folder;
  const std::string whole = encodePng(shadedTiles(64, 48));
  folder.write("whole.png", whole);
  folder.write("cut.png", whole.substr(0, whole.size() - 1));
  folder.write("empty.png", "");
  EXPECT_TRUE(looksWhole(folder / "whole.png", 64, 48));
  EXPECT_FALSE(looksWhole(folder / "whole.png", 48, 64));
  EXPECT_FALSE(looksWhole(folder / "cut.png", 64, 48));
  EXPECT_FALSE(looksWhole(folder / "empty.png", 64, 48));
  EXPECT_FALSE(looksWhole(folder / "none.png", 64, 48));
}

TEST(Png, missingFileAndUnwritablePlaceAreErrors) {
  const TemporaryFolder folder;
  EXPECT_THROW(readPng(folder / "none.png"), InputError);
  EXPECT_THROW(writePng(folder / "none/frame.png", shadedTiles(4, 4)), MachineError);
  EXPECT_THROW(encodePng(Picture{}), InputError);
  EXPECT_THROW(encodePng(Picture{.width = 2, .height = 2, .rgb = {1, 2, 3}}), InputError);
}

}  // namespace
}  // namespace careen
