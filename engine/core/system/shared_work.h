#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>

namespace careen {

inline constexpr int kMostProcesses = 1024;

/// Does `work` for each index from 0 to count − 1 in this many forked processes (at most one an index), each
/// of which takes the next index that nobody has taken. `done` is called here after each, in any order.
/// Rethrows an error of `work` by its exit code and message, after the others have finished their index;
/// Interrupted if asked to stop; MachineError if a process dies. What `work` changes in memory is lost: it
/// writes files.
void shareWork(std::int64_t count, int processes, const std::function<void(std::int64_t)>& work,
               const std::function<void(std::int64_t)>& done = {}, const std::stop_token& stop = {});

}  // namespace careen
