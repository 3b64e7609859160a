#include "core/system/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace careen {

// Two processes may write the same file: each has its own partial file, and the last one to finish replaces
// the file as a whole.
std::filesystem::path partialPath(const std::filesystem::path& path) {
  const std::string name =
      "." + path.filename().string() + "." + std::to_string(getpid()) + std::string(kPartialSuffix);
  return path.parent_path() / name;
}

int createNew(const std::filesystem::path& path) {
  constexpr int kHow = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  const int made = open(path.c_str(), kHow, 0666);
  if (made >= 0 || errno != EEXIST) {
    return made;
  }
  unlink(path.c_str());  // the link itself, not what it names
  return open(path.c_str(), kHow, 0666);
}

bool isSameFile(const std::filesystem::path& one, const std::filesystem::path& other) {
  std::error_code none;
  if (std::filesystem::equivalent(one, other, none)) {  // device and inode
    return true;
  }
  const auto place = [&none](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, none), none);
  };
  return place(one) == place(other);
}

namespace {

// A link stays, and what it names is written.
std::filesystem::path placeOf(std::filesystem::path path) {
  std::error_code none;
  if (std::filesystem::is_symlink(path, none)) {
    const std::filesystem::path named = std::filesystem::canonical(path, none);
    return named.empty() ? path : named;
  }
  return path;
}

// A file in the place of a device or a pipe would end it for everyone.
bool isStream(const std::filesystem::path& path) {
  std::error_code none;
  const auto type = std::filesystem::status(path, none).type();
  using Type = std::filesystem::file_type;
  return type == Type::character || type == Type::block || type == Type::fifo || type == Type::socket;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(placeOf(std::move(path))),
      partial_(isStream(path_) ? std::filesystem::path() : partialPath(path_)),
      descriptor_(partial_.empty() ? open(path_.c_str(), O_WRONLY | O_CLOEXEC) : createNew(partial_)),
      cleanup_([this] { unlink(partial_.c_str()); }) {
  if (descriptor_ < 0) {
    fail("cannot be written");
  }
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
  if (!committed_ && !partial_.empty()) {
    unlink(partial_.c_str());
  }
}

void AtomicFile::write(std::string_view bytes) {
  constexpr std::size_t kPiece = std::size_t{1} << 16U;
  pending_ += bytes;
  if (pending_.size() >= kPiece) {
    flush();
  }
}

void AtomicFile::flush() {
  for (std::string_view left = pending_; !left.empty();) {
    const ssize_t count = ::write(descriptor_, left.data(), left.size());
    if (count < 0 && errno != EINTR) {
      fail("cannot be written");
    }
    left.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(0, count)));
  }
  pending_.clear();
}

void AtomicFile::commit() {
  flush();
  if (close(std::exchange(descriptor_, -1)) != 0) {  // some disks say only here that they are full
    fail("cannot be written");
  }
  std::error_code error;
  if (!partial_.empty()) {
    std::filesystem::rename(partial_, path_, error);
  }
  if (error) {
    errno = error.value();
    fail("cannot be put in place");
  }
  committed_ = true;
}

void AtomicFile::fail(const std::string& what) const {
  const int code = errno;
  throw MachineError(path_.string() + ": " + what + ": " + std::strerror(code));
}

std::string readFile(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) {
    throw InputError(path.string() + ": is a folder, expected a file");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw InputError(path.string() + ": cannot be read: " + std::strerror(errno));
  }
  const bool onDisk = std::filesystem::is_regular_file(path);
  std::string text;
  std::array<char, 65536> piece{};
  while (stream.read(piece.data(), piece.size()) || stream.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (!onDisk && text.size() > kMostStreamed) {
      throw InputError(path.string() + ": found more than 1 GiB that is no file on a disk, expected less");
    }
  }
  if (stream.bad()) {
    throw InputError(path.string() + ": cannot be read: " + std::strerror(errno));
  }
  return text;
}

void writeFile(const std::filesystem::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace careen
