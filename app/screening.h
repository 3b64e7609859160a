#pragma once

#include <cstdint>
#include <optional>

#include "picture_options.h"
#include "render/draw/renderer.h"
#include "render/film/filming.h"
#include "render/overlay/overlays.h"
#include "run.h"

namespace careen {

/// A run and all that it takes to draw its film in this process, a picture at a time: the same bytes as the
/// film's frames.
class Screening {
 public:
  /// InputError if there is a frame whose camera sees nothing.
  Screening(Run run, const PictureOptions& options);

  const Run& run() const { return run_; }
  const FrameRate& rate() const { return picture().rate; }
  std::int64_t frameCount() const { return rate().frameCount(filming_.duration()); }
  /// Where the film has the camera.
  Camera filmCamera(double filmTime) const { return filming_.camera(filmTime); }
  int pictureHeight() const { return picture().height; }  ///< [px]

  /// The picture at a moment of the film [s], overlays and all, with the camera turned so.
  Picture draw(double filmTime, const Orbit& orbit);

 private:
  const PictureSettings& picture() const { return run_.trajectory.stage.picture; }

  Run run_;
  Filming filming_;
  std::optional<Overlays> overlays_;
  std::optional<Renderer> renderer_;
};

}  // namespace careen
