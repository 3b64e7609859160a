#include "render/window/scrub_bar.h"

#include <algorithm>
#include <cmath>

#include "render/overlay/style.h"

namespace careen {
namespace {

constexpr int kMargin = 8;  // [px] left and right of the groove
constexpr int kKnob = 4;    // [px] half its width
constexpr Color kGroove{70, 76, 82};

// Length of the groove; the picture may be narrower than the margins.
double grooveLength(int width) { return std::max(1, width - 1 - 2 * kMargin); }

}  // namespace

Picture withScrubBar(const Picture& picture, double part) {
  Picture whole{.width = picture.width, .height = picture.height + kScrubBarHeight, .rgb = picture.rgb};
  whole.rgb.reserve(whole.rowBytes() * static_cast<std::size_t>(whole.height));
  const double knob = kMargin + part * grooveLength(picture.width);
  for (int y = 0; y < kScrubBarHeight; ++y) {
    const double off = std::abs(y + 0.5 - 0.5 * kScrubBarHeight);  // [px] distance from the bar's middle
    for (int x = 0; x < picture.width; ++x) {
      Color color = kSlate;
      if (std::abs(x - knob) < kKnob && off < 0.4 * kScrubBarHeight) {
        color = kIvory;
      } else if (x >= kMargin && x < picture.width - kMargin && off < 0.15 * kScrubBarHeight) {
        color = x < knob ? kTeal : kGroove;
      }
      whole.rgb.insert(whole.rgb.end(), {color.red, color.green, color.blue});
    }
  }
  return whole;
}

double partOnScrubBar(double x, int width) {
  return std::clamp((x - kMargin) / grooveLength(width), 0.0, 1.0);
}

}  // namespace careen
