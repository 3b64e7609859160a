#include "viewer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <numbers>
#include <utility>
#include <vector>

#include "core/brief.h"
#include "core/error.h"
#include "image/png.h"
#include "render/window/scrub_bar.h"

namespace careen {

const char* const kViewerHelp =
    "space             play, pause\n"
    "right left . ,    a frame on, a frame back\n"
    "home end          first frame, last frame\n"
    "0 ... 9           to so many tenths of the film\n"
    "n p               next scene of the folder, previous one\n"
    "s                 take a still\n"
    "c                 back to the film's camera\n"
    "r                 read the file again (it is when it changes)\n"
    "h ?               this\n"
    "q esc             quit\n"
    "mouse             drag the picture: turn the camera; the wheel: nearer, farther;\n"
    "                  drag the bar below: go through the film\n";

namespace {

constexpr int kMomentDigits = 6;                    // enough to tell frames apart
constexpr double kStopPatience = 0.1;               // [s] interval of checks for a stop request
constexpr double kLookEvery = 0.2;                  // [s] polling interval of the file
constexpr double kZoomOfNotch = 1 / 1.1;            // factor on the distance
constexpr double kTurnOfHeight = std::numbers::pi;  // [rad] for a drag over the height of the picture

// The file `by` places further among the files of its folder with the same extension, sorted by name,
// cyclic.
std::filesystem::path neighbour(const std::filesystem::path& path, int by) {
  std::vector<std::filesystem::path> names = {path.filename()};
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::directory_iterator(folder, unreadable)) {
    if (entry.is_regular_file(unreadable) && entry.path().extension() == path.extension() &&
        entry.path().filename() != path.filename()) {
      names.push_back(entry.path().filename());
    }
  }
  std::sort(names.begin(), names.end());
  const auto count = std::ssize(names);
  const auto place = std::find(names.begin(), names.end(), path.filename()) - names.begin();
  return path.parent_path() / names[static_cast<std::size_t>((place + by + count) % count)];
}

char32_t lowerCase(char32_t key) { return key >= U'A' && key <= U'Z' ? key - U'A' + U'a' : key; }

}  // namespace

namespace {

// A broken run is shown too: to look at it is the quickest way to understand it.
Run loadAudited(const std::filesystem::path& path, const ViewOptions& options, const std::stop_token& stop) {
  Overrides overrides = options.overrides;
  overrides.threads = options.picture.threadsOfCrowds();
  Run run = loadRun(path, overrides, options.scene, stop);
  AuditChoice choice = options.audit;
  choice.keepGoing = true;
  auditRun(run, choice, stop);
  for (const AuditBreach& breach : run.audit.breaches) {
    std::cerr << "careen: broken promise " << describe(breach, run.trajectory) << '\n';
  }
  return run;
}

}  // namespace

Viewer::Viewer(Window& window, const ViewOptions& options)
    : window_(window), options_(options), picked_(options.source), watch_(options.source) {}

Viewer::~Viewer() { cancelLoading(); }

void Viewer::run(const std::stop_token& stop) {
  open(loadAudited(picked_, options_, stop));
  if (!options_.paused) {
    show();  // the first picture takes the longest: it is not skipped
    player_->update(clock_.seconds());
    player_->toggle();
  }
  while (!done_ && !window_.isClosing()) {
    if (stop.stop_requested()) {
      throw Interrupted();
    }
    checkFile();
    finishLoading();
    player_->update(clock_.seconds());
    show();
    entitle();
    const WindowEvents events = window_.wait(patience());
    player_->update(clock_.seconds());  // input applies from now on
    handle(events);
  }
}

// A reloaded file continues at its previous position.
void Viewer::open(Run run) {
  auto screening = std::make_unique<Screening>(std::move(run), options_.picture);
  Player player(screening->rate(), screening->frameCount());
  player.update(clock_.seconds());
  const bool same = screening_ && screening_->run().source == screening->run().source;
  if (same) {
    player.seekTime(player_->time());
  } else {
    orbit_ = {};
  }
  if (player_ && player_->isPlaying()) {
    player.toggle();
  }
  screening_ = std::move(screening);
  player_ = player;
  stale_ = true;
}

void Viewer::beginLoading(const std::filesystem::path& path) {
  cancelLoading();
  picked_ = path;
  watch_ = FileWatch(path);
  stopLoading_ = {};
  loading_ = std::async(std::launch::async, [this, path, stop = stopLoading_.get_token()] {
    return loadAudited(path, options_, stop);
  });
}

void Viewer::cancelLoading() {
  stopLoading_.request_stop();
  if (loading_.valid()) {
    loading_.wait();
  }
  loading_ = {};
}

