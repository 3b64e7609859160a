#pragma once

#include <string>
#include <vector>

#include "compare/comparison.h"

namespace careen {

/// "same", "warning", "different".
const char* nameOf(Verdict verdict);

/// "one; two; three".
std::string joined(const std::vector<std::string>& reasons);

/// Number of frames by result.
struct FrameCounts {
  std::size_t same = 0;
  std::size_t warning = 0;
  std::size_t different = 0;
  std::size_t identical = 0;    ///< byte for byte; also counted as same
  std::size_t notMeasured = 0;  ///< missing, broken or of another size; also counted as different
};
FrameCounts countFrames(const Comparison& comparison);

/// Whether there is nothing to show: files or motions are the same bit for bit, and so are their properties.
bool isEqual(const Comparison& comparison);

/// The reason for the verdict: the first difference and the worst, in sentences.
std::string reasonOf(const Comparison& comparison);

}  // namespace careen
