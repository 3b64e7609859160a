#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "image/picture.h"

namespace careen {

struct VideoSettings {
  std::filesystem::path path;
  int width = 0;                    ///< [px] odd sizes get one more column or row of black
  int height = 0;                   ///< [px]
  std::int64_t rateNumerator = 30;  ///< frames per second, exactly: numerator / denominator
  std::int64_t rateDenominator = 1;
};

/// Hands frames to ffmpeg, which makes an H.264 film (yuv420p, playable while it loads). The film appears at
/// its path whole, with finish(), or not at all. MachineError if ffmpeg is missing or fails, with what it
/// said.
class VideoPipe {
 public:
  explicit VideoPipe(VideoSettings settings);
  /// Without finish(): ffmpeg is ended and nothing stays.
  ~VideoPipe();
  VideoPipe(const VideoPipe&) = delete;
  VideoPipe& operator=(const VideoPipe&) = delete;
  VideoPipe(VideoPipe&&) = delete;
  VideoPipe& operator=(VideoPipe&&) = delete;

  void write(const Picture& picture);
  void finish();
  /// Makes a write at work in another thread fail, so that nothing waits for ffmpeg any more.
  void hangUp();

 private:
  void start();
  void undo();
  int wait();
  [[noreturn]] void fail(const std::string& what);

  VideoSettings settings_;
  std::filesystem::path partial_;
  int frames_ = -1;  // socket to ffmpeg's standard input
  int log_ = -1;     // what ffmpeg says
  int process_ = 0;  // 0: none at work
};

}  // namespace careen
