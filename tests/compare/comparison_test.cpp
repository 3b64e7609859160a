#include "compare/comparison.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "core/system/file.h"
#include "image/pictures.h"
#include "image/png.h"
#include "support/exact_runs.h"
#include "support/input_error.h"
#include "support/png_by_hand.h"
#include "support/process.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

// A frame of a film in which a bright square moves by 6 px a frame.
Picture frame(int k, int blue = 200) {
  Picture picture = shadedTiles(96, 64);
  for (int y = 20; y < 40; ++y) {
    for (int x = 6 * k; x < 6 * k + 20; ++x) {
      std::uint8_t* const pixel =
          &picture.rgb[static_cast<std::size_t>(y) * picture.rowBytes() + 3 * static_cast<std::size_t>(x)];
      pixel[0] = 250;
      pixel[1] = 240;
      pixel[2] = static_cast<std::uint8_t>(blue);
    }
  }
  return picture;
}

std::string nameOf(int k) { return "00000" + std::to_string(k) + ".png"; }

class Compared : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"expected", "actual"}) {
      std::filesystem::create_directory(folder_ / folder);
      for (int k = 0; k < 6; ++k) {
        put(folder, k, frame(k));
      }
    }
  }
  void put(const char* folder, int k, const Picture& picture) const {
    writePng(folder_ / folder / nameOf(k), picture);
  }
  Comparison compare(std::optional<bool> sameMotion = {}) const {
    return compareFolders(folder_ / "expected", folder_ / "actual", settings_, sameMotion);
  }

  TemporaryFolder folder_;
  ComparisonSettings settings_;
};

TEST_F(Compared, sameFilesAreSameByTheirBytes) {
  const Comparison found = compare();
  EXPECT_EQ(found.verdict, Verdict::kSame);
  EXPECT_EQ(found.headline, "same files");
  ASSERT_EQ(found.frames.size(), 6U);
  for (const FrameComparison& each : found.frames) {
    EXPECT_TRUE(each.identical && each.measured);
    EXPECT_EQ(each.psnr, std::numeric_limits<double>::infinity());
  }
  EXPECT_EQ(found.firstDifferent(), nullptr);
  EXPECT_EQ(found.worst(), nullptr);
}

TEST_F(Compared, otherFilesOfTheSamePixelsAreTheSame) {
  settings_.tolerance = toleranceOf("exact");
  std::string bytes = readFile(folder_ / "actual" / nameOf(2));
  bytes.insert(bytes.size() - 12, std::string("\0\0\0\0tEXt\x96\x42\xc5\x85", 12));  // an empty comment
  writeFile(folder_ / "actual" / nameOf(2), bytes);
  const Comparison found = compare();
  EXPECT_FALSE(found.frames[2].identical);
  EXPECT_TRUE(found.frames[2].measured);
  EXPECT_EQ(found.verdict, Verdict::kSame);
  EXPECT_EQ(found.headline, "same pictures");
}

TEST_F(Compared, framesThatDifferAreNamedInOrderAndTheWorstIsFound) {
  put("actual", 1, frame(1, 190));
  put("actual", 4, frame(4, 100));
  for (const int threads : {1, 3}) {
    settings_.threads = threads;
    const Comparison found = compare();
    EXPECT_EQ(found.verdict, Verdict::kDifferent);
    EXPECT_EQ(found.headline, "other picture in 2 of 6 frames");
    ASSERT_NE(found.firstDifferent(), nullptr);
    EXPECT_EQ(found.firstDifferent()->name, nameOf(1));
    EXPECT_NEAR(found.firstDifferent()->largest, 10 / 255.0, 1e-12);
    EXPECT_EQ(found.firstDifferent()->largestX, 6);
    EXPECT_EQ(found.firstDifferent()->largestY, 20);
    EXPECT_NEAR(found.firstDifferent()->failingPercent, 100 * 400 / (96.0 * 64), 1e-9);
    EXPECT_EQ(found.worst()->name, nameOf(4));
    EXPECT_EQ(expectedFrame(found, *found.worst()), folder_ / "expected" / nameOf(4));
  }
}

TEST_F(Compared, missingAndNewFramesAreDifferences) {
  std::filesystem::remove(folder_ / "actual" / nameOf(3));
  put("actual", 7, frame(7));
  const Comparison found = compare();
  EXPECT_EQ(found.verdict, Verdict::kDifferent);
  ASSERT_EQ(found.frames.size(), 7U);
  EXPECT_EQ(found.frames[3].reasons, std::vector<std::string>{"it is missing"});
  EXPECT_EQ(found.frames[6].reasons, std::vector<std::string>{"it was not expected"});
  EXPECT_FALSE(found.frames[3].measured);
}

TEST_F(Compared, droppedAndDoubledFramesAreToldFromOthers) {
  for (int k = 3; k < 6; ++k) {
    put("actual", k, frame(k + 1));
  }
  EXPECT_EQ(compare().frames[3].reasons.back(), "it shows what 000004.png should: a frame was dropped");
  for (int k = 3; k < 6; ++k) {
    put("actual", k, frame(k - 1));
  }
  EXPECT_EQ(compare().frames[3].reasons.back(), "it shows what 000002.png should: a frame is doubled");
}

