#include "picture_options.h"

#include <algorithm>

#include "parsed.h"
#include "physics/world/run_settings.h"

namespace careen {

void PictureOptions::addTo(const CommandLine& command) {
  SizeAndRate::addTo(command);
  command.add("--shutter", shutter,
              "Motion blur in place of the scene's: how long the shutter is open, 360 from frame to "
              "frame, and how many moments are averaged, such as 180:8; 0: none");
  command.add("--look", look, "studio, blueprint or clay in place of the scene's look");
  command.add("--light", light,
              "Parts of the light in place of the scene's, such as shadows,occlusion (the others: bounce); "
              "none: nothing but plain light");
  command.add("--antialiasing", antialiasing, "off, edges, 4x or supersampled in place of the scene's");
  command.add("--overlays", overlays,
              "What to draw over the film in place of the scene's, such as time,energy; none: nothing");
  command.add(
      "--rendering-backend", backend,
      "What draws: auto, osmesa or egl (default: auto, the first of the others that there is); list: render "
      "tells what there is, and makes no film");
  command.add("--threads", context.threads,
              "Threads that fill pixels in each process that draws, and that share the steps of large crowds "
              "before; 0: none but the main one (default: what cores there are)");
}

void PictureOptions::applyTo(PictureSettings& picture) const {
  SizeAndRate::applyTo(picture);
  if (shutter) {
    picture.shutter = parsed("--shutter", *shutter, parseShutter);
  }
  if (look) {
    picture.look = parsed("--look", *look, lookNamed);
  }
  if (light) {
    picture.light = parsed("--light", *light, LightParts::named);
  }
  if (antialiasing) {
    picture.antialiasing = parsed("--antialiasing", *antialiasing, antialiasingNamed);
  }
  picture.alpha = alpha;
  if (overlays) {
    picture.overlays = parsed("--overlays", *overlays, OverlaySet::named);
  }
}

bool PictureOptions::listsBackends() const { return backend == "list"; }

ContextOptions PictureOptions::contextOptions() const {
  if (context.threads && *context.threads < 0) {
    throw InputError("--threads: found " + std::to_string(*context.threads) + ", expected 0 or more");
  }
  ContextOptions options = context;
  options.backend = parsed("--rendering-backend", backend, renderingBackendNamed);
  return options;
}

std::optional<int> PictureOptions::threadsOfCrowds() const {
  if (!context.threads) {
    return std::nullopt;
  }
  return std::clamp(*context.threads, 1, kMostThreadsOfCrowds);
}

void PictureOptions::check() const {
  static_cast<void>(contextOptions());
  PictureSettings ignored;
  applyTo(ignored);
}

}  // namespace careen
