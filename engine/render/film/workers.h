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

/// What a worker does with a frame, in its own process.
using FrameWork = std::function<FrameFigures(std::int64_t index, std::int64_t frame)>;

/// Makes ready to work, in the process that will: opens GL and says who draws.
struct FrameWorkshop {
  std::string renderer;
  FrameWork work;
};

/// Processes that draw frames side by side. Several contexts of software GL in one process take turns, those
/// of several processes do not. Forked, so that every one has the scene and its run in memory.
class FilmWorkers {
 public:
  /// Returns when all of them are ready. What cannot be made ready there is thrown here.
  FilmWorkers(int count, const std::function<FrameWorkshop()>& prepare);
  /// Each finishes the frame at hand.
  ~FilmWorkers();
  FilmWorkers(const FilmWorkers&) = delete;
  FilmWorkers& operator=(const FilmWorkers&) = delete;
  FilmWorkers(FilmWorkers&&) = delete;
  FilmWorkers& operator=(FilmWorkers&&) = delete;

  /// Who draws; empty if there are no workers.
  const std::string& renderer() const { return renderer_; }
  bool hasIdle() const;
  /// Hands frame to an idle worker; the index comes back with it.
  void give(std::int64_t index, std::int64_t frame);

  struct Done {
    std::int64_t index = 0;
    FrameFigures figures;
  };
  /// Waits until a frame is done, `writable` can be written to (-1: none such) or the time is over. What went
  /// wrong in a worker is thrown; MachineError if one died.
  std::vector<Done> wait(int writable, std::chrono::milliseconds most);

  /// Ends them all; [s] that they took of all cores.
  double finish();

 private:
  struct Desk {
    explicit Desk(const std::function<void(const Channel&)>& work) : worker(work) {}
    Worker worker;
    std::int64_t frame = -1;  // at hand, -1: idle
  };
  [[noreturn]] static void failWith(Desk& desk);

  std::list<Desk> desks_;
  std::string renderer_;
};

}  // namespace careen
