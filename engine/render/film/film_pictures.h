#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/draw/renderer.h"
#include "render/film/film_plot.h"
#include "render/film/filming.h"
#include "render/overlay/overlays.h"

namespace careen {

/// What a film shows besides a run. The other runs must last as long as who is given this.
struct ShownBesides {
  std::vector<const Trajectory*> beside = {};  ///< made to look like the run (showBeside)
  const Trajectory* ghost = nullptr;           ///< in the run's picture, as outlines; null: none
  std::optional<PlotQuantity> plot = {};       ///< below
};

/// The pictures of a film, overlays included: of a run, or of several side by side, each as large as the
/// first one's. Keeps references to the runs.
class FilmPictures {
 public:
  explicit FilmPictures(const Trajectory& run, const ShownBesides& besides = {});

  /// [s] Of the film: until the last of the runs has ended.
  double duration() const;
  /// Size, rate and the rest of the whole pictures.
  PictureSettings settings() const;
  const Filming& first() const { return *shown_.front().filming; }
  /// Sets the cameras' orbit relative to the film's camera.
  void turnCamera(const Orbit& orbit);

  /// Makes what is made once for a film: slow if there are overlays of it all. No GL.
  void makeOverlays();
  /// Opens GL in this process.
  void open(const RenderOptions& options);
  /// Needs GL. At a time of the film [s].
  Picture draw(double filmTime);
  /// Needs GL: one picture of all of these moments, with the overlays of the last one; of the first run.
  Picture drawStrobe(std::span<const double> filmTimes);

  /// Needs GL.
  const std::string& rendererName() const { return shown_.front().renderer->rendererName(); }
  /// Of all of them so far.
  DrawFigures figures() const;

 private:
  struct Shown {
    const Trajectory* run = nullptr;
    const Trajectory* ghost = nullptr;
    std::unique_ptr<Filming> filming;
    std::unique_ptr<Overlays> overlays;
    std::unique_ptr<Renderer> renderer;
  };
  Picture withPlot(const Picture& above, double filmTime);

  std::vector<Shown> shown_;
  std::optional<PlotQuantity> quantity_;
  std::optional<FilmPlot> plot_;
};

/// Lets a run be shown as another is, beside it: with its camera, which follows the box of the same name, its
/// film, look, light and overlays; with a name over it, and without a second clock. InputError if it has no
/// such box.
void showBeside(Trajectory& run, const Trajectory& first, const std::string& name);
/// The same of the first itself: a camera that it would have by its own boxes is theirs, too.
void showFirst(Trajectory& run, const std::string& name);

}  // namespace careen
