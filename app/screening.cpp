#include "screening.h"

#include <utility>

#include "film/frame_range.h"

namespace careen {
namespace {

FilmSettings settingsFor(const Scene& scene, const PictureOptions& options) {
  FilmSettings settings = options.settings();
  options.takeFromScene(scene, settings);
  return settings;
}

}  // namespace

Screening::Screening(Run run, const PictureOptions& options)
    : run_(std::move(run)),
      settings_(settingsFor(run_.scene, options)),
      filming_(run_.scene, run_.trajectory, static_cast<double>(settings_.width) / settings_.height) {
  filming_.checkCamera(framesOf({}, frameCount()), rate());
  if (settings_.overlays.any()) {
    overlays_.emplace(run_.trajectory, run_.scene, settings_.overlays, rate().frameTime(1));
  }
  settings_.render.camera = filming_.camera(0);
  renderer_.emplace(run_.scene, settings_.width, settings_.height, settings_.render);
}

Picture Screening::draw(double filmTime, const Orbit& orbit) {
  filming_.turnCamera(orbit);
  Picture picture = filming_.draw(*renderer_, filmTime, settings_.shutter, rate());
  if (overlays_) {
    filming_.explain(*renderer_, picture, filmTime, *overlays_);
  }
  filming_.turnCamera({});
  return picture;
}

}  // namespace careen
