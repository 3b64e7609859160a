#include "image/matte.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "image/srgb.h"

namespace careen {
namespace {

constexpr double kFull = 255;
constexpr double kFullLight = 65535;
constexpr double kNoise = 1;  // of 255: far away from boxes, rounding makes no shadow

using Rgb = std::array<double, 3>;  // 0 … 255, sRGB

struct Layer {
  Rgb color{};
  double alpha = 0;  // 0 … 1
};

// What over `before` gives `after`, of the least alpha of 255 steps: the channel that needs most of it
// becomes black or full, or nearly.
Layer changeOf(const std::uint8_t* before, const std::uint8_t* after) {
  Layer change;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double from = before[channel];
    const double to = after[channel];
    if (std::abs(to - from) <= kNoise) {
      continue;
    }
    const double needed = (to - from) / (to < from ? -from : kFull - from);
    change.alpha = std::max(change.alpha, needed);
  }
  change.alpha = std::ceil(kFull * change.alpha) / kFull;
  for (std::size_t channel = 0; channel < 3 && change.alpha > 0; ++channel) {
    const double from = before[channel];
    change.color.at(channel) = std::clamp(from + (after[channel] - from) / change.alpha, 0.0, kFull);
  }
  return change;
}

Layer boxLayer(const std::uint8_t* boxes, const std::uint8_t* coverage) {
  const SrgbTables& srgb = SrgbTables::get();
  Layer layer{.alpha = srgb.linear(coverage[0]) / kFullLight};
  for (std::size_t channel = 0; channel < 3 && layer.alpha > 0; ++channel) {
    const double light = std::min(srgb.linear(boxes[channel]) / layer.alpha, kFullLight);
    layer.color.at(channel) = srgb.encoded(static_cast<std::uint16_t>(std::lround(light)));
  }
  return layer;
}

std::uint8_t rounded(double value) { return static_cast<std::uint8_t>(std::lround(value)); }

}  // namespace

Picture onNothing(const MatteParts& parts) {
  const std::size_t pixels = parts.boxes.rgb.size() / 3;
  Picture picture{.width = parts.boxes.width, .height = parts.boxes.height, .rgb = {}};
  picture.rgb.resize(3 * pixels);
  picture.alpha.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const Layer box = boxLayer(&parts.boxes.rgb[3 * i], &parts.coverage.rgb[3 * i]);
    const Layer shadow = changeOf(&parts.emptyStage.rgb[3 * i], &parts.stage.rgb[3 * i]);
    const double behind = (1 - box.alpha) * shadow.alpha;
    const double alpha = box.alpha + behind;
    picture.alpha[i] = rounded(kFull * alpha);
    for (std::size_t channel = 0; channel < 3 && alpha > 0; ++channel) {
      const double color = box.alpha * box.color.at(channel) + behind * shadow.color.at(channel);
      picture.rgb[3 * i + channel] = rounded(color / alpha);
    }
  }
  return picture;
}

}  // namespace careen
