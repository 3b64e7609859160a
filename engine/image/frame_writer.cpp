#include "image/frame_writer.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <utility>

#include "image/png.h"

namespace careen {
namespace {

constexpr std::size_t kMostWaiting = 2;

double threadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

std::string frameFileName(std::int64_t frame) {
  constexpr std::size_t kDigits = 6;
  const std::string number = std::to_string(frame);
  return std::string(kDigits - std::min(kDigits, number.size()), '0') + number + ".png";
}

FrameWriter::FrameWriter(std::filesystem::path folder, std::unique_ptr<VideoPipe> video)
    : folder_(std::move(folder)), video_(std::move(video)), thread_([this] { work(); }) {}

FrameWriter::~FrameWriter() {
  if (thread_.joinable()) {
    if (video_) {
      video_->hangUp();
    }
    close(true);
  }
}

void FrameWriter::push(std::int64_t frame, Picture picture) {
  enqueue({.frame = frame, .picture = std::move(picture)});
}

void FrameWriter::pushWritten(std::int64_t frame) {
  if (video_) {
    enqueue({.frame = frame, .picture = std::nullopt});
  }
}

void FrameWriter::finish() {
  close(false);
  if (error_) {
    std::rethrow_exception(error_);
  }
  if (video_) {
    video_->finish();
  }
}

double FrameWriter::coreSeconds() const {
  const std::lock_guard lock(mutex_);
  return coreSeconds_;
}

double FrameWriter::wallSeconds() const {
  const std::lock_guard lock(mutex_);
  return wallSeconds_;
}

void FrameWriter::enqueue(Job job) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting || error_; });
  if (error_) {
    std::rethrow_exception(error_);
  }
  waiting_.push_back(std::move(job));
  changed_.notify_all();
}

void FrameWriter::close(bool dropWaiting) {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    if (dropWaiting) {
      waiting_.clear();
    }
  }
  changed_.notify_all();
  thread_.join();
}

void FrameWriter::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) {
      return;
    }
    Job job = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    changed_.notify_all();
    const auto begun = std::chrono::steady_clock::now();
    const double coreBegun = threadSeconds();
    std::exception_ptr error;
    try {
      write(job);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    coreSeconds_ += threadSeconds() - coreBegun;
    wallSeconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    if (error) {
      error_ = std::move(error);
      waiting_.clear();
      changed_.notify_all();
      return;
    }
  }
}

void FrameWriter::write(Job& job) const {
  const std::filesystem::path path = folder_ / frameFileName(job.frame);
  if (job.picture) {
    writePng(path, *job.picture);
  } else {
    job.picture = readPng(path);
  }
  if (video_) {
    video_->write(*job.picture);
  }
}

}  // namespace careen
