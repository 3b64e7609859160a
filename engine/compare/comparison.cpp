#include "compare/comparison.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <string_view>
#include <thread>
#include <utility>

#include "compare/flip.h"
#include "compare/picture_difference.h"
#include "core/brief.h"
#include "core/characters.h"
#include "core/error.h"
#include "core/system/file.h"
#include "image/deep_picture.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

/// A frame in both folders; a missing file has an empty path.
struct FramePair {
  std::string name;
  fs::path expected;
  fs::path actual;
};

// [px] Pictures that have more are measured one after another, whatever the number of threads.
constexpr std::uint64_t kLarge = std::uint64_t{1} << 24U;

std::uint64_t pixelsOf(const PngSize& size) {
  return static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height);
}

std::unique_lock<std::mutex> aloneIf(bool large) {
  static std::mutex mutex;
  return large ? std::unique_lock(mutex) : std::unique_lock<std::mutex>();
}

void addDifferent(FrameComparison& frame, const std::string& reason) {
  frame.verdict = Verdict::kDifferent;
  frame.reasons.push_back(reason);
}

void measure(const FramePair& pair, const std::string& expectedBytes, const std::string& actualBytes,
             const ComparisonSettings& settings, FrameComparison& frame) {
  const std::uint64_t larger = std::max(pixelsOf(sizeOfPng(expectedBytes, pair.expected.string())),
                                        pixelsOf(sizeOfPng(actualBytes, pair.actual.string())));
  const std::unique_lock<std::mutex> lock = aloneIf(larger > kLarge);
  DeepPicture expected = decodeDeepPng(expectedBytes, pair.expected.string(), kMostBytesCompared);
  DeepPicture actual = decodeDeepPng(actualBytes, pair.actual.string(), kMostBytesCompared);
  if (const std::string fault = otherSize(expected, actual); !fault.empty()) {
    addDifferent(frame, fault);
    return;
  }
  const PixelMask ignored = settings.ignored.of(expected.width, expected.height);
  if (settings.flip) {
    makeComparable(expected, actual, ignored);
    frame.flip = flipOf(expected, actual, kPixelsPerDegree, ignored).mean;
  }
  const std::string expectedColors = expected.colorSpace;
  const std::string actualColors = actual.colorSpace;
  const PictureDifference difference = differenceOf(std::move(expected), std::move(actual), ignored);
  const auto percent = [&difference](std::size_t pixels) {
    return 100 * static_cast<double>(pixels) / static_cast<double>(difference.pixels);
  };
  frame.measured = true;
  frame.largest = difference.largest;
  frame.largestX = difference.largestX;
  frame.largestY = difference.largestY;
  frame.mean = difference.mean;
  frame.psnr = difference.psnr();
  frame.ssim = difference.ssim;
  frame.worstSsim = difference.worstSsim;
  frame.failingPercent = percent(difference.pixelsOver(settings.tolerance.fail));
  frame.changedPercent = percent(difference.changed - difference.changedByEdges);
  frame.edgePercent = percent(difference.changedByEdges);
  PictureJudgement judgement = judge(difference, settings.tolerance);
  frame.verdict = judgement.verdict;
  frame.reasons = std::move(judgement.reasons);
  if (expectedColors != actualColors) {
    addDifferent(frame, "a viewer shows other colours, as its chunks say " + actualColors + ", expected " +
                            expectedColors);
  }
}

FrameComparison compareFiles(const FramePair& pair, const ComparisonSettings& settings) {
  FrameComparison frame;
  frame.name = pair.name;
  const std::string expected = readFile(pair.expected);
  const std::string actual = readFile(pair.actual);
  frame.identical = expected == actual;
  if (frame.identical) {
    const PngSize size = checkPng(expected, pair.expected.string());
    static_cast<void>(settings.ignored.of(size.width, size.height));  // tells if it does not fit
    frame.measured = true;
    frame.psnr = std::numeric_limits<double>::infinity();
    if (settings.flip) {
      frame.flip = 0;
    }
  } else {
    measure(pair, expected, actual, settings, frame);
  }
  return frame;
}

