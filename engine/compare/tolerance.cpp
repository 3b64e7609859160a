#include "compare/tolerance.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/names.h"

namespace careen {
namespace {

constexpr double kStep = 1.0 / 255;

// Measured on frames 0 and 40 of careen, pile, wall, gas, dzhanibekov, domino and hecker-1997, 320x180 and
// 1280x720 (softpipe: 320x180), llvmpipe of Mesa 22.3.6, compared with the same frames drawn with other
// threads, with SSE2 only, by softpipe, and with deliberate changes. Each row is the worst case of a
// renderer, or the change nearest to passing; "over n" is the % of pixels with a channel off by more than
// n/255. Changes and (+) were measured with earlier dithers, by noise or by rows, and with a cube too:
//
//                                   over 0  over 1  colour changed %  SSIM   of a window
//                                                   edges  others
//   threads, 256 bits               0       0       0      0          1       1
//   Mesa 26.1.6 (golden frames)     0       0       0      0          1       1
//   Mesa 20.3.5 (*+)                0.063   0.0002  0      0          1.0000  0.998
//   Mesa 25.0.7, 26.2.6 (*+)        0       0       0      0          1       1
//   SSE2                            0.096   0.0017  0      0          1.0000  0.999
//   SSE2 (+)                        0.17    0.0017  0.0001 0.0001     1.0000  0.970
//   SSE2, Mesa 26.2.6 (*+)          0.15    0.0017  0.0002 0.0002     1.0000  0.938
//   softpipe                        34      4.5     1.16   0.057      0.9977  0.782
//   softpipe (+)                    35      8.8     1.71   0.111      0.9962  0.587
//   softpipe, Mesa 26.2.6 (*+)      35      8.8     1.71   0.120      0.9962  0.586
//   a box's colour 3/255 off        3.1     2.3     0      0          1.0000  1.000
//   a box 1 px off                  0.72    0.57    0.17   0.20       0.9962  0.173
//   a box 2 px off                  0.94    0.75    0.10   0.52       0.9909  -0.398
//   no shadow                       0.78    0.77    0.001  0.76       0.9969  -0.389
//   another face of a cube          3.1     3.1     0.05   2.80       0.9790  -0.516
//   next frame: domino, one falls   0.25    0.16    0.012  0.083      0.9984  0.042
//   next frame: pile, boxes fall    12.7    9.4     4.87   0.48       0.9896  0.451
//
// (*) frames 20 and 40 of all scenes in assets/scenes; Mesa 26 through EGL, as it has no OSMesa.
//
// So same-picture is set to 0.01 % over 1: six times what it must accept, a sixteenth of what it must reject.
// It detects smaller things, such as a box of 16 pixels, by their colour: 0.001 %, or one pixel, may differ
// visibly. Of 300 frames of wall, 1280x720, SSE2 changed at most 0.0009 % by more than 1/255 and two pixels'
// colours (0.0002 %); one such pixel alone reduced a window's SSIM to 0.71, so no limit applies to windows.
// other-renderer lies between 0.120 and 0.48 % of changed colours, and between 0.586 and 0.106 (hecker-1997,
// next frame) of a window's SSIM; every change above violates one of the two.
constexpr std::array<Tolerance, 4> kTolerances{{
    {},
    {.failPercent = 0.005, .hardFail = kStep},
    {.fail = kStep, .failPercent = 0.01, .warnPercent = 0.5, .changedPercent = 0.001},
    {.fail = 4 * kStep,
     .failPercent = 0.25,
     .warn = 2 * kStep,
     .warnPercent = 0.25,
     .excuseEdges = true,
     .changedPercent = 0.25,
     .edgePercent = 5,
     .leastSsim = 0.98,
     .leastWindowSsim = 0.3},
}};

/// Collects lines such as "0.12 % of the pixels are off by more than 0.0039; 0.01 % may be".
class Reasons {
 public:
  template <class... Parts>
  void addIf(bool broken, const Parts&... parts) {
    if (broken) {
      std::ostringstream line;
      line.precision(4);
      (line << ... << parts);
      lines_.push_back(line.str());
    }
  }
  std::vector<std::string> take() { return std::move(lines_); }

