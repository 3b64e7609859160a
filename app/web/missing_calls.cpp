// Calls that emscripten's C library declares but has not: there are no other processes, no threads and no
// choice of cores. All of them fail, as they may anywhere.
#include <sched.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>

namespace {

int missing() {
  errno = ENOSYS;
  return -1;
}

}  // namespace

extern "C" {

pid_t wait4(pid_t, int*, int, struct rusage*) { return missing(); }
int prctl(int, ...) { return missing(); }
int memfd_create(const char*, unsigned) { return missing(); }
int sched_getaffinity(pid_t, size_t, cpu_set_t*) { return missing(); }
int sched_setaffinity(pid_t, size_t, const cpu_set_t*) { return missing(); }
int __sched_cpucount(size_t, const cpu_set_t*) { return 1; }
int pthread_kill(pthread_t, int) { return ENOSYS; }
int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                 char* const[], char* const[]) {
  return ENOSYS;
}

}  // extern "C"