// Missing and broken frames count as differences.
FrameComparison compareFrame(const FramePair& pair, const ComparisonSettings& settings) {
  FrameComparison frame;
  frame.name = pair.name;
  frame.verdict = Verdict::kDifferent;
  if (pair.actual.empty()) {
    frame.reasons = {"it is missing"};
    return frame;
  }
  if (pair.expected.empty()) {
    frame.reasons = {"it was not expected"};
    return frame;
  }
  try {
    return compareFiles(pair, settings);
  } catch (const UnfitRegions&) {
    throw;
  } catch (const InputError& error) {
    frame.reasons = {error.what()};
  }
  return frame;
}

bool hasPngSuffix(const fs::path& path) { return lowered(path.extension().string()) == ".png"; }

void list(const fs::path& folder, bool subfolders, std::map<std::string, FramePair>& pairs,
          fs::path FramePair::*side) {
  bool any = false;
  for (fs::recursive_directory_iterator entry(folder), end; entry != end; ++entry) {
    std::error_code none;
    if (entry->is_directory(none)) {
      if (!subfolders) {
        entry.disable_recursion_pending();
      }
    } else if (hasPngSuffix(entry->path())) {
      const std::string name = entry->path().lexically_relative(folder).generic_string();
      FramePair& pair = pairs[name];
      pair.name = name;
      pair.*side = entry->path();
      any = true;
    }
  }
  if (!any) {
    throw InputError(folder.string() + ": found no PNG files, expected a folder of frames");
  }
}

