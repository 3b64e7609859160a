#include "core/system/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "core/error.h"

namespace careen {
namespace {

bool isAt(int descriptor, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat there {};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &there) == 0 &&
         opened.st_dev == there.st_dev && opened.st_ino == there.st_ino;
}

}  // namespace

// Locks a file open for writing, because NFS cannot lock a folder exclusively, nor a file open for reading
// only: flock(2), "NFS details".
FolderLock::FolderLock(const std::filesystem::path& folder, LockKind kind)
    : file_(folder / kFileName), kind_(kind) {
  const int how = (kind == LockKind::kShared ? LOCK_SH : LOCK_EX) | LOCK_NB;
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(1);
  while ((descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666)) >= 0) {
    const bool taken = flock(descriptor_, how) != 0 && errno == EWOULDBLOCK;
    if (!taken && isAt(descriptor_, file_)) {
      cleanup_.emplace([this] { removeFile(); });
      return;
    }
    close(descriptor_);  // taken, or just removed by its previous owner
    if (std::chrono::steady_clock::now() > patience) {
      throw InputError(folder.string() + ": another careen is writing there; expected a folder for each");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

FolderLock::~FolderLock() {
  cleanup_.reset();
  if (descriptor_ >= 0) {
    removeFile();
    close(descriptor_);
  }
}

// Only while the lock is exclusive, so that no other process holds one on this file. Of several that end
// together, the last gets it so.
void FolderLock::removeFile() const {
  if (kind_ == LockKind::kExclusive || flock(descriptor_, LOCK_EX | LOCK_NB) == 0) {
    unlink(file_.c_str());
  }
}

}  // namespace careen
