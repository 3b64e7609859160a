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
    : run_(pictured(std::move(run), options)), pictures_(run_.trajectory) {
  pictures_.first().checkCamera(framesOf({}, frameCount()), rate());
  pictures_.makeOverlays();
  RenderOptions render;
  render.context = options.contextOptions();
  pictures_.open(render);
}

Picture Screening::draw(double filmTime, const Orbit& orbit) {
  pictures_.turnCamera(orbit);
  Picture drawn = pictures_.draw(filmTime);
  pictures_.turnCamera({});
  return drawn;
}

}  // namespace careen
