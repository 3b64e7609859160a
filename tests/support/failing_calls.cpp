// A library to preload: CAREEN_FAIL=write:17 lets the 17th such call of the program named by CAREEN_FAIL_IN,
// its forked processes included, fail; all others go through. What is written to the standard streams does
// not count, so that the program can tell. CAREEN_FAILED names a file that is made when the call has failed.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

enum Kind { kNone, kWrite, kSend, kClose, kRename, kFork, kOpen, kMalloc };
constexpr const char* kNames[] = {"", "write", "send", "close", "rename", "fork", "open", "malloc"};

Kind failing = kNone;
long failingCall = 0;
std::atomic<long>* calls = nullptr;  // shared with forked processes
const char* mark = nullptr;

[[gnu::constructor]] void start() {
  const char* const wanted = std::getenv("CAREEN_FAIL");
  const char* const in = std::getenv("CAREEN_FAIL_IN");
  char path[4096] = {};
  if (wanted == nullptr || in == nullptr || readlink("/proc/self/exe", path, sizeof path - 1) < 0 ||
      std::strcmp(path, in) != 0) {
    return;
  }
  void* const shared =
      mmap(nullptr, sizeof(std::atomic<long>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  calls = new (shared) std::atomic<long>(0);
  mark = std::getenv("CAREEN_FAILED");
  const char* const colon = std::strchr(wanted, ':');
  failingCall = std::atol(colon + 1);
  for (int kind = kWrite; kind <= kMalloc; ++kind) {
    const std::size_t length = std::strlen(kNames[kind]);
    if (std::strncmp(wanted, kNames[kind], length) == 0 && wanted + length == colon) {
      failing = static_cast<Kind>(kind);
    }
  }
}

template <class Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool fails(Kind kind, int error) {
  if (kind != failing || calls->fetch_add(1) + 1 != failingCall) {
    return false;
  }
  failing = kNone;
  if (mark != nullptr) {
    ::close(::open(mark, O_CREAT | O_WRONLY | O_CLOEXEC, 0600));
  }
  errno = error;
  return true;
}

bool isStandard(int descriptor) { return descriptor <= STDERR_FILENO; }

// What was only read is closed without harm.
bool mayWrite(int descriptor) {
  const int how = fcntl(descriptor, F_GETFL);
  return how >= 0 && (how & O_ACCMODE) != O_RDONLY;
}

}  // namespace

extern "C" {

ssize_t write(int to, const void* bytes, size_t count) {
  static auto* const call = original<ssize_t(int, const void*, size_t)>("write");
  return !isStandard(to) && fails(kWrite, ENOSPC) ? -1 : call(to, bytes, count);
}

ssize_t send(int to, const void* bytes, size_t count, int flags) {
  static auto* const call = original<ssize_t(int, const void*, size_t, int)>("send");
  return fails(kSend, ENOMEM) ? -1 : call(to, bytes, count, flags);
}

int close(int descriptor) {
  static auto* const call = original<int(int)>("close");
  if (!isStandard(descriptor) && mayWrite(descriptor) && fails(kClose, EIO)) {
    call(descriptor);
    errno = EIO;
    return -1;
  }
  return call(descriptor);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const call = original<int(const char*, const char*)>("rename");
  return fails(kRename, EIO) ? -1 : call(from, to);
}

pid_t fork() noexcept {
  static auto* const call = original<pid_t()>("fork");
  return fails(kFork, EAGAIN) ? -1 : call();
}

int open(const char* path, int how, ...) {
  static auto* const call = original<int(const char*, int, ...)>("open");
  __builtin_va_list arguments;
  __builtin_va_start(arguments, how);
  const mode_t mode = (how & O_CREAT) != 0 ? __builtin_va_arg(arguments, mode_t) : 0;
  __builtin_va_end(arguments);
  const bool creates = (how & O_CREAT) != 0 && (mark == nullptr || std::strcmp(path, mark) != 0);
  return creates && fails(kOpen, ENOSPC) ? -1 : call(path, how, mode);
}

void* malloc(size_t size) noexcept {
  static auto* const call = original<void*(size_t)>("malloc");
  return fails(kMalloc, ENOMEM) ? nullptr : call(size);
}

}  // extern "C"