 private:
  std::vector<std::string> lines_;
};

// A difference of exactly n steps must not exceed n steps because of how the division was rounded.
double withinRounding(double threshold) { return threshold * (1 + 1e-12); }

struct Limits {
  double each, percent, any;
};

void compare(Reasons& reasons, const PictureDifference& difference, const Limits& limits, bool edgesToo) {
  const auto pixels = static_cast<double>(difference.pixels);
  const double over =
      100 * static_cast<double>(difference.pixelsOver(withinRounding(limits.each), edgesToo)) / pixels;
  const char* const which = edgesToo ? " % of the pixels" : " % of the pixels, without those at edges,";
  reasons.addIf(over > limits.percent, over, which, " differ by more than ", limits.each, "; at most ",
                limits.percent, " % may");
  static constexpr std::array<const char*, 4> kChannels{"red", "green", "blue", "alpha"};
  reasons.addIf(difference.largest > withinRounding(limits.any),
                kChannels.at(static_cast<std::size_t>(difference.largestChannel)), " differs by ",
                difference.largest, " at (", difference.largestX, ", ", difference.largestY, "); at most ",
                limits.any, " is allowed");
}

void compareLook(Reasons& reasons, const PictureDifference& difference, const Tolerance& tolerance) {
  const auto percent = [&difference](std::size_t count) {
    return 100 * static_cast<double>(count) / static_cast<double>(difference.pixels);
  };
  const std::size_t inside = difference.changed - difference.changedByEdges;
  const double changed = percent(inside);
  reasons.addIf(changed > tolerance.changedPercent && (inside > 1 || tolerance.changedPercent == 0), changed,
                " % of the pixels differ visibly in colour; at most ", tolerance.changedPercent, " % may");
  const double edges = percent(difference.changedByEdges);
  reasons.addIf(edges > tolerance.edgePercent, edges,
                " % of the pixels differ visibly in colour at edges; at most ", tolerance.edgePercent,
                " % may");
  reasons.addIf(!(difference.ssim >= tolerance.leastSsim), "SSIM is ", difference.ssim, "; at least ",
                tolerance.leastSsim, " is expected");
  reasons.addIf(!(difference.worstSsim >= tolerance.leastWindowSsim), "SSIM is ", difference.worstSsim,
                " around (", difference.worstSsimX, ", ", difference.worstSsimY, "); at least ",
                tolerance.leastWindowSsim, " is expected");
}

}  // namespace

Tolerance toleranceOf(std::string_view name) { return kTolerances.at(indexAmong(name, kToleranceNames)); }

PictureJudgement judge(const PictureDifference& difference, const Tolerance& tolerance) {
  if (difference.differing == 0) {
    return {};
  }
  Reasons failures;
  compare(failures, difference, {tolerance.fail, tolerance.failPercent, tolerance.hardFail},
          !tolerance.excuseEdges);
  compareLook(failures, difference, tolerance);
  std::vector<std::string> reasons = failures.take();
  if (!reasons.empty()) {
    return {Verdict::kDifferent, std::move(reasons)};
  }
  Reasons warnings;
  compare(warnings, difference, {tolerance.warn, tolerance.warnPercent, tolerance.hardWarn},
          !tolerance.excuseEdges);
  reasons = warnings.take();
  return {reasons.empty() ? Verdict::kSame : Verdict::kWarning, std::move(reasons)};
}

std::string setLimit(Tolerance& tolerance, const std::string& text) {
  struct Limit {
    std::string_view name;
    double Tolerance::*value;
    double most;
  };
  constexpr double kAny = Tolerance::kAny;
  constexpr std::array<Limit, 10> kLimits = {{{"fail", &Tolerance::fail, 1},
                                              {"failpercent", &Tolerance::failPercent, 100},
                                              {"hardfail", &Tolerance::hardFail, kAny},
                                              {"warn", &Tolerance::warn, 1},
                                              {"warnpercent", &Tolerance::warnPercent, 100},
                                              {"hardwarn", &Tolerance::hardWarn, kAny},
                                              {"changedpercent", &Tolerance::changedPercent, 100},
                                              {"edgepercent", &Tolerance::edgePercent, 100},
                                              {"ssim", &Tolerance::leastSsim, 1},
                                              {"windowssim", &Tolerance::leastWindowSsim, 1}}};
  const std::size_t equals = std::min(text.find('='), text.size());
  const auto* const found = std::find_if(kLimits.begin(), kLimits.end(), [&](const Limit& each) {
    return each.name == std::string_view(text).substr(0, equals);
  });
  if (found == kLimits.end()) {
    std::string known;
    for (const Limit& each : kLimits) {
      known.append(known.empty() ? "" : ", ").append(each.name);
    }
    throw InputError("found '" + text + "', expected NAME=NUMBER, with one of: " + known);
  }
  const char* const begin = text.data() + std::min(equals + 1, text.size());
  double limit = 0;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), limit);
  if (error != std::errc() || end != text.data() + text.size() || !(limit >= 0 && limit <= found->most)) {
    throw InputError("found '" + text + "', expected " + std::string(found->name) + "=0 " +
                     (found->most < kAny ? "to " + brief(found->most) : "or more"));
  }
  tolerance.*found->value = limit;
  return std::string(found->name) + "=" + brief(limit);
}

}  // namespace careen
