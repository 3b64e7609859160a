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
#include "render/window/player.h"
#include "render/window/window.h"
#include "run_options.h"
#include "screening.h"
#include "view/orbit.h"

namespace careen {

struct ViewOptions {
  std::filesystem::path source;          ///< scene, trajectory file or table of poses
  std::filesystem::path folder = "out";  ///< for stills
  PictureOptions picture;
  SceneOfTable scene;
  Overrides overrides;
  AuditChoice audit;
  bool paused = false;  ///< at the first frame, in place of playing
};

/// Help text: keys and mouse, one line each.
extern const char* const kViewerHelp;

/// Shows the film of a scene in a window and handles user input.
class Viewer {
 public:
  /// Keeps references to both.
  Viewer(Window& window, const ViewOptions& options);
  ~Viewer();
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;
  Viewer(Viewer&&) = delete;
  Viewer& operator=(Viewer&&) = delete;

  /// Runs until the user quits; throws Interrupted if asked to stop. An invalid scene ends it only if it is
  /// the first one.
  void run(const std::stop_token& stop);

  int picturesShown() const { return shown_; }
  double drawSeconds() const { return drawSeconds_; }  ///< [s] of all pictures, until they could be shown
  double showSeconds() const { return showSeconds_; }  ///< [s] of all pictures, to show them

 private:
  void open(Run run);
  void beginLoading(const std::filesystem::path& path);
  void cancelLoading();
  void finishLoading();
  void checkFile();
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
  std::filesystem::path picked_;  ///< file requested last; if it is invalid, another one is shown
  FileWatch watch_;
  double lookedAt_ = 0;  ///< [s] when the file was last polled
  std::future<Run> loading_;
  std::stop_source stopLoading_;
  std::unique_ptr<Screening> screening_;
  std::optional<Player> player_;
  Orbit orbit_;
  Picture picture_;  ///< the film's picture, as shown
  std::int64_t frame_ = 0;
  bool stale_ = true;  ///< whether the picture must be redrawn
  bool done_ = false;
  std::string title_;
  int shown_ = 0;
  double drawSeconds_ = 0;
  double showSeconds_ = 0;
};

}  // namespace careen