std::vector<FramePair> pairsOf(const fs::path& expected, const fs::path& actual,
                               const ComparisonSettings& settings) {
  const std::set<std::string>& only = settings.only;
  std::map<std::string, FramePair> byName;
  list(expected, settings.subfolders, byName, &FramePair::expected);
  list(actual, settings.subfolders, byName, &FramePair::actual);
  std::vector<FramePair> pairs;
  for (auto& [name, pair] : byName) {
    if (only.empty() || only.contains(name)) {
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

/// Compares frames in parallel; stops at the first error.
class Crew {
 public:
  Crew(const std::vector<FramePair>& pairs, const ComparisonSettings& settings,
       const ComparisonCallback& progress, const std::stop_token& stop)
      : pairs_(pairs), settings_(settings), progress_(progress), stop_(stop), frames_(pairs.size()) {}

  std::vector<FrameComparison> compare() {
    {
      std::vector<std::jthread> threads;
      for (int i = 1; i < settings_.threads; ++i) {
        threads.emplace_back([this] { work(); });
      }
      work();
    }
    if (error_) {
      std::rethrow_exception(error_);
    }
    if (stop_.stop_requested()) {
      throw Interrupted();
    }
    return std::move(frames_);
  }

 private:
  void work() {
    for (std::size_t i = next_++; i < pairs_.size() && !stop_.stop_requested(); i = next_++) {
      try {
        frames_[i] = compareFrame(pairs_[i], settings_);
        const std::lock_guard lock(mutex_);
        ++done_;
        if (progress_) {
          progress_(done_, pairs_.size());
        }
      } catch (...) {
        const std::lock_guard lock(mutex_);
        error_ = std::current_exception();
        next_ = pairs_.size();
      }
    }
  }

  const std::vector<FramePair>& pairs_;
  const ComparisonSettings& settings_;
  const ComparisonCallback& progress_;
  const std::stop_token& stop_;
  std::vector<FrameComparison> frames_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;  // guards the members below
  std::size_t done_ = 0;
  std::exception_ptr error_;
};

bool same(const fs::path& expected, const fs::path& actual, const ComparisonSettings& settings) {
  return !expected.empty() && !actual.empty() &&
         compareFrame({.name = {}, .expected = expected, .actual = actual}, settings).verdict !=
             Verdict::kDifferent;
}

// Reports whether the first different frame shows the previous or the next one.
void tellShift(const std::vector<FramePair>& pairs, const ComparisonSettings& settings,
               std::vector<FrameComparison>& frames) {
  const auto first = std::find_if(frames.begin(), frames.end(), [](const FrameComparison& frame) {
    return frame.verdict == Verdict::kDifferent && frame.measured;
  });
  if (first == frames.end()) {
    return;
  }
  const auto k = static_cast<std::size_t>(first - frames.begin());
  if (k > 0 && same(pairs[k - 1].expected, pairs[k].actual, settings)) {
    first->reasons.push_back("it shows what " + pairs[k - 1].name + " should: a frame is doubled");
  } else if (k + 1 < pairs.size() && same(pairs[k + 1].expected, pairs[k].actual, settings)) {
    first->reasons.push_back("it shows what " + pairs[k + 1].name + " should: a frame was dropped");
  }
}

Comparison begun(const fs::path& expected, const fs::path& actual, const ComparisonSettings& settings) {
  Comparison comparison;
  comparison.expected = expected;
  comparison.actual = actual;
  comparison.program = settings.program;
  comparison.toleranceName = settings.toleranceName;
  comparison.tolerance = settings.tolerance;
  comparison.ignored = settings.ignored;
  return comparison;
}

Verdict worstVerdict(const std::vector<FrameComparison>& frames) {
  const auto worst = std::max_element(
      frames.begin(), frames.end(),
      [](const FrameComparison& a, const FrameComparison& b) { return a.verdict < b.verdict; });
  return worst == frames.end() ? Verdict::kSame : worst->verdict;
}

std::string pictureHeadline(const Comparison& comparison) {
  const auto different = static_cast<std::size_t>(
      std::count_if(comparison.frames.begin(), comparison.frames.end(),
                    [](const FrameComparison& frame) { return frame.verdict == Verdict::kDifferent; }));
  const bool identical = std::all_of(comparison.frames.begin(), comparison.frames.end(),
                                     [](const FrameComparison& frame) { return frame.identical; });
  if (comparison.verdict == Verdict::kDifferent) {
    return comparison.frames.size() == 1 ? "other picture"
                                         : "other picture in " + std::to_string(different) + " of " +
                                               std::to_string(comparison.frames.size()) + " frames";
  }
  return comparison.frames.size() == 1 ? (identical ? "same file" : "same picture")
                                       : (identical ? "same files" : "same pictures");
}

std::string runHeadline(const RunDifference& run, bool same) {
  const std::string until = run.until ? ", up to " + brief(*run.until) + " s" : "";
  if (run.sameBits) {
    return "same motion, bit for bit" + until;
  }
  if (!run.incomparable.empty()) {
    return "other motion: " + run.incomparable.front();
  }
  if (same) {
    return "same motion, within " + brief(run.worst.difference.relative) + " of a box's size or radians" +
           until;
  }
  if (run.expectedDuration != run.actualDuration && !run.firstTime) {
    return "same motion, but it lasts " + brief(run.actualDuration) + " s, not " +
           brief(run.expectedDuration) + " s";
  }
  std::string text = "other motion from " + brief(run.firstTime.value_or(0)) + " s on";
  if (run.lastImpact) {
    text += ", after impact number " + std::to_string(run.lastImpact->index + 1) + " " + run.lastImpact->what;
  }
  if (run.horizon && run.growthPerImpact) {
    text += "; the difference grows " + brief(*run.growthPerImpact) +
            "-fold from impact to impact, and from " + brief(*run.horizon) + " s on chaos has taken over";
  } else if (run.horizon) {
    text += ", by more than a hundredth of a box after " +
            brief(std::max(*run.horizon, run.firstTime.value_or(0))) + " s";
  }
  return text;
}

std::vector<Fact> factsOf(const Trajectory& expected, const Trajectory& actual) {
  std::vector<Fact> facts;
  const auto add = [&](const char* name, auto value) {
    facts.push_back({.name = name, .expected = value(expected), .actual = value(actual)});
  };
  add("scene hash", [](const Trajectory& run) { return run.sceneHash(); });
  add("state hash", [](const Trajectory& run) { return run.stateHash(); });
  add("method", [](const Trajectory& run) { return run.methodName(); });
  add("tolerance [m]", [](const Trajectory& run) { return brief(run.settings.tolerance); });
  // Whoever wrote a table told no figures.
  const auto told = [](const Trajectory& run, double figure) {
    return run.given ? std::string("not told") : brief(figure);
  };
  add("energy change [1]", [&](const Trajectory& run) { return told(run, run.figures.energyChange); });
  add("deepest penetration [m]",
      [&](const Trajectory& run) { return told(run, run.figures.deepestPenetration); });
  return facts;
}

}  // namespace

const FrameComparison* Comparison::firstDifferent() const {
  const auto found = std::find_if(frames.begin(), frames.end(), [](const FrameComparison& frame) {
    return frame.verdict != Verdict::kSame;
  });
  return found == frames.end() ? nullptr : &*found;
}

const FrameComparison* Comparison::worst() const {
  const FrameComparison* worst = nullptr;
  for (const FrameComparison& frame : frames) {
    if (frame.verdict != Verdict::kSame && frame.measured &&
        (worst == nullptr || frame.verdict > worst->verdict ||
         (frame.verdict == worst->verdict && frame.psnr < worst->psnr))) {
      worst = &frame;
    }
  }
  return worst != nullptr ? worst : firstDifferent();
}

fs::path expectedFrame(const Comparison& comparison, const FrameComparison& frame) {
  return fs::is_directory(comparison.expected) ? comparison.expected / frame.name : comparison.expected;
}
fs::path actualFrame(const Comparison& comparison, const FrameComparison& frame) {
  return fs::is_directory(comparison.actual) ? comparison.actual / frame.name : comparison.actual;
}

Comparison comparePictures(const fs::path& expected, const fs::path& actual,
                           const ComparisonSettings& settings) {
  Comparison comparison = begun(expected, actual, settings);
  comparison.frames = {
      compareFiles({.name = actual.filename().string(), .expected = expected, .actual = actual}, settings)};
  comparison.verdict = worstVerdict(comparison.frames);
  comparison.headline = pictureHeadline(comparison);
  return comparison;
}

Comparison compareFolders(const fs::path& expected, const fs::path& actual,
                          const ComparisonSettings& settings, std::optional<bool> sameMotion,
                          const ComparisonCallback& progress, const std::stop_token& stop) {
  Comparison comparison = begun(expected, actual, settings);
  const std::vector<FramePair> pairs = pairsOf(expected, actual, settings);
  comparison.frames = Crew(pairs, settings, progress, stop).compare();
  tellShift(pairs, settings, comparison.frames);
  comparison.verdict = worstVerdict(comparison.frames);
  comparison.headline = pictureHeadline(comparison);
  if (sameMotion) {
    comparison.headline = (*sameMotion ? "same motion, " : "other motion, ") + comparison.headline;
  }
  if (sameMotion == false && settings.motionCounts) {
    comparison.verdict = Verdict::kDifferent;
  }
  return comparison;
}

Comparison compareRuns(const fs::path& expected, const fs::path& actual, const ComparisonSettings& settings,
                       const RunReader& read) {
  Comparison comparison = begun(expected, actual, settings);
  const Trajectory expectedRun = read(expected);
  const Trajectory actualRun = read(actual);
  comparison.facts = factsOf(expectedRun, actualRun);
  const bool isTable = expectedRun.given || actualRun.given;
  const double tolerance =
      isTable ? std::max(settings.motionTolerance, kTableRounding) : settings.motionTolerance;
  RunDifference run = differenceOf(expectedRun, actualRun, settings.until, tolerance);
  // The last row of a table need not be at the end of the scene.
  const bool isWhole = isTable || std::min(run.expectedDuration, settings.until) ==
                                      std::min(run.actualDuration, settings.until);
  const bool within = tolerance > 0 && run.incomparable.empty() && !run.horizon && isWhole &&
                      run.worst.difference.relative <= tolerance;
  comparison.verdict = run.sameBits || within ? Verdict::kSame : Verdict::kDifferent;
  comparison.headline = runHeadline(run, within);
  comparison.run = std::move(run);
  return comparison;
}

}  // namespace careen
