#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "compare/comparison.h"
#include "image/picture.h"
#include "image/png.h"
#include "support/trajectories.h"

namespace careen {

/// A grey picture with a square of that level in it, from column `at` on.
inline Picture squareOn(int width, int height, int at, std::uint8_t level) {
  Picture picture{.width = width, .height = height, .rgb = {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool inside = x >= at && x < at + height / 3 && y >= height / 3 && y < 2 * height / 3;
      picture.rgb.insert(picture.rgb.end(), 3, inside ? level : std::uint8_t{90});
    }
  }
  return picture;
}

inline FrameComparison sameFrame(const std::string& name) {
  FrameComparison frame;
  frame.name = name;
  frame.identical = true;
  frame.measured = true;
  frame.psnr = std::numeric_limits<double>::infinity();
  return frame;
}

inline FrameComparison otherFrame(const std::string& name, double largest, int x = 0, int y = 0) {
  FrameComparison frame;
  frame.name = name;
  frame.verdict = Verdict::kDifferent;
  frame.reasons = {"3 % of the pixels differ; at most 0.01 % may"};
  frame.measured = true;
  frame.largest = largest;
  frame.largestX = x;
  frame.largestY = y;
  frame.mean = largest / 100;
  frame.psnr = 20 - 20 * largest;
  frame.ssim = 1 - largest / 2;
  frame.worstSsim = 0.5;
  frame.failingPercent = 3;
  frame.changedPercent = 1;
  return frame;
}

inline std::string frameName(int frame) {
  const std::string digits = std::to_string(frame);
  return std::string(6 - digits.size(), '0') + digits + ".png";
}

/// Films with that many frames in `folder`/expected and /actual: from frame `firstOther` on the square is
/// brighter by 40 of 255, and in `worst` by 120.
inline Comparison filmComparison(const std::filesystem::path& folder, int frames, int firstOther, int worst) {
  Comparison comparison;
  comparison.expected = folder / "expected";
  comparison.actual = folder / "actual";
  comparison.program = "careen 1.2.3";
  comparison.toleranceName = "same-picture";
  comparison.tolerance = toleranceOf("same-picture");
  comparison.facts = {{"renderer", "OSMesa", "OSMesa"}, {"scene hash", "0123", "4567"}};
  std::filesystem::create_directories(comparison.expected);
  std::filesystem::create_directories(comparison.actual);
  for (int k = 0; k < frames; ++k) {
    const int off = k == worst ? 120 : k >= firstOther ? 40 : 0;
    const int at = k % 60;
    writePng(comparison.expected / frameName(k), squareOn(96, 54, at, 100));
    writePng(comparison.actual / frameName(k), squareOn(96, 54, at, static_cast<std::uint8_t>(100 + off)));
    comparison.frames.push_back(off > 0 ? otherFrame(frameName(k), off / 255.0, at, 18)
                                        : sameFrame(frameName(k)));
  }
  comparison.verdict = firstOther < frames ? Verdict::kDifferent : Verdict::kSame;
  comparison.headline = firstOther < frames ? "other picture" : "same files";
  return comparison;
}

/// Two runs of driftAndReturn() that diverge at its impact.
inline Comparison twoRuns() {
  const Trajectory run = driftAndReturn();
  Trajectory other = run;
  other.impacts[0].impulse = 8.5;
  std::get<EulerStep>(other.tracks[0].segments.open()[1].motion).start.velocity.x() = -1;
  Comparison comparison;
  comparison.verdict = Verdict::kDifferent;
  comparison.headline = "other motion";
  comparison.run = differenceOf(run, other);
  return comparison;
}

}  // namespace careen