TEST_F(Compared, brokenFilesAreNeverTheSameNotEvenAsThemselves) {
  std::string bytes = readFile(folder_ / "actual" / nameOf(2));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  for (const char* folder : {"expected", "actual"}) {
    writeFile(folder_ / folder / nameOf(2), bytes);
  }
  const Comparison found = compare();
  EXPECT_EQ(found.verdict, Verdict::kDifferent);
  EXPECT_NE(found.frames[2].reasons.at(0).find("a checksum is wrong"), std::string::npos);
  EXPECT_NE(inputErrorOf([&] {
              comparePictures(folder_ / "expected" / nameOf(2), folder_ / "actual" / nameOf(2), settings_);
            }).find("a checksum is wrong"),
            std::string::npos);
}

TEST_F(Compared, anotherSizeIsADifference) {
  put("actual", 0, shadedTiles(96, 65));
  const Comparison found = compare();
  EXPECT_EQ(found.verdict, Verdict::kDifferent);
  EXPECT_NE(found.frames[0].reasons.at(0).find("96x65"), std::string::npos) << found.frames[0].reasons[0];
}

TEST_F(Compared, anotherMotionIsADifferenceUnlessItDoesNotCount) {
  EXPECT_EQ(compare(true).headline, "same motion, same files");
  EXPECT_EQ(compare(false).headline, "other motion, same files");
  EXPECT_EQ(compare(false).verdict, Verdict::kDifferent);
  settings_.motionCounts = false;
  EXPECT_EQ(compare(false).verdict, Verdict::kSame);
  put("actual", 1, frame(1, 100));
  EXPECT_EQ(compare(true).headline, "same motion, other picture in 1 of 6 frames");
}

TEST_F(Compared, picturesOfAnySuffixAndInSubfoldersAreComparedByTheirPaths) {
  for (const char* folder : {"expected", "actual"}) {
    std::filesystem::create_directories(folder_ / folder / "sub/deep.png");
    writePng(folder_ / folder / "000006.PNG", frame(1, folder[0] == 'e' ? 200 : 100));
    writePng(folder_ / folder / "sub/000000.png", frame(1));
    writePng(folder_ / folder / "sub/deep.png/2.Png", frame(2, folder[0] == 'e' ? 200 : 100));
  }
  writePng(folder_ / "actual/sub/3.png", frame(3));
  Comparison found = compare();
  ASSERT_EQ(found.frames.size(), 10U);
  EXPECT_EQ(found.headline, "other picture in 3 of 10 frames");
  EXPECT_EQ(found.frames[6].name, "000006.PNG");
  EXPECT_NEAR(found.frames[6].largest, 100 / 255.0, 1e-12);
  EXPECT_EQ(found.frames[7].name, "sub/000000.png");
  EXPECT_TRUE(found.frames[7].identical);
  EXPECT_EQ(found.frames[8].name, "sub/3.png");
  EXPECT_EQ(found.frames[8].reasons, std::vector<std::string>{"it was not expected"});
  EXPECT_EQ(found.frames[9].name, "sub/deep.png/2.Png");
  EXPECT_NEAR(found.frames[9].largest, 100 / 255.0, 1e-12);
  EXPECT_EQ(actualFrame(found, found.frames[9]), folder_ / "actual/sub/deep.png/2.Png");
  settings_.subfolders = false;
  found = compare();
  ASSERT_EQ(found.frames.size(), 7U);
  EXPECT_EQ(found.headline, "other picture in 1 of 7 frames");
}

TEST_F(Compared, foldersWithoutPicturesAreBadInput) {
  std::filesystem::create_directory(folder_ / "empty");
  EXPECT_EQ(inputErrorOf([&] { compareFolders(folder_ / "expected", folder_ / "empty", settings_, {}); }),
            (folder_ / "empty").string() + ": found no PNG files, expected a folder of frames");
}

TEST_F(Compared, flipIsMeasuredWhereAskedFor) {
  put("actual", 1, frame(1, 100));
  EXPECT_FALSE(compare().frames[1].flip);
  settings_.flip = true;
  const Comparison found = compare();
  EXPECT_EQ(found.frames[0].flip, 0);
  EXPECT_GT(found.frames[1].flip, 0.001);
}

class ComparedRuns : public testing::Test {
 protected:
  std::filesystem::path write(const char* name, double startOff, double duration = 2) const {
    World world = elasticRoom();
    world.bodies[0].initial.pose.position.x() += startOff;
    writeFile(folder_ / name, encodeTrajectory(record(world, {.duration = duration}, "a scene")));
    return folder_ / name;
  }

  TemporaryFolder folder_;
  ComparisonSettings settings_;
};

