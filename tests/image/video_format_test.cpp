#include "image/video_format.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/error.h"

namespace careen {
namespace {

VideoSettings settingsOf(const std::string& path, const std::string& codec = "") {
  return {.path = path, .codec = codec, .width = 64, .height = 48};
}

std::string errorOf(const VideoSettings& settings) {
  try {
    checkVideo(settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

bool has(const VideoSettings& settings, const std::string& word) {
  const std::vector<std::string> command = ffmpegCommand(settings, "out");
  return std::find(command.begin(), command.end(), word) != command.end();
}

TEST(VideoFormat, suffixChoosesTheCodecUnlessOneIsNamed) {
  EXPECT_TRUE(has(settingsOf("film.mp4"), "libx264"));
  EXPECT_TRUE(has(settingsOf("film.mkv"), "libx264"));
  EXPECT_TRUE(has(settingsOf("film.webm"), "libvpx-vp9"));
  EXPECT_TRUE(has(settingsOf("film.webp"), "libwebp_anim"));
  EXPECT_TRUE(has(settingsOf("film.gif"), "gif"));
  EXPECT_TRUE(has(settingsOf("film.mp4", "av1"), "libsvtav1"));
  EXPECT_TRUE(has(settingsOf("film.mp4", "vp9"), "libvpx-vp9"));
  EXPECT_TRUE(has(settingsOf("film.webm", "av1"), "libsvtav1"));
}

TEST(VideoFormat, whatCannotBeMadeIsNamedWithWhatCan) {
  EXPECT_EQ(
      errorOf(settingsOf("film.avi")),
      "film.avi: found a video's name that ends in '.avi', expected one of: .mp4, .mkv, .webm, .webp, .gif");
  EXPECT_EQ(errorOf(settingsOf("film")),
            "film: found a video's name that ends in '', expected one of: .mp4, .mkv, .webm, .webp, .gif");
  EXPECT_EQ(errorOf(settingsOf("film.webm", "h264")),
            "film.webm: found codec 'h264', expected for .webm one of: vp9, av1");
  EXPECT_EQ(errorOf(settingsOf("film.gif", "av1")),
            "film.gif: found codec 'av1', expected for .gif one of: gif");
  EXPECT_EQ(errorOf(settingsOf("film.mp4")), "");
}

TEST(VideoFormat, gifIsNoFasterThanPlayersPlayIt) {
  VideoSettings settings = settingsOf("film.gif");
  settings.rateNumerator = 50;
  EXPECT_EQ(errorOf(settings), "");
  settings.rateNumerator = 60;
  EXPECT_NE(errorOf(settings).find("found 60/1 frames per second, expected at most 50"), std::string::npos)
      << errorOf(settings);
  settings.path = "film.webp";
  EXPECT_EQ(errorOf(settings), "");
}

TEST(VideoFormat, soundGoesWhereThereIsAPlaceForIt) {
  VideoSettings settings = settingsOf("film.mp4");
  settings.sound = "RIFF";
  const auto commandOf = [](const VideoSettings& video) { return ffmpegCommand(video, "out", "/tmp/sound"); };
  const auto hasWord = [](const std::vector<std::string>& command, const char* word) {
    return std::find(command.begin(), command.end(), word) != command.end();
  };
  EXPECT_EQ(errorOf(settings), "");
  EXPECT_TRUE(hasWord(commandOf(settings), "aac"));
  EXPECT_TRUE(hasWord(commandOf(settings), "file:/tmp/sound"));
  EXPECT_FALSE(has(settings, "aac")) << "there is no file of it";
  settings.path = "film.webm";
  EXPECT_TRUE(hasWord(commandOf(settings), "libopus"));
  settings.path = "film.webp";
  EXPECT_EQ(errorOf(settings),
            "film.webp: found .webp, which has no sound, expected .mp4, .mkv or .webm for a film with sound");
}

// Else gradients in the dark show blocks: on the walls of careen.json, edges of 8 px are 1.7 times as strong
// as what is between them without the strength, and 1.08 times with it.
TEST(VideoFormat, flatAndDarkPartsGetTheirBits) {
  for (const char* quality : {"good", "best"}) {
    VideoSettings settings = settingsOf("film.mp4");
    settings.quality = videoQualityNamed(quality);
    EXPECT_TRUE(has(settings, "-aq-mode")) << quality;
    EXPECT_TRUE(has(settings, "-aq-strength")) << quality;
  }
}

TEST(VideoFormat, qualitiesHaveNamesAndDiffer) {
  EXPECT_THROW(videoQualityNamed("ultra"), InputError);
  for (const char* name : {"film.mp4", "film.webm", "film.webp", "film.gif"}) {
    VideoSettings settings = settingsOf(name);
    std::vector<std::vector<std::string>> commands;
    for (const char* quality : {"draft", "good", "best"}) {
      settings.quality = videoQualityNamed(quality);
      commands.push_back(ffmpegCommand(settings, "out"));
    }
    EXPECT_NE(commands[0], commands[1]) << name;
    EXPECT_NE(commands[1], commands[2]) << name;
  }
}

}  // namespace
}  // namespace careen
