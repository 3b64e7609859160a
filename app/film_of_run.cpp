#include "commands.h"
#include "render/film/film.h"

namespace careen {

// One job and no threads: runs are filmed side by side.
void drawFilmOfRun(const Trajectory& run, const std::filesystem::path& folder,
                   const std::vector<FrameRange>& frames, const std::stop_token& stop) {
  FilmSettings settings;
  settings.folder = folder;
  settings.frames = frames;
  settings.there = FilmThere::kReplace;  // whose folders these are, the sweep has checked
  settings.jobs = 1;
  settings.render.context.threads = 0;
  settings.program = "careen " CAREEN_VERSION;
  renderFilm(run, settings, {}, stop);
}

}  // namespace careen
