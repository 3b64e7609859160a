// A film with sound, and one run filmed as several scenes say, as their user meets them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/process.h"

namespace careen {
namespace {

const std::string kBouncing = R"({
  "careen": 1, "duration": 1, "gravity": [0, 0, -10], "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "restitution": 0.8 },
  "boxes": [ { "name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 0.5], "material": "metal",
               "velocity": [1, 0, 2], "angular_velocity": [1, 2, 3] } ],
  "film": { "size": [64, 48], "fps": 10 } })";

class FilmSound : public testing::Test {
 protected:
  void SetUp() override { folder_.write("scene.json", kBouncing); }

  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), CAREEN_BINARY);
    return Process(arguments, folder_.path()).wait();
  }

  TemporaryFolder folder_;
};

TEST_F(FilmSound, isAsLongAsTheFilmAndInItsVideo) {
  const Ended ended = careen({"render", "scene.json", "--sound", "--out", "film", "--video", "film.mp4"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::string wav = textOf(folder_ / "film/sound.wav");
  EXPECT_EQ(wav.size(), 44U + 2U * 48000U);
  EXPECT_NE(wav.substr(44).find_first_not_of('\0'), std::string::npos);
  const Ended streams = Process({"ffprobe", "-v", "error", "-show_entries", "stream=codec_name", "-of",
                                 "csv=p=0", (folder_ / "film.mp4").string()},
                                folder_.path())
                            .wait();
  EXPECT_EQ(streams.out, "h264\naac\n");
  ASSERT_EQ(careen({"render", "scene.json", "--sound", "--out", "part", "--frames", "3-7"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "part/sound.wav").size(), 44U + 2U * 48000U / 2U);
}

TEST_F(FilmSound, isTheSameHoweverTheFilmIsDrawn) {
  ASSERT_EQ(careen({"render", "scene.json", "--sound", "--out", "one", "--jobs", "1"}).exitCode, 0);
  ASSERT_EQ(careen({"simulate", "scene.json", "-o", "run.careen"}).exitCode, 0);
  ASSERT_EQ(careen({"render", "run.careen", "--sound", "--out", "two", "--jobs", "2"}).exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "one/sound.wav"), textOf(folder_ / "two/sound.wav"));
}

TEST_F(FilmSound, ofWhatHasNoneIsRefused) {
  const Ended gaps = careen({"render", "scene.json", "--sound", "--out", "film", "--frames", "0,2-3"});
  EXPECT_EQ(gaps.exitCode, 2);
  EXPECT_NE(gaps.err.find("--sound: found frame 2 after frame 0, expected"), std::string::npos) << gaps.err;
  const Ended gif = careen({"render", "scene.json", "--sound", "--out", "film", "--video", "film.gif"});
  EXPECT_EQ(gif.exitCode, 2);
  EXPECT_NE(gif.err.find("expected one of: .mp4, .mkv, .mov, .webm"), std::string::npos) << gif.err;
  EXPECT_EQ(careen({"render", "scene.json", "--sound", "--still", "0.5"}).exitCode, 2);
  EXPECT_EQ(careen({"render", "scene.json", "--sound-pitch", "--out", "film"}).exitCode, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film"));
}

TEST_F(FilmSound, aRunIsFilmedAsAnotherSceneSays) {
  folder_.write("clay.json", R"({ "careen": 1, "look": "clay", "film": { "size": [32, 24], "fps": 5 },
                                  "titles": [ { "time": [0, 1], "text": "clay" } ] })");
  ASSERT_EQ(careen({"simulate", "scene.json", "-o", "run.careen"}).exitCode, 0);
  const Ended ended = careen({"render", "run.careen", "--scene", "clay.json", "--out", "film"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  const std::string manifest = textOf(folder_ / "film/film.json");
  EXPECT_NE(manifest.find("\"look\": \"clay\""), std::string::npos);
  EXPECT_NE(manifest.find("\"shown_as\""), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film/000006.png"));
  // That film is not continued as another scene says, be it only another title.
  folder_.write("clay.json", textOf(folder_ / "clay.json") + "\n");
  const Ended other = careen({"render", "run.careen", "--scene", "clay.json", "--out", "film", "--resume"});
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_NE(other.err.find("shown as"), std::string::npos) << other.err;
  EXPECT_EQ(careen({"truth", "run.careen", "--scene", "clay.json", "--out", "labels"}).exitCode, 0);
  const Ended info = careen({"info", "run.careen", "--scene", "clay.json"});
  EXPECT_EQ(info.exitCode, 2) << "a run that is not shown has its scene";
}

}  // namespace
}  // namespace careen
