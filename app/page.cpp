#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "core/characters.h"
#include "core/system/file.h"
#include "film_sound.h"
#include "page/run_page.h"
#include "parsed.h"
#include "picture_options.h"
#include "progress.h"
#include "render/film/film.h"
#include "run_options.h"

namespace careen {
namespace {

constexpr const char* kPageSize = "640x360";  // large enough to see, and small enough to send

struct PageOptions {
  std::filesystem::path source;
  std::filesystem::path output;
  std::string quality = "good";
  PictureOptions picture;
  SoundChoice sound;
  SceneOfTable scene;
  Overrides overrides;
  AuditChoice audit;
};

PageFilm filmOf(const Run& run, const PageOptions& options, const std::stop_token& stop) {
  FilmSettings settings;
  settings.render.context = options.picture.contextOptions();
  settings.program = "careen " CAREEN_VERSION;
  settings.video =
      VideoSettings{.path = "film.mp4", .quality = parsed("--quality", options.quality, videoQualityNamed)};
  options.sound.of(run.trajectory, settings, stop);
  Progress progress;
  return {.bytes = filmAsMp4(
              run.trajectory, settings, [&](const FilmProgress& now) { progress.update(now); }, stop),
          .type = "video/mp4"};
}

ExitCode pageCommand(PageOptions options, const std::stop_token& stop) {
  options.picture.check();
  static_cast<void>(parsed("--quality", options.quality, videoQualityNamed));
  if (!options.picture.size) {
    options.picture.size = kPageSize;
  }
  options.overrides.threads = options.picture.threadsOfCrowds();
  Run run = loadRun(options.source, options.overrides, options.scene, stop);
  auditRun(run, options.audit, stop);
  options.picture.applyTo(run.trajectory.stage.picture);
  const PageFilm film = filmOf(run, options, stop);
  const std::filesystem::path path = options.output.empty()
                                         ? std::filesystem::path(options.source.stem().string() + ".html")
                                         : options.output;
  const std::string page = runPage(run.trajectory, run.audit, film, "careen " CAREEN_VERSION);
  writeFile(path, page);
  std::cout << "page         " << printableName(std::filesystem::absolute(path).lexically_normal().string())
            << ", " << (page.size() + 999) / 1000 << " kB\n";
  return ExitCode::kDone;
}

}  // namespace

void addPage(const CommandLine& commandLine) {
  const CommandLine command = commandLine.addCommand(
      "page", "A page about a run, for a browser: its film, energies, impacts and audit");
  const auto options = std::make_shared<PageOptions>();
  command.add("file", options->source, "Scene, trajectory file or table of poses").required();
  command.add("-o,--out", options->output, "The page (default: the file's name, with .html)");
  command.add("--quality", options->quality, "The film's: draft, good or best (default: good)");
  options->scene.addShowingTo(command);
  options->picture.addTo(command);
  options->sound.addTo(command);
  options->overrides.addTo(command);
  options->audit.addTo(command);
  command.runs([options](const std::stop_token& stop) { return pageCommand(*options, stop); });
}

}  // namespace careen
