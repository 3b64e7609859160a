#include "with_reference.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include "compare/report.h"
#include "core/characters.h"
#include "film/folder.h"
#include "film/frame_range.h"

namespace careen {

void takeFromReference(const Reference& reference, PictureOptions& picture, std::string& frames,
                       CompareOptions& compare) {
  const FilmManifest& film = reference.film;
  const auto take = [](std::optional<std::string>& open, const std::string& value) {
    if (!open) {
      open = value;
    }
  };
  take(picture.size, std::to_string(film.picture.width) + "x" + std::to_string(film.picture.height));
  take(picture.rate, film.picture.rate.text());
  take(picture.look, nameOf(film.picture.look));
  take(picture.antialiasing, nameOf(film.picture.antialiasing));
  take(picture.shutter, film.picture.shutter.degrees > 0 ? film.picture.shutter.text() : "0");
  take(picture.overlays, film.picture.overlays.text());
  take(picture.light, film.picture.light.text());
  picture.alpha = picture.alpha || film.picture.alpha;
  if (frames.empty()) {
    frames = rangesText(film.frames);
    return;
  }
  for (const std::int64_t frame : framesOf(parseFrameRanges(frames), film.frameCount)) {
    compare.only.insert(frameFileName(frame));
  }
}

ExitCode compareAndTell(const Reference& reference, const std::filesystem::path& film,
                        const CompareOptions& options, bool logsFrames, const std::stop_token& stop) {
  const auto& [comparison, kept] = compareWithReference(
      reference, film, options.settings(), [&](const Comparison& found) { tell(found, logsFrames); }, stop);
  std::ostream& out = logsFrames ? std::cerr : std::cout;
  const std::filesystem::path folder = std::filesystem::absolute(film).lexically_normal();
  if (comparison.verdict == Verdict::kDifferent) {
    out << "kept         " << kept << (kept == 1 ? " frame" : " frames") << " that differ"
        << (kept == 1 ? "s: " : ": ") << folder.string() << '\n';
  } else {
    out << "kept         no frame; the result is in " << (folder / kJunitName).string() << '\n';
  }
  return exitCodeOf(comparison);
}

ExitCode approveAndTell(Approval& approval, const CompareOptions& options, bool logsFrames,
                        const std::stop_token& stop) {
  const Comparison comparison = approval.approve(
      options.settings(), [&](const Comparison& found) { tell(found, logsFrames); }, stop);
  const auto changed =
      std::count_if(comparison.frames.begin(), comparison.frames.end(),
                    [](const FrameComparison& frame) { return frame.verdict == Verdict::kDifferent; });
  (logsFrames ? std::cerr : std::cout)
      << "approved     " << changed << " of " << comparison.frames.size() << " frames changed"
      << (comparison.verdict != Verdict::kDifferent ? ", the film stays as it was: "
          : changed == 0                            ? ", only the motion did: "
                                                    : ": ")
      << printableName(approval.place().string()) << '\n';
  return ExitCode::kDone;
}

}  // namespace careen
