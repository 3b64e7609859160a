#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace careen {

/// Tells when a file has been written, by the time of its last write.
class FileWatch {
 public:
  /// Make it before the file is read, so that nothing written meanwhile is missed.
  explicit FileWatch(std::filesystem::path path)
      : path_(std::move(path)), known_(lastWrite()), seen_(known_) {}

  /// To be asked a few times a second: true once for each change, when the file has kept still since the last
  /// time it was asked, for whoever writes it may not be done. A file that is gone has not changed.
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
