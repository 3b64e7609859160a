#include "scene/plan.h"

#include <cstddef>
#include <utility>

#include "core/error.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"

namespace careen {
namespace {

// What the scene needs, where more than one item of the plan depends on it.
struct Wants {
  std::vector<Wall> walls;
  std::size_t movingBoxes = 0;
  bool meetsWalls = false;
  bool meetsBoxes = false;  // two boxes could collide, if the method allows it
  bool meets = false;       // some pair can collide with this method
  bool rebounds = false;    // … and have restitution
  bool rubs = false;        // … have friction
  bool stops = false;       // … are pulled together and do not separate at full speed
};

void meet(Wants& wants, const Material& pair, bool pulled) {
  wants.meets = true;
  wants.rebounds = wants.rebounds || pair.restitution > 0;
  wants.rubs = wants.rubs || pair.friction > 0;
  wants.stops = wants.stops || (pulled && pair.restitution < 1);
}

Wants wantsOf(const Scene& scene) {
  Wants wants{.walls = wallsOf(scene)};
  const bool pulled = !scene.gravity.isZero(0);
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const SceneBox& box = scene.boxes[i];
    wants.movingBoxes += box.fixed ? 0U : 1U;
    for (std::size_t w = 0; w < wants.walls.size() && !box.fixed; ++w) {
      meet(wants, touching(box.material, wants.walls[w].material), pulled);
    }
    for (std::size_t j = 0; j < i; ++j) {
      const SceneBox& other = scene.boxes[j];
      const bool could = !box.fixed || !other.fixed;
      wants.meetsBoxes = wants.meetsBoxes || could;
      if (could && traitsOf(scene.method).boxBox) {
        meet(wants, touching(box.material, other.material), pulled);
      }
    }
  }
  wants.meetsWalls = wants.movingBoxes > 0 && !wants.walls.empty();
  return wants;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

PlanItem modelled(const char* what, const std::string& reason) { return {what, true, reason}; }
PlanItem leftOut(const char* what, const std::string& reason) { return {what, false, reason}; }

std::string nameOf(Method method) { return std::string(traitsOf(method).name); }

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

PlanItem boxBox(const Scene& scene, const Wants& wants) {
  if (!wants.meetsBoxes) {
    return leftOut("box-box", "no two boxes could meet");
  }
  return traitsOf(scene.method).boxBox
             ? modelled("box-box", counted(scene.boxes.size(), "box", "boxes") + " that could meet")
             : leftOut("box-box",
                       "method " + nameOf(scene.method) + " has none: boxes pass through one another");
}

const char* nothingMeets(const Scene& scene) {
  return traitsOf(scene.method).boxBox ? "nothing meets anything" : "nothing meets a wall";
}
const char* zeroWhereTheyMeet(const Scene& scene) {
  return traitsOf(scene.method).boxBox ? "it is 0 wherever two things meet"
                                       : "it is 0 wherever a box meets a wall";
}

PlanItem restitution(const Scene& scene, const Wants& wants) {
  if (!wants.meets) {
    return leftOut("restitution", nothingMeets(scene));
  }
  return wants.rebounds ? modelled("restitution", "the scene sets it")
                        : leftOut("restitution", zeroWhereTheyMeet(scene));
}

PlanItem friction(const Scene& scene, const Wants& wants) {
  if (!wants.meets) {
    return leftOut("friction", nothingMeets(scene));
  }
  if (!wants.rubs) {
    return leftOut("friction", zeroWhereTheyMeet(scene));
  }
  return traitsOf(scene.method).friction
             ? modelled("friction", traitsOf(scene.method).rests
                                        ? "the scene sets it; at impacts and in contact"
                                        : "the scene sets it; at impacts")
             : leftOut("friction", "THE SCENE ASKS FOR IT, but method " + nameOf(scene.method) +
                                       " has none: everything slides freely");
}

PlanItem resting(const Scene& scene, const Wants& wants) {
  if (!wants.meets) {
    return leftOut("resting", nothingMeets(scene));
  }
  if (!traitsOf(scene.method).rests) {
    return leftOut("resting", "method " + nameOf(scene.method) +
                                  " cannot rest: where a box would come to lie, the run ends in an error");
  }
  return wants.stops
             ? modelled("resting", "bounces die out; what touches slides, rocks, stacks and comes to rest")
             : leftOut("resting", "nothing that meets loses speed and is pulled back");
}

}  // namespace

Plan plan(const Scene& scene) {
  const Wants wants = wantsOf(scene);
  return {{gravity(scene), drag(scene), springs(scene), boxWall(wants), boxBox(scene, wants),
           restitution(scene, wants), friction(scene, wants), resting(scene, wants)}};
}

World assemble(const Scene& scene, const Plan& plan) {
  const auto modelledPart = [&plan](const Material& material) {
    return Material{.restitution = plan.models("restitution") ? material.restitution : 0,
                    .friction = plan.models("friction") ? material.friction : 0};
  };
  if (!traitsOf(scene.method).forces && (plan.models("springs") || plan.models("drag"))) {
    throw InputError("scene " + scene.name + " has springs or drag, which method " + nameOf(scene.method) +
                     " does not model; expected method listing1");
  }
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

RunSettings settingsOf(const Scene& scene) {
  return {.method = scene.method, .duration = scene.duration, .dt = scene.dt, .tolerance = scene.tolerance};
}

Stage stageOf(const Scene& scene) {
  Stage stage;
  stage.name = scene.name;
  stage.camera = scene.camera;
  stage.cameraMove = scene.cameraMove;
  stage.timeMap = scene.timeMap;
  stage.picture = scene.picture;
  if (scene.room) {
    stage.room = *scene.room;
  }
  for (const Wall& wall : scene.walls) {
    stage.planes.push_back({.normal = wall.normal, .offset = wall.offset});
  }
  for (const SceneBox& box : scene.boxes) {
    stage.colors.push_back(box.color);
  }
  return stage;
}

RunSetup setupOf(const Scene& scene) {
  RunSetup setup{.sceneText = scene.text,
                 .settings = settingsOf(scene),
                 .world = {},
                 .stage = stageOf(scene),
                 .plan = plan(scene)};
  setup.world = assemble(scene, setup.plan);
  return setup;
}

}  // namespace careen
