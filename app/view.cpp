#include <algorithm>
#include <iostream>
#include <memory>

#include "commands.h"
#include "render/window/window.h"
#include "viewer.h"

namespace careen {
namespace {

ExitCode viewCommand(ViewOptions options, const std::stop_token& stop) {
  if (options.source.empty()) {
    options.source = defaultScene();
  }
  options.picture.check();  // errors in the options are reported first …
  Window window("careen");  // … then a missing display, before the simulation
  std::cout << "The space bar plays and pauses; the key h tells what else there is.\n" << std::flush;
  Viewer viewer(window, options);
  viewer.run(stop);
  const int shown = std::max(viewer.picturesShown(), 1);
  std::cout << "shown        " << viewer.picturesShown() << " pictures, each took "
            << 1e3 * viewer.drawSeconds() / shown << " ms to draw and " << 1e3 * viewer.showSeconds() / shown
            << " ms to show\n";
  return ExitCode::kDone;
}

}  // namespace

void addView(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("view", "Show the film of a scene, or of a run, in a window");
  const auto options = std::make_shared<ViewOptions>();
  command.add("file", options->source,
              "Scene, trajectory file or table of poses; the default scene if none is named");
  options->scene.addShowingTo(command);
  command.add("-o,--out", options->folder, "Folder for stills (default: out)");
  command.addFlag("--paused", options->paused, "Begin at the first frame, paused, in place of playing");
  options->picture.addTo(command);
  options->overrides.addTo(command);
  options->audit.addDepthTo(command);
  command.footer(std::string("Keys and mouse:\n") + kViewerHelp);
  command.runs([options](const std::stop_token& stop) { return viewCommand(*options, stop); });
}

}  // namespace careen
