#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// kDraft is quick to make and small, kBest takes its time.
enum class VideoQuality { kDraft, kGood, kBest };

struct VideoSettings {
  std::filesystem::path path;  ///< its suffix says what it becomes: .mp4, .mkv, .webm, .webp, .gif
  std::string codec = {};      ///< h264, vp9 or av1; empty: what is usual for the suffix
  VideoQuality quality = VideoQuality::kGood;
  int width = 0;                    ///< [px] odd sizes get one more column or row of black where they must
  int height = 0;                   ///< [px]
  std::int64_t rateNumerator = 30;  ///< frames per second, exactly: numerator / denominator
  std::int64_t rateDenominator = 1;
};

/// "draft", "good", "best"; InputError for another.
VideoQuality videoQualityNamed(std::string_view name);

/// InputError, naming what can be made, for a suffix, codec or rate that cannot; size and rate must be set.
void checkVideo(const VideoSettings& settings);

/// What makes ffmpeg read frames from its standard input, 8-bit RGB, and write the film to `output`. Films
/// are BT.709 with the transfer of sRGB and say so. The same frames give the same bytes.
std::vector<std::string> ffmpegCommand(const VideoSettings& settings, const std::filesystem::path& output);

}  // namespace careen
