#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "compare/ignored_regions.h"
#include "compare/run_difference.h"
#include "compare/tolerance.h"
#include "trajectory/trajectory_file.h"

namespace careen {

/// Result for a pair of frames, in few bytes: a film may have many.
struct FrameComparison {
  std::string name;  ///< the path in the folder, the same in both: "sub/2.png"
  Verdict verdict = Verdict::kSame;
  std::vector<std::string> reasons;  ///< why the frames differ, in words
  bool identical = false;            ///< the files are identical byte for byte
  bool measured = false;       ///< the numbers below are valid: both frames exist, are intact and of one size
  double largest = 0;          ///< [1] largest difference of a channel
  int largestX = 0;            ///< [px] its place, from the upper left
  int largestY = 0;            ///< [px]
  double mean = 0;             ///< [1] absolute difference over all channels
  double psnr = 0;             ///< [dB] infinite if no sample differs
  double ssim = 1;             ///< [1]
  double worstSsim = 1;        ///< [1] lowest of any window
  double failingPercent = 0;   ///< [%] of the pixels: beyond the tolerance's `fail`
  double changedPercent = 0;   ///< [%] of the pixels: visibly different colour, not explained by edges
  double edgePercent = 0;      ///< [%] of the pixels: visibly different colour, explained by edges
  std::optional<double> flip;  ///< [1] mean ꟻLIP, if asked for
};

/// A property of both sides that explains a difference: renderer, scene hash and the like.
struct Fact {
  std::string name;
  std::string expected;
  std::string actual;
};

/// Everything `careen compare` found.
struct Comparison {
  std::filesystem::path expected;  ///< a picture, a folder of frames, or a run
  std::filesystem::path actual;
  std::string program;        ///< name and version of the comparing program
  std::string toleranceName;  ///< with overrides: "same-picture, --fail 0.02"
  Tolerance tolerance;
  IgnoredRegions ignored;  ///< what of the pictures does not count
  Verdict verdict = Verdict::kSame;
  std::string headline;  ///< the verdict in a sentence, such as "same motion, other picture"
  std::vector<Fact> facts;
  std::vector<FrameComparison> frames;  ///< in the order of their names; empty for runs
  std::optional<RunDifference> run;     ///< for runs only

  /// The first frame that differs, and the one that differs most; null if all are the same.
  const FrameComparison* firstDifferent() const;
  const FrameComparison* worst() const;
};

/// Files of a frame: the pictures themselves if two pictures are compared.
std::filesystem::path expectedFrame(const Comparison& comparison, const FrameComparison& frame);
std::filesystem::path actualFrame(const Comparison& comparison, const FrameComparison& frame);

struct ComparisonSettings {
  std::string program = {};
  std::string toleranceName = "same-picture";
  Tolerance tolerance = toleranceOf("same-picture");  ///< of pictures
  /// Tolerance of positions [1], see PoseDifference; 0: every bit counts. If it is not 0, impacts need not
  /// be the same.
  double motionTolerance = 0;
  double until = std::numeric_limits<double>::infinity();  ///< [s] runs are compared up to this time
  bool motionCounts = true;     ///< a film of a different motion differs, even if its pictures are the same
  IgnoredRegions ignored = {};  ///< of pictures
  bool flip = false;            ///< also compute ꟻLIP, which takes ten times as long as all the rest
  int threads = 1;              ///< frames compared in parallel
  bool subfolders = true;       ///< for folders: pictures in their sub-folders, too
  std::set<std::string> only = {};  ///< for folders: only frames of these names; empty: all
};

/// Reports how many frames of how many are compared.
using ComparisonCallback = std::function<void(std::size_t done, std::size_t total)>;

/// Pictures that differ are compared up to this size [bytes of samples], 16384 x 16384 of 8-bit RGB: the
/// largest that careen draws. Two take three times as much, and large ones are compared one after another.
inline constexpr std::uint64_t kMostBytesCompared = 3 * kMostPixels;

/// Compares two PNG files; InputError if one is not a PNG or beyond kMostBytesCompared, or if ignored regions
/// do not fit. Pictures of two sizes differ. Files identical byte for byte are not decoded, but their
/// checksums must be right.
Comparison comparePictures(const std::filesystem::path& expected, const std::filesystem::path& actual,
                           const ComparisonSettings& settings);

/// Compares all PNG files of two folders, by their paths there; the suffix may be in any case. A frame that
/// is missing, broken or of another size counts as different. `sameMotion`: whether both films are known to
/// show one motion, or not. InputError if a folder has no PNG, or ignored regions do not fit a frame. Memory:
/// the frames being compared, and less than a kB for each of all.
Comparison compareFolders(const std::filesystem::path& expected, const std::filesystem::path& actual,
                          const ComparisonSettings& settings, std::optional<bool> sameMotion,
                          const ComparisonCallback& progress = {}, const std::stop_token& stop = {});

/// Compares two runs, which `read` reads.
using RunReader = std::function<Trajectory(const std::filesystem::path&)>;
Comparison compareRuns(
    const std::filesystem::path& expected, const std::filesystem::path& actual,
    const ComparisonSettings& settings,
    const RunReader& read = [](const std::filesystem::path& path) { return readTrajectory(path); });

}  // namespace careen
