#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// One thing that may be called for, and why it is modelled or left out.
struct PlanItem {
  std::string what;  ///< "gravity", "drag", "springs", "box-wall", "box-box", "restitution", "friction", …
  bool modelled = false;
  std::string reason;
};

/// What a world has of what a scene calls for.
struct Plan {
  std::vector<PlanItem> items;

  /// Whether the item of that name is modelled; every name is in the list.
  bool models(std::string_view what) const;
  std::vector<std::string> modelled() const;
  std::vector<std::string> leftOut() const;
};

}  // namespace careen
