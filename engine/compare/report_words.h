#pragma once

#include <string>
#include <vector>

#include "compare/comparison.h"

namespace careen {

/// "same", "warning", "different".
const char* nameOf(Verdict verdict);

/// "one; two; three".
std::string joined(const std::vector<std::string>& reasons);

/// How many frames came to what.
struct FrameCounts {
  std::size_t same = 0;
  std::size_t warning = 0;
  std::size_t different = 0;
  std::size_t identical = 0;    ///< byte for byte; they are the same, too
  std::size_t notMeasured = 0;  ///< missing, broken or of another size; they differ, too
};
FrameCounts countFrames(const Comparison& comparison);

/// Whether there is nothing to show: files or motions the same bit for bit, and what belongs to them.
bool isEqual(const Comparison& comparison);

/// Why the verdict is what it is: the first difference and the worst, in sentences.
std::string reasonOf(const Comparison& comparison);

}  // namespace careen
