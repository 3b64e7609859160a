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
  EXPECT_TRUE(has(settingsOf("film.mov"), "prores_ks"));
  EXPECT_TRUE(has(settingsOf("film.apng"), "apng"));
  EXPECT_TRUE(has(settingsOf("film.mp4", "av1"), "libsvtav1"));
  EXPECT_TRUE(has(settingsOf("film.mp4", "vp9"), "libvpx-vp9"));
  EXPECT_TRUE(has(settingsOf("film.webm", "av1"), "libsvtav1"));
}

TEST(VideoFormat, whatCannotBeMadeIsNamedWithWhatCan) {
  EXPECT_EQ(
      errorOf(settingsOf("film.avi")),
      "film.avi: found a video's name that ends in '.avi', expected one of: .mp4, .mkv, .mov, .webm, .webp, "
      ".gif, .apng");
  EXPECT_EQ(
      errorOf(settingsOf("film")),
      "film: found a video's name that ends in '', expected one of: .mp4, .mkv, .mov, .webm, .webp, .gif, "
      ".apng");
  EXPECT_EQ(errorOf(settingsOf("film.webm", "h264")),
            "film.webm: found codec 'h264', expected for .webm one of: vp9, vp9-444, av1");
  EXPECT_EQ(errorOf(settingsOf("film.gif", "av1")),
            "film.gif: found codec 'av1', expected for .gif one of: gif");
  EXPECT_EQ(errorOf(settingsOf("film.mp4")), "");
}

TEST(VideoFormat, gifIsNoFasterThanPlayersPlayIt) {
  VideoSettings settings = settingsOf("film.gif");
  settings.rateNumerator = 50;
  EXPECT_EQ(fallbackRate(settings), 0);
  const auto thins = [](const VideoSettings& video) {
    const std::vector<std::string> command = ffmpegCommand(video, "out");
    return std::any_of(command.begin(), command.end(),
                       [](const std::string& word) { return word.find("fps=50") != std::string::npos; });
  };
  EXPECT_FALSE(thins(settings));
  settings.rateNumerator = 60;
  EXPECT_EQ(errorOf(settings), "");
  EXPECT_EQ(fallbackRate(settings), 50);
  EXPECT_TRUE(thins(settings));
  settings.path = "film.webp";
  EXPECT_EQ(fallbackRate(settings), 0);
  EXPECT_FALSE(thins(settings));
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
            "film.webp: found .webp, which has no sound, expected one of: .mp4, .mkv, .mov, .webm");
}

TEST(VideoFormat, alphaGoesWhereThereIsAPlaceForIt) {
  VideoSettings settings = settingsOf("film.mov");
  EXPECT_TRUE(has(settings, "rgb24"));
  settings.alpha = true;
  for (const char* path : {"film.mov", "film.webm", "film.webp", "film.apng"}) {
    settings.path = path;
    EXPECT_EQ(errorOf(settings), "") << path;
    EXPECT_TRUE(has(settings, "rgba")) << path;
    EXPECT_FALSE(has(settings, "rgb24")) << path;
  }
  settings.path = "film.gif";
  EXPECT_EQ(errorOf(settings),
            "film.gif: found .gif, which has no alpha, expected one of: .mkv, .mov, .webm, .webp, .apng");
  settings.path = "film.mkv";
  EXPECT_EQ(errorOf(settings), "film.mkv: found .mkv by codec 'h264', which has no alpha, expected vp9");
  settings.codec = "vp9";
  EXPECT_EQ(errorOf(settings), "");
  settings.path = "film.mov";
  settings.codec = "h264";
  EXPECT_EQ(errorOf(settings), "film.mov: found .mov by codec 'h264', which has no alpha, expected prores");
}

TEST(VideoFormat, onlyHalvedChromaNeedsAnEvenSize) {
  EXPECT_TRUE(needsEvenSize(settingsOf("film.mp4")));
  EXPECT_FALSE(needsEvenSize(settingsOf("film.mp4", "h264-444")));
  EXPECT_FALSE(needsEvenSize(settingsOf("film.mov")));
  EXPECT_TRUE(needsEvenSize(settingsOf("film.mov", "h264")));
  EXPECT_FALSE(needsEvenSize(settingsOf("film.apng")));
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
  for (const char* name : {"film.mp4", "film.mov", "film.webm", "film.webp", "film.gif", "film.apng"}) {
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
