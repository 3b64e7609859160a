#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "core/characters.h"
#include "core/error.h"
#include "film/faults.h"
#include "film/folder.h"
#include "film/frame_range.h"
#include "film/manifest.h"

namespace careen {
namespace {

ExitCode verifyCommand(const std::filesystem::path& folder) {
  const std::optional<FilmManifest> manifest = readManifest(folder);
  if (!manifest) {
    throw InputError(folder.string() + ": holds no " + kManifestName +
                     ", expected a folder that 'careen render' wrote");
  }
  const std::vector<FrameFault> faults = findFaults(folder, *manifest);
  std::vector<std::int64_t> frames;
  for (const FrameFault& fault : faults) {
    std::cout << printableName((folder / frameFileName(fault.frame)).string() + ": " + fault.what) << '\n';
    frames.push_back(fault.frame);
  }
  std::cout << manifest->frames.size() << " frames, " << faults.size() << " missing or broken\n";
  if (!frames.empty()) {  // the last line can be pasted to draw them again
    std::cout << "--frames " << rangesText(frames) << '\n';
  }
  return faults.empty() ? ExitCode::kDone : ExitCode::kDifferent;
}

}  // namespace

void addVerify(const CommandLine& commandLine) {
  const CommandLine command =
      commandLine.addCommand("verify", "Which frames of a film are missing or broken");
  const auto path = std::make_shared<std::filesystem::path>();
  command.add("folder", *path, "Folder of frames").required();
  command.runs([path](const std::stop_token&) { return verifyCommand(*path); });
}

}  // namespace careen
