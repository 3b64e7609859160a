#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace careen {

/// Detects by its modification time that a file was written.
class FileWatch {
 public:
  /// Create it before the file is read, so that no write in between is missed.
  explicit FileWatch(std::filesystem::path path)
      : path_(std::move(path)), known_(lastWrite()), seen_(known_) {}

  /// Poll a few times a second: true once per change, as soon as the modification time is unchanged since
  /// the previous call, because the writer may not be done. A deleted file has not changed.
  bool hasChanged() {
    const Time now = lastWrite();
    const bool still = std::exchange(seen_, now) == now;
    return still && now && std::exchange(known_, now) != now;
  }

 private:
  using Time = std::optional<std::filesystem::file_time_type>;

  Time lastWrite() const {
    std::error_code missing;
    const std::filesystem::file_time_type time = std::filesystem::last_write_time(path_, missing);
    return missing ? Time() : Time(time);
  }

  std::filesystem::path path_;
  Time known_;
  Time seen_;
};

}  // namespace careen
