#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "core/system/cleanup.h"
#include "image/video_format.h"

namespace careen {

/// Sends frames to ffmpeg, which encodes the film. The film appears at its path as a whole with finish(), or
/// not at all. MachineError if ffmpeg is missing or fails, with its messages.
class VideoPipe {
 public:
  explicit VideoPipe(VideoSettings settings);
  /// Without finish(), it terminates ffmpeg and leaves no file.
  ~VideoPipe();
  VideoPipe(const VideoPipe&) = delete;
  VideoPipe& operator=(const VideoPipe&) = delete;
  VideoPipe(VideoPipe&&) = delete;
  VideoPipe& operator=(VideoPipe&&) = delete;

  /// Sends as many of these bytes as ffmpeg takes without waiting, and returns their number. Pictures follow
  /// each other without a gap: 8-bit RGB or RGBA, rows from the top.
  std::size_t write(std::span<const std::uint8_t> bytes);
  /// For poll: writable when ffmpeg takes more.
  int descriptor() const { return frames_; }
  void finish();

 private:
  void start();
  std::filesystem::path keepSound();
  void undo();
  int wait();
  [[noreturn]] void fail(const std::string& what);

  VideoSettings settings_;
  std::filesystem::path partial_;
  int frames_ = -1;  // socket to ffmpeg's standard input
  int sound_ = -1;   // file in memory
  int log_ = -1;     // ffmpeg's messages
  int process_ = 0;  // 0: not running
  std::optional<Cleanup> cleanup_;
};

}  // namespace careen
