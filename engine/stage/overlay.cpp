#include "stage/overlay.h"

#include <algorithm>

#include "core/error.h"
#include "core/names.h"

namespace careen {
namespace {

constexpr std::string_view kNone = "none";

}  // namespace

bool OverlaySet::any() const {
  return std::any_of(shown_.begin(), shown_.end(), [](bool shown) { return shown; });
}

std::string OverlaySet::text() const {
  std::string text;
  for (std::size_t i = 0; i < shown_.size(); ++i) {
    if (shown_[i]) {
      text.append(text.empty() ? "" : ",").append(kOverlayNames.at(i));
    }
  }
  return text.empty() ? std::string(kNone) : text;
}

OverlaySet overlaysNamed(std::string_view text) {
  OverlaySet set;
  if (text == kNone) {
    return set;
  }
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string_view name = text.substr(start, end - start);
    const auto* const at = std::find(kOverlayNames.begin(), kOverlayNames.end(), name);
    if (at == kOverlayNames.end()) {
      throw InputError("found '" + std::string(name) + "', expected one or more of: " + std::string(kNone) +
                       ", " + listed(kOverlayNames));
    }
    set.add(static_cast<Overlay>(at - kOverlayNames.begin()));
    start = end + 1;
  }
  return set;
}

}  // namespace careen