TEST_F(ComparedRuns, everyBitCountsUnlessATolerancePermits) {
  const auto one = write("one.careen", 0);
  const auto other = write("other.careen", 1e-9);
  EXPECT_EQ(compareRuns(one, one, settings_).headline, "same motion, bit for bit");
  Comparison found = compareRuns(one, other, settings_);
  EXPECT_EQ(found.verdict, Verdict::kDifferent);
  EXPECT_EQ(found.headline, "other motion from 0 s on");
  ASSERT_TRUE(found.run);
  settings_.motionTolerance = 1e-3;
  found = compareRuns(one, other, settings_);
  EXPECT_EQ(found.verdict, Verdict::kSame);
  EXPECT_TRUE(found.headline.starts_with("same motion, within ")) << found.headline;
  settings_.motionTolerance = 1e-12;
  EXPECT_EQ(compareRuns(one, other, settings_).verdict, Verdict::kDifferent);
}

TEST_F(ComparedRuns, chaosIsNamedAndALengthToo) {
  const auto one = write("one.careen", 0, 20);
  settings_.motionTolerance = 1;
  const Comparison found = compareRuns(one, write("other.careen", 1e-9, 20), settings_);
  EXPECT_EQ(found.verdict, Verdict::kDifferent);  // no tolerance reaches beyond the horizon
  EXPECT_NE(found.headline.find("chaos has taken over"), std::string::npos) << found.headline;
  EXPECT_EQ(compareRuns(one, write("short.careen", 0, 5), settings_).headline,
            "same motion, but it lasts 5 s, not 20 s");
}

TEST_F(Compared, otherSizeIsADifference) {
  put("actual", 2, shadedTiles(96, 63));
  const std::string reason = "found a picture of 96x63 pixels, expected one of 96x64";
  const Comparison found = compare();
  EXPECT_EQ(found.frames[2].verdict, Verdict::kDifferent);
  EXPECT_EQ(found.frames[2].reasons, std::vector<std::string>{reason});
  const Comparison single =
      comparePictures(folder_ / "expected" / nameOf(2), folder_ / "actual" / nameOf(2), settings_);
  EXPECT_EQ(single.verdict, Verdict::kDifferent);
  EXPECT_EQ(single.frames[0].reasons, std::vector<std::string>{reason});
  EXPECT_FALSE(single.frames[0].measured);
}

TEST_F(Compared, ignoredRegionsCountInNothing) {
  settings_.tolerance = toleranceOf("exact");
  settings_.flip = true;
  Picture picture = frame(2);
  picture.rgb[0] = static_cast<std::uint8_t>(picture.rgb[0] ^ 255U);
  put("actual", 2, picture);
  EXPECT_EQ(compare().verdict, Verdict::kDifferent);
  settings_.ignored.add("0,0,1,1");
  const Comparison found = compare();
  EXPECT_EQ(found.verdict, Verdict::kSame);
  EXPECT_EQ(found.ignored.names(), std::vector<std::string>{"0,0,1,1"});
  EXPECT_EQ(found.frames[2].largest, 0);
  EXPECT_EQ(found.frames[2].flip, 0);
  picture.rgb[3] = static_cast<std::uint8_t>(picture.rgb[3] ^ 255U);
  put("actual", 2, picture);
  const Comparison other = compare();
  EXPECT_EQ(other.frames[2].verdict, Verdict::kDifferent);
  EXPECT_EQ(other.frames[2].largestX, 1);
  EXPECT_NEAR(other.frames[2].failingPercent, 100.0 / (96 * 64 - 1), 1e-12);
}

// Even if no frame has to be decoded.
TEST_F(Compared, ignoredRegionsThatDoNotFitAreRefused) {
  settings_.ignored.add("90,0,7,1");
  const auto said = "--ignore: found 90,0,7,1, expected a rectangle within the pictures' 96x64 pixels";
  EXPECT_EQ(inputErrorOf([&] { compare(); }), said);
  put("actual", 2, frame(3));
  EXPECT_EQ(inputErrorOf([&] { compare(); }), said);
  EXPECT_EQ(inputErrorOf([&] {
              comparePictures(folder_ / "expected" / nameOf(2), folder_ / "actual" / nameOf(2), settings_);
            }),
            said);
}

TEST_F(Compared, sameSamplesInOtherColoursAreADifference) {
  settings_.tolerance = toleranceOf("other-renderer");
  std::string bytes = readFile(folder_ / "actual" / nameOf(2));
  bytes.insert(33, pngChunk("gAMA", bigEndianBytes(100000)));  // after the header
  writeFile(folder_ / "actual" / nameOf(2), bytes);
  const Comparison found = compare();
  EXPECT_EQ(found.frames[2].verdict, Verdict::kDifferent);
  EXPECT_EQ(found.frames[2].largest, 0);
  EXPECT_EQ(
      found.frames[2].reasons,
      std::vector<std::string>{"a viewer shows other colours, as its chunks say gamma 1/1, expected sRGB"});
  writeFile(folder_ / "expected" / nameOf(2), bytes);
  EXPECT_EQ(compare().verdict, Verdict::kSame);
}

}  // namespace
}  // namespace careen
