#include "still.h"

#include <iostream>
#include <vector>

#include "core/brief.h"
#include "core/characters.h"
#include "image/png.h"
#include "render/film/strobe.h"
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

void checkMoments(const std::vector<double>& moments, double duration, const char* option) {
  for (const double moment : moments) {
    if (!(moment >= 0 && moment <= duration)) {
      throw InputError(std::string(option) + ": found " + brief(moment) +
                       " s, expected a moment of the film, from 0 to " + brief(duration) + " s");
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

ExitCode drawStill(const Run& run, const RenderOptions& options, const Still& still) {
  FilmPictures pictures(run.trajectory, still.strobe ? ShownBesides() : still.besides);
  const std::vector<double> moments = momentsOf(still);
  checkMoments(moments, pictures.duration(), still.strobe ? "--strobe" : "--still");
  pictures.makeOverlays();
  pictures.open(options);
  const Picture picture = still.strobe ? pictures.drawStrobe(moments) : pictures.draw(moments[0]);
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
