#include "image/video_pipe.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/system/file.h"
#include "core/system/process.h"

namespace careen {
namespace {

// Removes what a killed run left behind: ".film.mp4.123.partial" if there is no process 123.
void removeStale(const std::filesystem::path& path) {
  const std::string start = "." + path.filename().string() + ".";
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    std::string name = entry.path().filename().string();
    if (!name.starts_with(start) || !name.ends_with(kPartialSuffix)) {
      continue;
    }
    name = name.substr(start.size(), name.size() - start.size() - kPartialSuffix.size());
    const bool isNumber =
        !name.empty() && name.size() < 10 && name.find_first_not_of("0123456789") == std::string::npos;
    if (isNumber && (std::stoi(name) == getpid() || (kill(std::stoi(name), 0) != 0 && errno == ESRCH))) {
      std::filesystem::remove(entry.path(), ignored);
    }
  }
}

void closeAndForget(int& descriptor) {
  if (descriptor >= 0) {
    close(std::exchange(descriptor, -1));
  }
}

}  // namespace

VideoPipe::VideoPipe(VideoSettings settings) : settings_(std::move(settings)) {
  checkVideo(settings_);
  removeStale(settings_.path);
  partial_ = settings_.path.parent_path() / ("." + settings_.path.filename().string() + "." +
                                             std::to_string(getpid()) + std::string(kPartialSuffix));
  // Fail now rather than after the last frame.
  const int probe = createNew(partial_);
  if (probe < 0) {
    throw MachineError(settings_.path.string() + ": cannot be written: " + std::strerror(errno));
  }
  close(probe);
  cleanup_.emplace([this] {
    if (process_ != 0) {
      kill(process_, SIGKILL);
    }
    unlink(partial_.c_str());
  });
  try {
    start();
  } catch (...) {
    undo();
    throw;
  }
}

// As a file of this process that ffmpeg finds, and that is gone with it.
std::filesystem::path VideoPipe::keepSound() {
  if (settings_.sound.empty()) {
    return {};
  }
  sound_ = memfd_create("sound", MFD_CLOEXEC);
  std::string_view left = settings_.sound;
  while (sound_ >= 0 && !left.empty()) {
    const ssize_t count = ::write(sound_, left.data(), left.size());
    if (count < 0 && errno != EINTR) {
      throw MachineError(std::string("no memory for the sound of a video: ") + std::strerror(errno));
    }
    left.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(sound_);
}

void VideoPipe::start() {
  // A socket, not a pipe: send() can suppress SIGPIPE when ffmpeg has ended.
  std::array<int, 2> ends = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw MachineError(std::string("no socket to ffmpeg: ") + std::strerror(errno));
  }
  frames_ = ends[0];
  log_ = memfd_create("ffmpeg", MFD_CLOEXEC);
  const int error = startProgram(ffmpegCommand(settings_, partial_, keepSound()),
                                 {.input = ends[1], .log = log_}, process_);
  close(ends[1]);
  if (error != 0) {
    process_ = 0;
    throw MachineError(settings_.path.string() + ": ffmpeg, which encodes the video, cannot be started: " +
                       std::strerror(error) + (error == ENOENT ? "; install it: apt install ffmpeg" : ""));
  }
}

VideoPipe::~VideoPipe() { undo(); }

std::size_t VideoPipe::write(std::span<const std::uint8_t> bytes) {
  while (true) {
    const ssize_t count = send(frames_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count >= 0) {
      return static_cast<std::size_t>(count);
    }
    if (errno == EAGAIN || errno == EWOULDBLOCK) {
      return 0;
    }
    if (errno != EINTR) {
      fail("ffmpeg ended before the video did");
    }
  }
}

void VideoPipe::finish() {
  closeAndForget(frames_);
  if (wait() != 0) {
    fail("ffmpeg failed");
  }
  std::error_code error;
  std::filesystem::rename(partial_, settings_.path, error);
  if (error) {
    throw MachineError(settings_.path.string() + ": cannot be put in place: " + error.message());
  }
  cleanup_.reset();
  closeAndForget(log_);
  closeAndForget(sound_);
  partial_.clear();
}

// The exit status, or 128 + signal as in a shell.
int VideoPipe::wait() {
  int status = 0;
  while (process_ != 0 && waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void VideoPipe::fail(const std::string& what) {
  const std::string tail = tailOf(log_);
  throw MachineError(settings_.path.string() + ": " + what + (tail.empty() ? "" : ": " + tail));
}

void VideoPipe::undo() {
  cleanup_.reset();
  if (process_ != 0) {
    kill(process_, SIGKILL);
    wait();
  }
  closeAndForget(frames_);
  closeAndForget(log_);
  closeAndForget(sound_);
  if (!partial_.empty()) {
    std::error_code ignored;
    std::filesystem::remove(partial_, ignored);
  }
}

}  // namespace careen
