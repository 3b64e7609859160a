#pragma once

#include <string>
#include <vector>

#include "physics/world.h"
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

  std::vector<std::string> modelled() const;
  std::vector<std::string> leftOut() const;
};

/// What the scene's physics calls for.
Plan plan(const Scene& scene);

/// The world with what the plan models, and nothing else: what is left out is never executed.
World assemble(const Scene& scene, const Plan& plan);

}  // namespace careen
