#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include "core/system/worker.h"
#include "render/film/film.h"

namespace careen {

/// Draws one frame, in the worker's process.
using FrameWork = std::function<FrameFigures(std::int64_t index, std::int64_t frame)>;

/// Result of setting up a worker in its own process, which opens GL: renderer name and drawing function.
struct FrameWorkshop {
  std::string renderer;
  FrameWork work;
};

/// Processes that draw frames in parallel. Software GL serializes several contexts of one process, but not
/// those of several processes. Forked, so that each has the scene and its run in memory.
class FilmWorkers {
 public:
  /// Returns when all workers are ready. Rethrows errors of `prepare` in a worker.
  FilmWorkers(int count, const std::function<FrameWorkshop()>& prepare);
  /// Each worker finishes its current frame.
  ~FilmWorkers();
  FilmWorkers(const FilmWorkers&) = delete;
  FilmWorkers& operator=(const FilmWorkers&) = delete;
  FilmWorkers(FilmWorkers&&) = delete;
  FilmWorkers& operator=(FilmWorkers&&) = delete;

  /// Renderer name; empty if there are no workers.
  const std::string& renderer() const { return renderer_; }
  bool hasIdle() const;
  /// Assigns a frame to an idle worker; `index` is returned with the result.
  void give(std::int64_t index, std::int64_t frame);

  struct Done {
    std::int64_t index = 0;
    FrameFigures figures;
  };
  /// Waits until a frame is done, the descriptor `writable` can be written to (-1: none) or the timeout
  /// `most` expires. Rethrows errors of workers; MachineError if one died.
  std::vector<Done> wait(int writable, std::chrono::milliseconds most);

  /// Ends all workers; returns their CPU time over all cores [s].
  double finish();

 private:
  struct Desk {
    explicit Desk(const std::function<void(const Channel&)>& work) : worker(work) {}
    Worker worker;
    std::int64_t frame = -1;  // current frame, -1: idle
  };
  [[noreturn]] static void failWith(Desk& desk);

  std::list<Desk> desks_;
  std::string renderer_;
};

}  // namespace careen
