#include "compare/report_words.h"

#include <algorithm>

#include "core/brief.h"

namespace careen {
namespace {

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string reasonOfFrames(const Comparison& comparison) {
  const FrameCounts counts = countFrames(comparison);
  const std::size_t frames = comparison.frames.size();
  if (counts.identical == frames) {
    return frames == 1 ? "The two files are the same, byte for byte."
                       : "All " + counted(frames, "frame") + " are the same, byte for byte.";
  }
  const FrameComparison* const first = comparison.firstDifferent();
  if (first == nullptr) {
    const auto largest = std::max_element(
        comparison.frames.begin(), comparison.frames.end(),
        [](const FrameComparison& a, const FrameComparison& b) { return a.largest < b.largest; });
    return "The files differ, but within the tolerance: no channel differs by more than " +
           brief(255 * largest->largest) + "/255" +
           (frames == 1 ? "." : ", the largest difference, in " + largest->name + ".");
  }
  if (frames == 1) {
    return first->name + ": " + joined(first->reasons) + ".";
  }
  const bool onlyWarnings = counts.different == 0;
  std::string text = counted(onlyWarnings ? counts.warning : counts.different, "frame") + " of " +
                     std::to_string(frames) +
                     (onlyWarnings ? " near the tolerance" : " beyond the tolerance") + ". The first is " +
                     first->name + ": " + joined(first->reasons) + ".";
  const FrameComparison* const worst = comparison.worst();
  if (worst != first) {
    text += " The worst is " + worst->name + ": " + joined(worst->reasons) + ".";
  }
  return text;
}

std::string reasonOfRun(const RunDifference& run) {
  if (!run.incomparable.empty()) {
    return "The runs cannot be of the same scene: " + joined(run.incomparable) + ".";
  }
  if (run.sameBits) {
    return (run.until ? "Up to " + brief(*run.until) + " s every" : std::string("Every")) +
           " motion and every impact is the same, bit for bit.";
  }
  std::string text;
  if (run.firstImpact) {
    text = "The first impact that differs is number " + std::to_string(run.firstImpact->index + 1) + ": " +
           run.firstImpact->what + ".";
  }
  if (run.firstTime) {
    text += (text.empty() ? "" : " ") + std::string("States differ from ") + brief(*run.firstTime) + " s on";
    text += run.lastImpact ? ", after impact number " + std::to_string(run.lastImpact->index + 1) + " " +
                                 run.lastImpact->what + "."
                           : ".";
  }
  if (!run.firstBroken.empty()) {
    text +=
        (text.empty() ? "The audit of the table found first: " : " The audit of the table found first: ") +
        run.firstBroken + ".";
  }
  if (run.horizon) {
    text += " From " + brief(*run.horizon) +
            " s on positions mean nothing any more, because their difference exceeds a hundredth of a box: "
            "compare energies and counts.";
  } else if (run.worst.difference.relative > 0) {
    text += " Their largest difference is " + brief(run.worst.difference.relative) +
            " half diagonals of a box, or radians.";
  }
  return text;
}

}  // namespace

const char* nameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSame:
      return "same";
    case Verdict::kWarning:
      return "warning";
    case Verdict::kDifferent:
      return "different";
  }
  return "";
}

std::string joined(const std::vector<std::string>& reasons) {
  std::string text;
  for (const std::string& reason : reasons) {
    text += (text.empty() ? "" : "; ") + reason;
  }
  return text;
}

FrameCounts countFrames(const Comparison& comparison) {
  FrameCounts counts;
  for (const FrameComparison& frame : comparison.frames) {
    ++(frame.verdict == Verdict::kSame      ? counts.same
       : frame.verdict == Verdict::kWarning ? counts.warning
                                            : counts.different);
    counts.identical += frame.identical ? 1 : 0;
    counts.notMeasured += frame.measured ? 0 : 1;
  }
  return counts;
}

bool isEqual(const Comparison& comparison) {
  return comparison.verdict == Verdict::kSame &&
         (comparison.run ? comparison.run->sameBits
                         : countFrames(comparison).identical == comparison.frames.size());
}

std::string reasonOf(const Comparison& comparison) {
  return comparison.run ? reasonOfRun(*comparison.run) : reasonOfFrames(comparison);
}

}  // namespace careen
