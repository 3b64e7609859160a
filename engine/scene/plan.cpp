#include "scene/plan.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace careen {
namespace {

// What a scene asks for that more than one item turns on.
struct Wants {
  std::vector<Wall> walls;
  std::size_t movingBoxes = 0;
  bool meetsWalls = false;
  bool meetsBoxes = false;  // if the method had contact between boxes
  bool rebounds = false;    // some box and wall that may meet have restitution
  bool rubs = false;        // … or friction
};

Wants wantsOf(const Scene& scene) {
  Wants wants{.walls = wallsOf(scene)};
  for (const SceneBox& box : scene.boxes) {
    wants.movingBoxes += box.fixed ? 0U : 1U;
    for (const Wall& wall : wants.walls) {
      const Material pair = touching(box.material, wall.material);
      wants.rebounds = wants.rebounds || (!box.fixed && pair.restitution > 0);
      wants.rubs = wants.rubs || (!box.fixed && pair.friction > 0);
    }
  }
  wants.meetsWalls = wants.movingBoxes > 0 && !wants.walls.empty();
  wants.meetsBoxes = wants.movingBoxes > 0 && scene.boxes.size() > 1;
  return wants;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

PlanItem modelled(const char* what, const std::string& reason) { return {what, true, reason}; }
PlanItem leftOut(const char* what, const std::string& reason) { return {what, false, reason}; }

PlanItem gravity(const Scene& scene) {
  return scene.gravity.isZero(0) ? leftOut("gravity", "the scene has none")
                                 : modelled("gravity", "the scene sets it");
}

PlanItem drag(const Scene& scene) {
  if (!scene.drag) {
    return leftOut("drag", "the scene has none");
  }
  const bool some = scene.drag->linear > 0 || scene.drag->angular > 0;
  return some ? modelled("drag", "the scene sets it") : leftOut("drag", "both its coefficients are 0");
}

PlanItem springs(const Scene& scene) {
  return scene.springs.empty()
             ? leftOut("springs", "the scene has none")
             : modelled("springs", counted(scene.springs.size(), "spring", "springs") + " in the scene");
}

PlanItem boxWall(const Wants& wants) {
  if (wants.walls.empty()) {
    return leftOut("box-wall", "the scene has no walls");
  }
  if (!wants.meetsWalls) {
    return leftOut("box-wall", "every box is fixed");
  }
  return modelled("box-wall", counted(wants.walls.size(), "wall", "walls") + " and " +
                                  counted(wants.movingBoxes, "box", "boxes") + " that can move");
}

PlanItem boxBox(const Wants& wants) {
  return leftOut("box-box", wants.meetsBoxes ? "the 1997 sample had none: boxes pass through one another"
                                             : "no two boxes could meet");
}

PlanItem restitution(const Wants& wants) {
  if (!wants.meetsWalls) {
    return leftOut("restitution", "nothing meets a wall");
  }
  return wants.rebounds ? modelled("restitution", "the scene sets it")
                        : leftOut("restitution", "it is 0 wherever a box meets a wall");
}

PlanItem friction(const Wants& wants) {
  if (!wants.meetsWalls) {
    return leftOut("friction", "nothing meets a wall");
  }
  return leftOut("friction",
                 wants.rubs ? "THE SCENE ASKS FOR IT, but the 1997 sample had none: everything slides freely"
                            : "it is 0 wherever a box meets a wall");
}

PlanItem resting(const Wants& wants) {
  return leftOut("resting",
                 wants.meetsWalls
                     ? "the 1997 method cannot rest: where a box would come to lie, the run ends in an error"
                     : "nothing meets a wall");
}

}  // namespace

bool Plan::models(std::string_view what) const {
  const auto item =
      std::find_if(items.begin(), items.end(), [what](const PlanItem& each) { return each.what == what; });
  if (item == items.end()) {
    throw std::logic_error("no plan has an item " + std::string(what));
  }
  return item->modelled;
}

std::vector<std::string> Plan::modelled() const {
  std::vector<std::string> names;
  for (const PlanItem& item : items) {
    if (item.modelled) {
      names.push_back(item.what);
    }
  }
  return names;
}

std::vector<std::string> Plan::leftOut() const {
  std::vector<std::string> names;
  for (const PlanItem& item : items) {
    if (!item.modelled) {
      names.push_back(item.what);
    }
  }
  return names;
}

Plan plan(const Scene& scene) {
  const Wants wants = wantsOf(scene);
  return {{gravity(scene), drag(scene), springs(scene), boxWall(wants), boxBox(wants), restitution(wants),
           friction(wants), resting(wants), leftOut("joints", "the scene has none")}};
}

World assemble(const Scene& scene, const Plan& plan) {
  const auto modelledPart = [&plan](const Material& material) {
    return Material{.restitution = plan.models("restitution") ? material.restitution : 0,
                    .friction = plan.models("friction") ? material.friction : 0};
  };
  World world;
  for (const SceneBox& box : scene.boxes) {
    Body body{.name = box.name,
              .halfExtents = box.halfExtents,
              .mass = box.fixed ? immovable() : solidBox(box.halfExtents, box.mass),
              .material = modelledPart(box.material),
              .initial = {.pose = box.pose, .velocity = box.velocity}};
    body.initial.angularMomentum = angularMomentum(body.mass, box.pose.worldFromBody, box.angularVelocity);
    world.bodies.push_back(std::move(body));
  }
  if (plan.models("gravity")) {
    world.gravity = scene.gravity;
  }
  if (plan.models("box-wall")) {
    world.walls = wallsOf(scene);
    for (Wall& wall : world.walls) {
      wall.material = modelledPart(wall.material);
    }
  }
  if (plan.models("springs")) {
    world.springs = scene.springs;
  }
  if (plan.models("drag")) {
    world.drag = scene.drag;
  }
  return world;
}

}  // namespace careen
