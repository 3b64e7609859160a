#include "still.h"

#include <iostream>
#include <vector>

#include "core/brief.h"
#include "core/characters.h"
#include "image/png.h"
#include "view/out_of_view.h"

namespace careen {
namespace {

void checkMoments(const std::vector<double>& moments, double duration) {
  for (const double moment : moments) {
    if (!(moment <= duration)) {
      throw InputError("--still: found " + brief(moment) + " s, expected a moment of the film, from 0 to " +
                       brief(duration) + " s");
    }
  }
}

std::filesystem::path placeOf(const Run& run, const Still& still) {
  if (!still.path.empty()) {
    return still.path;
  }
  std::filesystem::path name = run.source.stem();
  name += still.moments.size() > 1 ? "-strobe.png" : "-still.png";
  return std::filesystem::path("out") / name;
}

}  // namespace

ExitCode drawStill(const Run& run, const RenderOptions& options, const Still& still) {
  const std::vector<double>& moments = still.moments;
  const bool isStrobe = moments.size() > 1;
  FilmPictures pictures(run.trajectory, still.besides);
  checkMoments(moments, pictures.duration());
  pictures.makeOverlays();
  pictures.open(options);
  const Picture picture = isStrobe ? pictures.drawStrobe(moments) : pictures.draw(moments[0]);
  print(std::cout, outOfView(run.trajectory, moments), run.trajectory);
  const std::filesystem::path path = std::filesystem::absolute(placeOf(run, still)).lexically_normal();
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);  // if it failed, writing reports it
  writePng(path, picture);
  std::cout << "picture      " << (isStrobe ? std::to_string(moments.size()) + " moments, " : "")
            << printableName(path.string()) << '\n';
  return ExitCode::kDone;
}

}  // namespace careen
