#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "image/picture.h"
#include "image/video_pipe.h"

namespace careen {

/// Name of a frame's file: 000000.png for frame 0.
std::string frameFileName(std::int64_t frame);

/// Writes frames on a thread of its own while the next one is drawn: to PNG files in a folder and, if there
/// is a video, to that. What goes wrong there is thrown by every call after it.
class FrameWriter {
 public:
  explicit FrameWriter(std::filesystem::path folder, std::unique_ptr<VideoPipe> video = nullptr);
  /// Without finish(): a frame begun is written, those that wait are dropped, the video does not appear.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;
  FrameWriter(FrameWriter&&) = delete;
  FrameWriter& operator=(FrameWriter&&) = delete;

  /// Waits while two frames wait already.
  void push(std::int64_t frame, Picture picture);
  /// The frame's file is there: it is read back for the video.
  void pushWritten(std::int64_t frame);
  /// Waits for all to be written; nothing may be pushed after it.
  void finish();

  /// What writing took so far [s]: time of the thread's core, and by the clock. ffmpeg's own is not in it.
  double coreSeconds() const;
  double wallSeconds() const;

 private:
  struct Job {
    std::int64_t frame = 0;
    std::optional<Picture> picture;
  };

  void enqueue(Job job);
  void work();
  void write(Job& job) const;
  void close(bool dropWaiting);

  std::filesystem::path folder_;
  std::unique_ptr<VideoPipe> video_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> waiting_;
  std::exception_ptr error_;
  bool closed_ = false;
  double coreSeconds_ = 0;
  double wallSeconds_ = 0;
  std::thread thread_;  // last: begins when all the rest is there
};

}  // namespace careen
