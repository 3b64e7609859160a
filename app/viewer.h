#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "file_watch.h"
#include "image/picture.h"
#include "picture_options.h"
#include "render/view/orbit.h"
#include "render/window/player.h"
#include "render/window/window.h"
#include "run.h"
#include "screening.h"

namespace careen {

struct ViewOptions {
  std::filesystem::path source;          ///< scene or trajectory file
  std::filesystem::path folder = "out";  ///< of the stills
  PictureOptions picture;
  Overrides overrides;
};

/// What its keys and its mouse do, a line each.
extern const char* const kViewerHelp;

/// Shows the film of a scene in a window and does what the user wants of it.
class Viewer {
 public:
  /// Keeps both by reference.
  Viewer(Window& window, const ViewOptions& options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  Viewer(Viewer&&) = delete;
  Viewer& operator=(Viewer&&) = delete;

  /// Until the user has enough, or Interrupted. A scene that is wrong ends it only if it is the first.
  void run(const std::stop_token& stop);

  int picturesShown() const { return shown_; }
  double drawSeconds() const { return drawSeconds_; }  ///< [s] of all of them, until they could be shown
  double showSeconds() const { return showSeconds_; }  ///< [s] of all of them, to show them

 private:
  void open(Run run);
  void beginLoading(const std::filesystem::path& path);
  void cancelLoading();
  void finishLoading();
  void lookAtFile();
  void show();
  void entitle();
  double patience() const;
  void handle(const WindowEvents& events);
  void press(char32_t key);
  void drag(const PointerDrag& drag);
  void turn(const Orbit& by);
  void takeStill();

  Window& window_;
  const ViewOptions& options_;
  Stopwatch clock_;
  std::filesystem::path picked_;  ///< what was asked for last; where it is wrong another is shown
  FileWatch watch_;
  double lookedAt_ = 0;  ///< [s] when the file was looked at
  std::future<Run> loading_;
  std::stop_source stopLoading_;
  std::unique_ptr<Screening> screening_;
  std::optional<Player> player_;
  Orbit orbit_;
  Picture picture_;  ///< the film's, as shown
  std::int64_t frame_ = 0;
  bool stale_ = true;  ///< whether the picture is not what it should be
  bool done_ = false;
  std::string title_;
  int shown_ = 0;
  double drawSeconds_ = 0;
  double showSeconds_ = 0;
};

}  // namespace careen
