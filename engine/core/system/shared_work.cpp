#include "core/system/shared_work.h"

#include <poll.h>

#include <algorithm>
#include <array>
#include <exception>
#include <list>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/system/worker.h"

namespace careen {
namespace {

constexpr std::size_t kLongestText = 4000;
constexpr int kPatience = 100;  // [ms] between checks of the stop token

struct Reply {
  std::int64_t index = -1;
  ExitCode code = ExitCode::kDone;
  std::array<char, kLongestText> text{};  // error message

  void fail(ExitCode with, std::string_view words) {
    code = with;
    words = words.substr(0, text.size() - 1);
    std::copy(words.begin(), words.end(), text.begin());
  }
};

void serve(const Channel& channel, const std::function<void(std::int64_t)>& work) {
  std::int64_t index = 0;
  while (channel.receive(index)) {
    Reply reply{.index = index};
    try {
      work(index);
    } catch (const Error& error) {
      reply.fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
      reply.fail(ExitCode::kMachineFailed, "out of memory");
    } catch (const std::exception& error) {
      reply.fail(ExitCode::kMachineFailed, error.what());
    }
    if (!channel.send(reply) || reply.code != ExitCode::kDone) {
      return;
    }
  }
}

struct Desk {
  explicit Desk(const std::function<void(const Channel&)>& work) : worker(work) {}
  Worker worker;
  bool busy = false;
};

}  // namespace

void shareWork(std::int64_t count, int processes, const std::function<void(std::int64_t)>& work,
               const std::function<void(std::int64_t)>& done, const std::stop_token& stop) {
  std::list<Desk> desks;
  for (std::int64_t i = 0; i < std::min<std::int64_t>(processes, count); ++i) {
    desks.emplace_back([&work](const Channel& channel) { serve(channel, work); });
  }
  std::int64_t next = 0;
  const auto giveOne = [&](Desk& desk) {
    desk.busy = next < count && !stop.stop_requested();
    if (desk.busy && !desk.worker.channel().send(next++)) {
      throw MachineError("a job died: " + desk.worker.end().fault);
    }
  };
  for (Desk& desk : desks) {
    giveOne(desk);
  }
  const auto isBusy = [](const Desk& desk) { return desk.busy; };
  while (std::any_of(desks.begin(), desks.end(), isBusy)) {
    std::vector<pollfd> readable;
    std::vector<Desk*> asked;
    for (Desk& desk : desks) {
      if (desk.busy) {
        readable.push_back({.fd = desk.worker.channel().descriptor(), .events = POLLIN, .revents = 0});
        asked.push_back(&desk);
      }
    }
    poll(readable.data(), readable.size(), kPatience);
    for (std::size_t i = 0; i < readable.size(); ++i) {
      if (readable[i].revents == 0) {
        continue;
      }
      Reply reply;
      if (!asked[i]->worker.channel().receive(reply)) {
        throw MachineError("a job died: " + asked[i]->worker.end().fault);
      }
      if (reply.code != ExitCode::kDone) {
        throw Error(reply.code, reply.text.data());
      }
      if (done) {
        done(reply.index);
      }
      giveOne(*asked[i]);
    }
  }
  if (stop.stop_requested() && next < count) {
    throw Interrupted();
  }
}

}  // namespace careen
