// Single pictures in place of a film, as their user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/environment_variable.h"
#include "support/process.h"

namespace careen {
namespace {

const std::string kStillScene = R"({
  "careen": 1, "name": "toss", "duration": 1, "gravity": [0, 0, -10],
  "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "open": ["-y"], "restitution": 1 },
  "boxes": [ { "name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1],
               "velocity": [1, 0, 2], "angular_velocity": [1, 2, 3] } ],
  "film": { "size": [64, 48], "fps": 10, "shutter_deg": 180, "shutter_samples": 2 }
})";

class Still : public testing::Test {
 protected:
  void SetUp() override { folder_.write("scene.json", kStillScene); }

  Ended render(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {CAREEN_BINARY, "render", "scene.json"});
    return Process(arguments, folder_.path()).wait();
  }

  TemporaryFolder folder_;
};

TEST_F(Still, isTheFramesPictureOfThatMoment) {
  ASSERT_EQ(render({"--out", "film", "--frames", "3"}).exitCode, 0);
  const Ended ended = render({"--still", "0.3", "--out", "still.png"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("still.png"), std::string::npos) << ended.out;
  EXPECT_EQ(textOf(folder_ / "still.png"), textOf(folder_ / "film/000003.png"));
}

// Boxes that do not move have no copies, whose shades and occlusion would count once.
TEST_F(Still, ofWhatRestsIsThatOfManyMoments) {
  folder_.write("scene.json", R"({
    "careen": 1, "duration": 1, "gravity": [0, 0, -10],
    "walls": [ { "point": [0, 0, 0], "normal": [0, 0, 1] } ],
    "boxes": [ { "half_extents": [0.2, 0.2, 0.2], "mass": 1, "position": [-0.25, 0, 0.2] },
               { "half_extents": [0.2, 0.2, 0.2], "mass": 1, "position": [0.25, 0, 0.2] } ],
    "film": { "size": [160, 90], "fps": 10 } })");
  ASSERT_EQ(render({"--still", "0", "--out", "still.png"}).exitCode, 0);
  ASSERT_EQ(render({"--still", "0:0.5:0.25", "--out", "strobe.png"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "strobe.png"), textOf(folder_ / "still.png"));
}

TEST_F(Still, hasAPlaceOfItsOwn) {
  ASSERT_EQ(render({"--still", "0.3"}).exitCode, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/scene-still.png"));
  ASSERT_EQ(render({"--still", "0:1:0.25"}).exitCode, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/scene-strobe.png"));
}

TEST_F(Still, shutterOfTheCommandLineTakesTheScenesPlace) {
  ASSERT_EQ(render({"--still", "0.3", "--out", "blurred.png"}).exitCode, 0);
  ASSERT_EQ(render({"--still", "0.3", "--out", "sharp.png", "--shutter", "0"}).exitCode, 0);
  ASSERT_EQ(render({"--still", "0.3", "--out", "same.png", "--shutter", "180:2"}).exitCode, 0);
  EXPECT_NE(textOf(folder_ / "sharp.png"), textOf(folder_ / "blurred.png"));
  EXPECT_EQ(textOf(folder_ / "same.png"), textOf(folder_ / "blurred.png"));
  // A film begun with one is not completed with another.
  ASSERT_EQ(render({"--out", "film", "--frames", "0-1"}).exitCode, 0);
  const Ended other = render({"--out", "film", "--shutter", "90", "--resume"});
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_NE(other.err.find("shutter 180:2 there, 90:8 now"), std::string::npos) << other.err;
}

TEST_F(Still, fourSamplesAPixelAreNeverFewer) {
  const EnvironmentVariable driver("GALLIUM_DRIVER", "softpipe");
  const auto bySoftpipe = [&](const char* antialiasing) {
    return render({"--still", "0.3", "--out", "still.png", "--antialiasing", antialiasing});
  };
  const Ended one = bySoftpipe("4x");
  EXPECT_EQ(one.exitCode, 3);
  EXPECT_NE(one.err.find("found at most 1 of 4 samples a pixel (softpipe"), std::string::npos) << one.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "still.png"));
  EXPECT_EQ(bySoftpipe("edges").exitCode, 0);
}

TEST_F(Still, badOptionsWriteNothing) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--still", "1.5"},
                                             {"--still", "-1"},
                                             {"--still", "x"},
                                             {"--still", "0:2:0.1"},
                                             {"--still", "0:1"},
                                             {"--still", "0:1:0.1", "--plot", "energy"},
                                             {"--still", "0:1:0.1", "--ghost", "run.careen"},
                                             {"--still", "0:1:0.1", "--shutter", "180:8"},
                                             {"--still", "0", "--frames", "0-1"},
                                             {"--still", "0", "--video", "film.mp4"},
                                             {"--still", "0", "--resume"},
                                             {"--still", "0", "--shutter", "361"},
                                             {"--still", "0", "--shutter", "180:0"}}) {
    const Ended ended = render(options);
    EXPECT_EQ(ended.exitCode, 2) << options[0] << ' ' << options[1] << ended.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out")) << options[1];
  }
}

}  // namespace
}  // namespace careen
