// Scenes: read, checked, planned, and moved for a moment.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include "fuzz/fuzz.h"
#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

constexpr double kMoment = 0.02;  // [s]
constexpr std::size_t kFew = 6;   // bodies
constexpr auto kPatience = std::chrono::milliseconds(100);

// Asks a run to stop when it takes too long: that is not what is looked for here.
void move(RunSetup setup) {
  std::mutex mutex;
  std::condition_variable_any ended;
  std::stop_source stop;
  std::jthread watch([&](const std::stop_token& done) {
    std::unique_lock lock(mutex);
    ended.wait_for(lock, done, kPatience, [] { return false; });
    stop.request_stop();
  });
  record(std::move(setup), stop.get_token());
}

}  // namespace
}  // namespace careen

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace careen;
  fuzz::refusesOrReads([&] {
    Scene scene = parseScene(std::string(fuzz::textOf(data, size)), "scene");
    if (scene.boxes.size() <= kFew) {
      scene.settings.duration = std::min(scene.settings.duration, kMoment);
      try {
        move(setupOf(scene));
      } catch (const Interrupted&) {  // NOLINT(bugprone-empty-catch)
      }
    }
  });
  return 0;
}
