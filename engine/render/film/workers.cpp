#include "render/film/workers.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>

#include "core/error.h"

namespace careen {
namespace {

constexpr std::size_t kLongestText = 4000;

struct Order {
  std::int64_t index = 0;
  std::int64_t frame = 0;
};

// Message from a worker: first that it is ready, then for each frame that it is done, or an error.
struct Report {
  ExitCode code = ExitCode::kDone;
  std::int64_t index = -1;
  FrameFigures figures;
  std::array<char, kLongestText> text{};  // renderer name or error message

  void say(std::string_view words) {
    words = words.substr(0, text.size() - 1);
    *std::copy(words.begin(), words.end(), text.begin()) = '\0';
  }
};

void serve(const Channel& channel, const std::function<FrameWorkshop()>& prepare) {
  Report report;
  try {
    const FrameWorkshop workshop = prepare();
    report.say(workshop.renderer);
    for (Order order; channel.send(report) && channel.receive(order);) {
      report.index = order.index;
      report.figures = workshop.work(order.index, order.frame);
    }
    return;
  } catch (const Error& error) {
    report.code = error.code();
    report.say(error.what());
  } catch (const std::bad_alloc&) {
    report.code = ExitCode::kMachineFailed;
    report.say("out of memory");
  } catch (const std::exception& error) {
    report.code = ExitCode::kMachineFailed;
    report.say(error.what());
  }
  channel.send(report);
}

void throwIfFailed(const Report& report) {
  switch (report.code) {
    case ExitCode::kDone:
      return;
    case ExitCode::kBadInput:
      throw InputError(report.text.data());
    case ExitCode::kMachineFailed:
      throw MachineError(report.text.data());
    default:
      throw Error(report.code, report.text.data());
  }
}

}  // namespace

FilmWorkers::FilmWorkers(int count, const std::function<FrameWorkshop()>& prepare) {
  for (int i = 0; i < count; ++i) {
    desks_.emplace_back([&prepare](const Channel& channel) { serve(channel, prepare); });
  }
  Report report;
  for (Desk& desk : desks_) {
    if (!desk.worker.channel().receive(report)) {
      failWith(desk);
    }
    throwIfFailed(report);
    renderer_ = report.text.data();
  }
}

FilmWorkers::~FilmWorkers() {
  for (const Desk& desk : desks_) {
    desk.worker.channel().shutDown();
  }
}

bool FilmWorkers::hasIdle() const {
  return std::any_of(desks_.begin(), desks_.end(), [](const Desk& desk) { return desk.frame < 0; });
}

void FilmWorkers::give(std::int64_t index, std::int64_t frame) {
  const auto idle =
      std::find_if(desks_.begin(), desks_.end(), [](const Desk& desk) { return desk.frame < 0; });
  idle->frame = frame;
  if (!idle->worker.channel().send(Order{.index = index, .frame = frame})) {
    failWith(*idle);
  }
}

std::vector<FilmWorkers::Done> FilmWorkers::wait(int writable, std::chrono::milliseconds most) {
  std::vector<pollfd> sources = {{.fd = writable, .events = POLLOUT, .revents = 0}};
  for (const Desk& desk : desks_) {
    sources.push_back({.fd = desk.worker.channel().descriptor(), .events = POLLIN, .revents = 0});
  }
  std::vector<Done> done;
  if (poll(sources.data(), sources.size(), static_cast<int>(most.count())) <= 0) {
    return done;
  }
  auto source = sources.begin() + 1;
  for (Desk& desk : desks_) {
    if ((source++)->revents == 0) {
      continue;
    }
    Report report;
    if (!desk.worker.channel().receive(report)) {
      failWith(desk);
    }
    throwIfFailed(report);
    done.push_back({.index = report.index, .figures = report.figures});
    desk.frame = -1;
  }
  return done;
}

double FilmWorkers::finish() {
  double coreSeconds = 0;
  for (const Desk& desk : desks_) {
    desk.worker.channel().shutDown();
  }
  for (Desk& desk : desks_) {
    const WorkerEnd& end = desk.worker.end();
    if (!end.fault.empty()) {
      failWith(desk);
    }
    coreSeconds += end.coreSeconds;
  }
  return coreSeconds;
}

void FilmWorkers::failWith(Desk& desk) {
  const std::string fault = desk.worker.end().fault;
  const std::string doing = desk.frame < 0 ? "" : "frame " + std::to_string(desk.frame) + ": ";
  throw MachineError(doing +
                     "a process that draws frames died: " + (fault.empty() ? "it closed its line" : fault));
}

}  // namespace careen
