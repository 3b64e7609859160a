#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "physics/world/world.h"
#include "scene/scene.h"

namespace careen {

/// One thing a scene may call for, and why it is modelled or left out.
struct PlanItem {
  std::string what;  ///< "gravity", "drag", "springs", "box-wall", "box-box", "restitution", "friction", …
  bool modelled = false;
  std::string reason;
};

struct Plan {
  std::vector<PlanItem> items;

  /// Whether the item of that name is modelled; every name is in the list.
  bool models(std::string_view what) const;
  std::vector<std::string> modelled() const;
  std::vector<std::string> leftOut() const;
};

/// What the scene's physics calls for, and what its method has of it.
Plan plan(const Scene& scene);

/// The world with what the plan models, and nothing else: what is left out is never executed. Bodies are in
/// the order of the scene's boxes; fixed ones are immovable.
World assemble(const Scene& scene, const Plan& plan);

}  // namespace careen
