#include "screening.h"

#include <utility>

#include "film/frame_range.h"

namespace careen {
namespace {

Run pictured(Run run, const PictureOptions& options) {
  options.applyTo(run.trajectory.stage.picture);
  return run;
}

}  // namespace

Screening::Screening(Run run, const PictureOptions& options)
    : run_(pictured(std::move(run), options)), filming_(run_.trajectory) {
  filming_.checkCamera(framesOf({}, frameCount()), rate());
  overlays_ = overlaysOf(run_.trajectory);
  RenderOptions render;
  render.context = options.contextOptions();
  filming_.prepare(render);
  renderer_.emplace(run_.trajectory, render);
}

Picture Screening::draw(double filmTime, const Orbit& orbit) {
  filming_.turnCamera(orbit);
  Picture drawn = filming_.draw(*renderer_, filmTime, picture().shutter, rate());
  if (overlays_) {
    filming_.explain(*renderer_, drawn, filmTime, *overlays_);
  }
  filming_.turnCamera({});
  return drawn;
}

}  // namespace careen
