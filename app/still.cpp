#include "still.h"

#include <iostream>
#include <memory>
#include <vector>

#include "core/brief.h"
#include "core/characters.h"
#include "image/png.h"
#include "render/draw/renderer.h"
#include "render/film/filming.h"
#include "render/film/strobe.h"
#include "render/overlay/overlays.h"
#include "view/out_of_view.h"

namespace careen {
namespace {

std::vector<double> momentsOf(const Still& still) {
  if (!still.strobe) {
    return {still.moment};
  }
  try {
    return parseStrobe(*still.strobe);
  } catch (const InputError& error) {
    throw InputError(std::string("--strobe: ") + error.what());
  }
}

void checkMoments(const std::vector<double>& moments, const Filming& filming, const char* option) {
  for (const double moment : moments) {
    if (!(moment >= 0 && moment <= filming.duration())) {
      throw InputError(std::string(option) + ": found " + brief(moment) +
                       " s, expected a moment of the film, from 0 to " + brief(filming.duration()) + " s");
    }
  }
}

std::filesystem::path placeOf(const Run& run, const Still& still) {
  if (!still.path.empty()) {
    return still.path;
  }
  std::filesystem::path name = run.source.stem();
  name += still.strobe ? "-strobe.png" : "-still.png";
  return std::filesystem::path("out") / name;
}

}  // namespace

ExitCode drawStill(const Run& run, RenderOptions options, const Still& still) {
  const PictureSettings& asked = run.trajectory.stage.picture;
  const Filming filming(run.trajectory);
  const std::vector<double> moments = momentsOf(still);
  checkMoments(moments, filming, still.strobe ? "--strobe" : "--still");
  filming.prepare(options);
  Renderer renderer(run.trajectory, options);
  Picture picture = still.strobe ? filming.drawStrobe(renderer, moments)
                                 : filming.draw(renderer, moments[0], asked.shutter, asked.rate);
  if (const std::unique_ptr<Overlays> overlays =
          overlaysOf(run.trajectory, still.strobe ? nullptr : still.ghost)) {
    if (still.strobe) {
      filming.explainStrobe(renderer, picture, moments, *overlays);
    } else {
      filming.explain(renderer, picture, moments[0], *overlays);
    }
  }
  print(std::cout, outOfView(run.trajectory, moments), run.trajectory);
  const std::filesystem::path path = std::filesystem::absolute(placeOf(run, still)).lexically_normal();
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);  // if it failed, writing reports it
  writePng(path, picture);
  std::cout << "picture      " << (still.strobe ? std::to_string(moments.size()) + " moments, " : "")
            << printableName(path.string()) << '\n';
  return ExitCode::kDone;
}

}  // namespace careen
