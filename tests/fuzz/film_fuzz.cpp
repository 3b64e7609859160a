// film.json of a folder of frames, and lists of frames.

#include <filesystem>
#include <fstream>

#include "film/frame_range.h"
#include "film/manifest.h"
#include "fuzz/fuzz.h"
#include "support/process.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace careen;
  static const TemporaryFolder folder;
  const std::string_view text = fuzz::textOf(data, size);
  std::ofstream(folder.path() / kManifestName, std::ios::binary) << text;
  fuzz::refusesOrReads([&] {
    const std::optional<FilmManifest> manifest = readManifest(folder.path());
    if (manifest && differenceOf(*manifest, *manifest).empty()) {
      framesOf(parseFrameRanges(rangesText(manifest->frames)), manifest->frameCount);
    }
  });
  fuzz::refusesOrReads([&] { framesOf(parseFrameRanges(text.substr(0, 64)), 1000); });
  return 0;
}
