#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compare/comparison.h"

namespace careen {

/// The page must open quickly and fit into an e-mail, whatever the film's length: at most this many frames
/// come with pictures, and those after the first one take at most this many bytes, as base64.
inline constexpr std::size_t kPageFrames = 12;
inline constexpr std::size_t kPageBytes = 30'000'000;

/// Indices of the most informative frames, most important first: the first that differs, the worst, then
/// others that differ, spread evenly. If all are the same, the one that differs most, if any.
std::vector<std::size_t> framesToShow(const Comparison& comparison, std::size_t most = kPageFrames);

/// The pictures of those frames, as JSON keyed by frame name:
///
///     {"frame-00004.png": {"width": 320, "height": 180, "expected": "data:image/png;base64,…", "actual":
///     "…",
///      "difference": "…", "ignored": null, "factor": 16, "pixel": {"x": 8, "y": 5, "full": 255, "expected":
///      [1, 2, 3], "actual": […]}}}
///
/// It holds the files byte for byte, and the difference, multiplied by `factor`; `ignored` marks the regions
/// that do not count and is transparent elsewhere; `pixel` is the worst one, with samples of `full`. A
/// missing or broken picture is null, and so is everything that needs both.
std::string picturesJson(const Comparison& comparison, std::size_t mostBytes = kPageBytes);

}  // namespace careen
