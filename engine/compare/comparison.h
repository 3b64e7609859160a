#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/run_difference.h"
#include "compare/tolerance.h"

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

}  // namespace careen