void Viewer::finishLoading() {
  if (!loading_.valid() || loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return;
  }
  try {
    open(loading_.get());
  } catch (const Error& error) {
    std::cerr << "careen: " << error.what() << "\ncareen: still showing " << screening_->run().source.string()
              << " as it was\n";
  }
}

void Viewer::checkFile() {
  if (clock_.seconds() - lookedAt_ < kLookEvery) {
    return;
  }
  lookedAt_ = clock_.seconds();
  if (watch_.hasChanged()) {
    beginLoading(picked_);
  }
}

// Redraws only if the picture has changed.
void Viewer::show() {
  if (!stale_ && player_->frame() == frame_) {
    return;
  }
  const Stopwatch drawing;
  picture_ = screening_->draw(player_->time(), orbit_);
  drawSeconds_ += drawing.seconds();
  const Stopwatch showing;
  window_.show(withScrubBar(picture_, player_->part()));
  showSeconds_ += showing.seconds();
  ++shown_;
  frame_ = player_->frame();
  stale_ = false;
}

void Viewer::entitle() {
  std::string title =
      screening_->run().source.filename().string() + ": frame " + std::to_string(player_->frame()) +
      " of 0-" + std::to_string(player_->lastFrame()) + ", " + brief(player_->time(), kMomentDigits) +
      " s, " + (player_->isPlaying() ? "playing" : "paused") + (orbit_ == Orbit() ? "" : ", camera turned") +
      (loading_.valid() ? ", loading " + picked_.filename().string() : "");
  if (title != title_) {
    window_.setTitle(title);
    title_ = std::move(title);
  }
}

double Viewer::patience() const {
  return player_->isPlaying() ? std::min(kStopPatience, player_->secondsToNext()) : kStopPatience;
}

void Viewer::handle(const WindowEvents& events) {
  for (const char32_t key : events.keys) {
    press(lowerCase(key));
  }
  for (const PointerDrag& each : events.drags) {
    drag(each);
  }
  if (events.scrolled != 0) {
    turn({.distance = std::pow(kZoomOfNotch, events.scrolled)});
  }
}

void Viewer::press(char32_t key) {
  if (key >= U'0' && key <= U'9') {
    player_->seek(0.1 * (key - U'0'));
    return;
  }
  switch (key) {
    case U' ':
      return player_->toggle();
    case kKeyRight:
    case U'.':
      return player_->step(1);
    case kKeyLeft:
    case U',':
      return player_->step(-1);
    case kKeyHome:
      return player_->seek(0);
    case kKeyEnd:
      return player_->seek(1);
    case U'n':
      return beginLoading(neighbour(picked_, 1));
    case U'p':
      return beginLoading(neighbour(picked_, -1));
    case U's':
      return takeStill();
    case U'c':
      orbit_ = {};
      stale_ = true;
      return;
    case U'r':
      return beginLoading(picked_);
    case U'h':
    case U'?':
      std::cout << kViewerHelp << std::flush;
      return;
    case U'q':
    case kKeyEscape:
      done_ = true;
      return;
    default:
      return;
  }
}

void Viewer::drag(const PointerDrag& drag) {
  if (drag.from.y() >= picture_.height) {
    player_->seek(partOnScrubBar(drag.to.x(), picture_.width));
  } else {
    const double scale = kTurnOfHeight / picture_.height;
    turn({.azimuth = -scale * drag.by.x(), .elevation = scale * drag.by.y()});
  }
}

void Viewer::turn(const Orbit& by) {
  const Orbit before = std::exchange(orbit_, turned(orbit_, screening_->filmCamera(player_->time()), by));
  stale_ = stale_ || orbit_ != before;
}

// Saves the picture shown. With the film's own camera it is the film's picture and overwrites itself;
// otherwise a number keeps it from overwriting another.
void Viewer::takeStill() {
  show();  // the key may have come together with other input
  const std::string name =
      screening_->run().source.stem().string() + "-" + brief(player_->time(), kMomentDigits);
  std::filesystem::path path = options_.folder / (name + ".png");
  for (int number = 1; orbit_ != Orbit() && (number == 1 || std::filesystem::exists(path)); ++number) {
    path = options_.folder / (name + "-turned-" + std::to_string(number) + ".png");
  }
  std::error_code error;
  std::filesystem::create_directories(options_.folder, error);  // if it failed, writing reports it
  try {
    writePng(path, picture_);
  } catch (const MachineError& problem) {  // not fatal to the viewer
    std::cerr << "careen: " << problem.what() << '\n';
    return;
  }
  std::cout << "picture      " << std::filesystem::absolute(path).lexically_normal().string() << std::endl;
}

}  // namespace careen
