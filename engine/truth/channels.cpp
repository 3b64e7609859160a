#include "truth/channels.h"

#include <algorithm>

#include "core/error.h"
#include "core/names.h"

namespace careen {

std::string ChannelSet::text() const {
  std::string names;
  for (std::size_t i = 0; i < kTruthChannels.size(); ++i) {
    if (asked_[i]) {
      names.append(names.empty() ? "" : ",").append(kTruthChannels[i]);
    }
  }
  return names;
}

ChannelSet channelsNamed(std::string_view text) {
  ChannelSet set;
  if (text == "all") {
    for (std::size_t i = 0; i < kTruthChannels.size(); ++i) {
      set.add(static_cast<TruthChannel>(i));
    }
    return set;
  }
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    set.add(static_cast<TruthChannel>(indexAmong(std::string(text.substr(0, comma)), kTruthChannels)));
    if (comma == text.size()) {
      return set;
    }
    text.remove_prefix(comma + 1);
  }
}

}  // namespace careen
