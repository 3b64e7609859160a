#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "compare/run_difference.h"
#include "compare/tolerance.h"
#include "trajectory/trajectory_file.h"

namespace careen {

/// What a pair of frames came to, in few bytes: a film may have many.
struct FrameComparison {
  std::string name;  ///< the file's, the same in both folders
  Verdict verdict = Verdict::kSame;
  std::vector<std::string> reasons;  ///< why it is not the same, in words
  bool identical = false;            ///< the files are, byte for byte
  bool measured = false;             ///< the numbers below say something: both are there, whole, of one size
  double largest = 0;                ///< [1] difference of a channel
  int largestX = 0;                  ///< [px] where that is, from the upper left
  int largestY = 0;                  ///< [px]
  double mean = 0;                   ///< [1] absolute difference over all channels
  double psnr = 0;                   ///< [dB] infinite if no sample differs
  double ssim = 1;                   ///< [1]
  double worstSsim = 1;              ///< [1] of one window
  double failingPercent = 0;         ///< [%] of the pixels: those beyond the tolerance's `fail`
  double changedPercent = 0;         ///< [%] of the pixels: another colour to the eye, not explained by edges
  double edgePercent = 0;            ///< [%] of the pixels: another colour to the eye, explained by edges
  std::optional<double> flip;        ///< [1] mean ꟻLIP, if asked for
};

/// A property of both sides that explains a difference: renderer, scene hash and the like.
struct Fact {
  std::string name;
  std::string expected;
  std::string actual;
};

/// All that `careen compare` found.
struct Comparison {
  std::filesystem::path expected;  ///< a picture, a folder of frames, or a run
  std::filesystem::path actual;
  std::string program;        ///< name and version of what compared
  std::string toleranceName;  ///< with what was overridden: "same-picture, --fail 0.02"
  Tolerance tolerance;
  Verdict verdict = Verdict::kSame;
  std::string headline;  ///< the verdict in a sentence, such as "same motion, other picture"
  std::vector<Fact> facts;
  std::vector<FrameComparison> frames;  ///< in the order of their names; none where runs are compared
  std::optional<RunDifference> run;     ///< where runs are

  /// The first frame that is not the same, and the one that differs most; nothing if all are the same.
  const FrameComparison* firstDifferent() const;
  const FrameComparison* worst() const;
};

/// Files of a frame: the pictures themselves where two pictures are compared.
std::filesystem::path expectedFrame(const Comparison& comparison, const FrameComparison& frame);
std::filesystem::path actualFrame(const Comparison& comparison, const FrameComparison& frame);

struct ComparisonSettings {
  std::string program;
  std::string toleranceName = "same-picture";
  Tolerance tolerance = toleranceOf("same-picture");  ///< of pictures
  /// Of places [1], see PoseDifference; 0: every bit counts. Impacts need not be the same where it is not 0.
  double motionTolerance = 0;
  double until = std::numeric_limits<double>::infinity();  ///< [s] runs are compared up to there
  bool motionCounts = true;  ///< a film of another motion is another film, even if its pictures are the same
  bool flip = false;         ///< ꟻLIP, too, which takes ten times as long as all the rest
  int threads = 1;           ///< frames that are compared side by side
  std::set<std::string> only;  ///< of folders, the frames of these names; empty: all there are
};

/// Tells how many frames of how many are compared.
using ComparisonCallback = std::function<void(std::size_t done, std::size_t total)>;

/// Two PNG files; InputError if one is none. Files that are the same byte for byte are not unpacked, but
/// their checksums must be right.
Comparison comparePictures(const std::filesystem::path& expected, const std::filesystem::path& actual,
                           const ComparisonSettings& settings);

/// All PNG files of two folders, by name. A frame that is missing, broken or of another size is a different
/// one. `sameMotion`: whether both films are known to be of one motion, or not. InputError if a folder has no
/// PNG. Memory: the frames at hand, and less than a kB for each of all.
Comparison compareFolders(const std::filesystem::path& expected, const std::filesystem::path& actual,
                          const ComparisonSettings& settings, std::optional<bool> sameMotion,
                          const ComparisonCallback& progress = {}, const std::stop_token& stop = {});

/// Two trajectory files. `read`: how they are read, see SetupReader.
using RunReader = std::function<Trajectory(const std::filesystem::path&)>;
Comparison compareRuns(
    const std::filesystem::path& expected, const std::filesystem::path& actual,
    const ComparisonSettings& settings,
    const RunReader& read = [](const std::filesystem::path& path) { return readTrajectory(path); });

}  // namespace careen
