#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "compare/picture_difference.h"

namespace careen {

/// How much two pictures may differ. The first six fields have the meaning of OpenImageIO's idiff: a pixel
/// fails if one of its channels differs by more than `fail`, and the pictures differ if more than
/// `failPercent` of the pixels fail or one differs by more than `hardFail`; likewise for a warning with
/// `warn`. All limits must hold.
struct Tolerance {
  static constexpr double kAny = std::numeric_limits<double>::infinity();

  double fail = 0;         ///< [1] of full scale
  double failPercent = 0;  ///< [%] of all pixels
  double hardFail = kAny;  ///< [1]
  double warn = 0;         ///< [1]
  double warnPercent = 0;  ///< [%]
  double hardWarn = kAny;  ///< [1]

  /// Whether pixels that edges explain, see differenceOf(), are ignored in failPercent and warnPercent.
  bool excuseEdges = false;
  /// [%] of pixels with a visibly different colour that edges do not explain; if not 0, a single pixel is
  /// always allowed.
  double changedPercent = 100;
  double edgePercent = 100;     ///< [%] of pixels with a visibly different colour that edges explain
  double leastSsim = -1;        ///< [1] of the picture
  double leastWindowSsim = -1;  ///< [1] of every window
};

/// Tolerances by name, strictest first:
/// - "exact": no sample differs.
/// - "same-machine": 0.005 % of the pixels may differ, by 1/255: threads, jobs, vectors wider than 128 bits.
/// - "same-picture": 0.01 % may differ by more than 1/255, 0.001 % or one pixel may differ visibly in colour:
///   other processors and versions of one renderer. Catches a box moved by a pixel and a colour off by 3/255.
/// - "other-renderer": edges may lie a third of a pixel elsewhere; of the other pixels 0.25 % may differ by
///   more than 4/255, or visibly in colour; SSIM is at least 0.98, that of every window 0.3. Catches a
///   missing shadow, a lost frame, a box moved by two pixels.
inline constexpr std::array<std::string_view, 4> kToleranceNames = {"exact", "same-machine", "same-picture",
                                                                    "other-renderer"};
/// InputError, which lists all names, for an unknown name.
Tolerance toleranceOf(std::string_view name);

/// Sets one of the numbers, such as "fail=0.1". Names are those of idiff's options where it has one: fail,
/// failpercent, hardfail, warn, warnpercent, hardwarn, changedpercent, edgepercent, ssim (the least of the
/// picture), windowssim. Returns name and number. InputError for another name, or a number out of bounds.
std::string setLimit(Tolerance& tolerance, const std::string& text);

enum class Verdict { kSame, kWarning, kDifferent };

struct PictureJudgement {
  Verdict verdict = Verdict::kSame;
  std::vector<std::string> reasons;  ///< what was found and what is allowed; only reasons for the verdict
};

PictureJudgement judge(const PictureDifference& difference, const Tolerance& tolerance);

}  // namespace careen
