#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// kDraft is fast and small, kBest is slow.
enum class VideoQuality { kDraft, kGood, kBest };

struct VideoSettings {
  std::filesystem::path path;  ///< its suffix selects the container: see the manual's page of films
  std::string codec = {};      ///< h264, vp9 or av1 …; empty: the default of the suffix
  VideoQuality quality = VideoQuality::kGood;
  int width = 0;                    ///< [px]
  int height = 0;                   ///< [px]
  std::int64_t rateNumerator = 30;  ///< frames per second, exactly: numerator / denominator
  std::int64_t rateDenominator = 1;
  bool alpha = false;      ///< its pictures are RGBA, else RGB
  std::string sound = {};  ///< its sound, as the bytes of a WAV file; empty: none
};

/// "draft", "good", "best"; InputError for another.
VideoQuality videoQualityNamed(std::string_view name);

/// InputError for an unsupported suffix or codec, or one without a place for alpha or sound; the message
/// lists what is supported.
void checkVideo(const VideoSettings& settings);

/// Whether films of this format have even widths and heights: of an odd one, the last column or row comes
/// twice.
bool needsEvenSize(const VideoSettings& settings);

/// Frames per second that the file cannot have: what it has instead; 0 if it has those of the settings. Times
/// of a GIF are hundredths of a second, and players replace delays below two of them by ten.
int fallbackRate(const VideoSettings& settings);

/// The command with which ffmpeg reads frames from its standard input, 8-bit RGB, and writes the film to
/// `output`, with the sound in the file `sound` if there is one. Films are tagged as BT.709 with the sRGB
/// transfer function. The same frames give the same bytes.
std::vector<std::string> ffmpegCommand(const VideoSettings& settings, const std::filesystem::path& output,
                                       const std::filesystem::path& sound = {});

}  // namespace careen
