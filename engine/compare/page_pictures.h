#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compare/comparison.h"

namespace careen {

/// A page is to open at once and to go through the mail, whatever the film: so many frames at most come with
/// their pictures, and with those after the first one no more than so many bytes of them, as base64.
inline constexpr std::size_t kPageFrames = 12;
inline constexpr std::size_t kPageBytes = 30'000'000;

/// The frames that tell most, by their place, most important first: the first that differs, the worst, then
/// others that differ, spread evenly. Where all are the same, the one that differs most, if any does.
std::vector<std::size_t> framesToShow(const Comparison& comparison, std::size_t most = kPageFrames);

/// Those frames' pictures, as JSON by the frames' names:
///
///     {"frame-00004.png": {"width": 320, "height": 180, "expected": "data:image/png;base64,…", "actual":
///     "…",
///      "difference": "…", "factor": 16, "pixel": {"x": 8, "y": 5, "full": 255, "expected": [1, 2, 3],
///      "actual": […]}}}
///
/// The files byte for byte, and the difference, which is multiplied by `factor`; `pixel` is the worst one,
/// its samples of `full`. A picture that is not there or broken is null, as is all that needs both.
std::string picturesJson(const Comparison& comparison, std::size_t mostBytes = kPageBytes);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace careen
