#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace careen {

/// What a pixel can be labelled with; see truth_frame.h for the arrays.
enum class TruthChannel { kDepth, kDistance, kInstance, kFace, kNormal, kCoordinates, kFlow, kVisibility };
inline constexpr std::array<std::string_view, 8> kTruthChannels = {
    "depth", "distance", "instance", "face", "normal", "coordinates", "flow", "visibility"};

class ChannelSet {
 public:
  void add(TruthChannel channel) { asked_.at(static_cast<std::size_t>(channel)) = true; }
  bool has(TruthChannel channel) const { return asked_.at(static_cast<std::size_t>(channel)); }
  std::string text() const;  ///< names, separated by commas

  friend bool operator==(const ChannelSet&, const ChannelSet&) = default;

 private:
  std::array<bool, kTruthChannels.size()> asked_{};
};

/// "depth,flow", or "all". InputError for an unknown name; it lists the known ones.
ChannelSet channelsNamed(std::string_view text);

}  // namespace careen
