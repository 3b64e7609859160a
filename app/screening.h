#pragma once

#include <cstdint>

#include "picture_options.h"
#include "render/film/film_pictures.h"
#include "run_options.h"

namespace careen {

/// A run and all that is needed to draw its film in this process, one picture at a time, with the same bytes
/// as the film's frames.
class Screening {
 public:
  /// InputError if the camera sees nothing in some frame.
  Screening(Run run, const PictureOptions& options);

  const Run& run() const { return run_; }
  const FrameRate& rate() const { return picture().rate; }
  std::int64_t frameCount() const { return rate().frameCount(pictures_.duration()); }
  /// The film's camera at this time.
  Camera filmCamera(double filmTime) const { return pictures_.first().camera(filmTime); }
  int pictureHeight() const { return picture().height; }  ///< [px]

  /// Draws the picture at a film time [s], overlays included, with the camera turned by `orbit`.
  Picture draw(double filmTime, const Orbit& orbit);

 private:
  const PictureSettings& picture() const { return run_.trajectory.stage.picture; }

  Run run_;
  FilmPictures pictures_;
};

}  // namespace careen
