#include "core/system/file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace careen {
namespace {

// Two processes may write the same file: each has its own partial file, and the last one to finish replaces
// the file as a whole.
std::filesystem::path partialPath(const std::filesystem::path& path) {
  const std::string name =
      "." + path.filename().string() + "." + std::to_string(getpid()) + std::string(kPartialSuffix);
  return path.parent_path() / name;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)),
      partial_(partialPath(path_)),
      stream_(partial_, std::ios::binary | std::ios::trunc),
      cleanup_([this] { unlink(partial_.c_str()); }) {
  if (!stream_) {
    fail("cannot be written");
  }
}

AtomicFile::~AtomicFile() {
  if (!committed_) {
    stream_.close();
    std::error_code ignored;
    std::filesystem::remove(partial_, ignored);
  }
}

void AtomicFile::write(std::string_view bytes) {
  if (!stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
    fail("cannot be written");
  }
}

void AtomicFile::commit() {
  stream_.close();  // flushes, so a full disk is noticed here at the latest
  if (!stream_) {
    fail("cannot be written");
  }
  std::error_code error;
  std::filesystem::rename(partial_, path_, error);
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
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
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
