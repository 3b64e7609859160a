#include "compare/page_pictures.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "compare/difference_image.h"
#include "core/base64.h"
#include "core/error.h"
#include "core/system/file.h"
#include "image/deep_picture.h"
#include "image/png.h"

namespace careen {
namespace {

using Json = nlohmann::ordered_json;

/// A picture's file content and its decoded pixels.
struct Source {
  std::string bytes;
  DeepPicture picture;
};

std::optional<Source> sourceOf(const std::filesystem::path& path) {
  try {
    Source source{.bytes = readFile(path), .picture = {}};
    source.picture = decodeDeepPng(source.bytes, path.string());
    return source;
  } catch (const InputError&) {
    return std::nullopt;  // the frame's reasons say that it is missing or broken
  }
}

std::string dataUri(std::string_view png) { return "data:image/png;base64," + base64(png); }

Json samplesAt(const DeepPicture& picture, int x, int y) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  const std::size_t at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)) *
      channels;
  Json samples = Json::array();
  for (std::size_t i = at; i < at + channels; ++i) {
    samples.push_back(picture.deep ? int{picture.samples16[i]} : int{picture.samples8[i]});
  }
  return samples;
}

Json pixelJson(const FrameComparison& frame, const DeepPicture& expected, const DeepPicture& actual) {
  return {{"x", frame.largestX},
          {"y", frame.largestY},
          {"full", expected.deep ? 65535 : 255},
          {"expected", samplesAt(expected, frame.largestX, frame.largestY)},
          {"actual", samplesAt(actual, frame.largestX, frame.largestY)}};
}

void addDifference(Json& json, const FrameComparison& frame, const IgnoredRegions& regions,
                   DeepPicture& expected, DeepPicture& actual) {
  const PixelMask ignored = regions.of(expected.width, expected.height);
  makeComparable(expected, actual, ignored);
  const int factor = amplificationOf(expected, actual);
  json["difference"] = dataUri(encodePng(differenceImage(expected, actual, factor)));
  json["factor"] = factor;
  if (frame.largest > 0) {
    json["pixel"] = pixelJson(frame, expected, actual);
  }
  if (!ignored.empty()) {
    json["ignored"] = dataUri(encodePng(ignoredImage(ignored), PngColor{0, 0, 0}));
  }
}

Json pictureJson(const Comparison& comparison, const FrameComparison& frame) {
  std::optional<Source> expected = sourceOf(expectedFrame(comparison, frame));
  std::optional<Source> actual = sourceOf(actualFrame(comparison, frame));
  Json json = {{"width", 0},        {"height", 0},           {"expected", nullptr},
               {"actual", nullptr}, {"difference", nullptr}, {"ignored", nullptr},
               {"factor", nullptr}, {"pixel", nullptr}};
  for (const auto* const side : {&actual, &expected}) {
    if (*side) {
      json["width"] = std::max(json["width"].get<int>(), (*side)->picture.width);
      json["height"] = std::max(json["height"].get<int>(), (*side)->picture.height);
    }
  }
  if (expected) {
    json["expected"] = dataUri(expected->bytes);
  }
  if (actual) {
    json["actual"] = dataUri(actual->bytes);
  }
  if (frame.measured && expected && actual && otherSize(expected->picture, actual->picture).empty()) {
    addDifference(json, frame, comparison.ignored, expected->picture, actual->picture);
  }
  return json;
}

std::size_t bytesOf(const Json& picture) {
  std::size_t bytes = 0;
  for (const char* key : {"expected", "actual", "difference", "ignored"}) {
    bytes += picture[key].is_string() ? picture[key].get_ref<const std::string&>().size() : 0;
  }
  return bytes;
}

}  // namespace

std::vector<std::size_t> framesToShow(const Comparison& comparison, std::size_t most) {
  const std::vector<FrameComparison>& frames = comparison.frames;
  std::vector<std::size_t> chosen;
  const auto choose = [&](std::size_t frame) {
    if (chosen.size() < most && std::find(chosen.begin(), chosen.end(), frame) == chosen.end()) {
      chosen.push_back(frame);
    }
  };
  const FrameComparison* const first = comparison.firstDifferent();
  if (first == nullptr) {
    const auto largest = std::max_element(
        frames.begin(), frames.end(),
        [](const FrameComparison& a, const FrameComparison& b) { return a.largest < b.largest; });
    if (largest != frames.end() && !largest->identical) {
      choose(static_cast<std::size_t>(largest - frames.begin()));
    }
    return chosen;
  }
  choose(static_cast<std::size_t>(first - frames.data()));
  choose(static_cast<std::size_t>(comparison.worst() - frames.data()));
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].verdict != Verdict::kSame) {
      others.push_back(i);
    }
  }
  // Both ends are included; fewer than `most` if one of these was chosen above.
  const std::size_t steps = std::min(others.size(), most);
  for (std::size_t k = 0; k < steps; ++k) {
    choose(others[steps == 1 ? 0 : k * (others.size() - 1) / (steps - 1)]);
  }
  return chosen;
}

std::string picturesJson(const Comparison& comparison, std::size_t mostBytes) {
  Json pictures = Json::object();
  std::size_t bytes = 0;
  for (const std::size_t place : framesToShow(comparison)) {
    const FrameComparison& frame = comparison.frames[place];
    Json picture = pictureJson(comparison, frame);
    const std::size_t more = bytesOf(picture);
    if (pictures.empty() || bytes + more <= mostBytes) {
      bytes += more;
      pictures[frame.name] = std::move(picture);
    }
  }
  return pictures.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace careen
