#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace careen {

/// A physical effect a scene may need, and why it is modelled or left out.
struct PlanItem {
  std::string what;  ///< "gravity", "drag", "springs", "box-wall", "box-box", "restitution", "friction", …
  bool modelled = false;
  std::string reason;
};

/// Which effects a world models, of those a scene needs.
struct Plan {
  std::vector<PlanItem> items;

  /// Whether the item of this name is modelled; every name is in the list.
  bool models(std::string_view what) const;
  std::vector<std::string> modelled() const;
  std::vector<std::string> leftOut() const;
};

}  // namespace careen
