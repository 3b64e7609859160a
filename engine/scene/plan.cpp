#include "scene/plan.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "core/error.h"
#include "physics/world/given_inertia.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"

namespace careen {
namespace {

// What the scene needs, where more than one item of the plan depends on it.
struct Needs {
  std::vector<Wall> walls;
  std::size_t movingBoxes = 0;
  bool hitsWalls = false;
  bool hitsBoxes = false;    // two boxes could collide, if the method allows it
  bool collides = false;     // some pair can collide with this method
  bool rebounds = false;     // … and have restitution
  bool hasFriction = false;  // … have friction
  bool stops = false;        // … are pulled together and do not separate at full speed
};

void addPair(Needs& needs, const Material& pair, bool pulled) {
  needs.collides = true;
  needs.rebounds = needs.rebounds || pair.restitution > 0;
  needs.hasFriction = needs.hasFriction || pair.friction > 0;
  needs.stops = needs.stops || (pulled && pair.restitution < 1);
}

/// Boxes that ask for the same when they meet another.
struct BoxKind {
  const SceneBox* one = nullptr;
  std::size_t count = 0;
};
using BoxTraits = std::array<bool, 4>;

BoxTraits boxTraitsOf(const SceneBox& box) {
  const Material& material = box.material;
  return {box.fixed, material.restitution > 0, material.restitution<1, material.friction> 0};
}

// Calls `look` with a box of each, for every two kinds of which two boxes do not pass through each other.
template <class Look>
void forKindsThatMeet(const Scene& scene, const Look& look) {
  std::map<BoxTraits, BoxKind> kinds;
  for (const SceneBox& box : scene.boxes) {
    BoxKind& kind = kinds[boxTraitsOf(box)];
    kind.one = &box;
    ++kind.count;
  }
  std::map<std::pair<BoxTraits, BoxTraits>, std::size_t> apart;
  for (const auto& [a, b] : scene.apart) {
    ++apart[std::minmax(boxTraitsOf(scene.boxes[static_cast<std::size_t>(a)]),
                        boxTraitsOf(scene.boxes[static_cast<std::size_t>(b)]))];
  }
  for (const auto& [traits, kind] : kinds) {
    for (const auto& [others, other] : kinds) {
      const std::size_t pairs =
          traits == others ? kind.count * (kind.count - 1) / 2 : kind.count * other.count;
      if (traits <= others && pairs > apart[{traits, others}]) {
        look(*kind.one, *other.one);
      }
    }
  }
}

bool isPulled(const Scene& scene) { return !scene.gravity.isZero(0) || !scene.gravityChanges.empty(); }

Needs needsOf(const Scene& scene) {
  Needs needs{.walls = wallsOf(scene)};
  const bool pulled = isPulled(scene);
  for (const SceneBox& box : scene.boxes) {
    needs.movingBoxes += box.fixed ? 0U : 1U;
    for (std::size_t w = 0; w < needs.walls.size() && !box.fixed; ++w) {
      addPair(needs, touching(box.material, needs.walls[w].material), pulled);
    }
  }
  forKindsThatMeet(scene, [&](const SceneBox& a, const SceneBox& b) {
    const bool could = !a.fixed || !b.fixed;
    needs.hitsBoxes = needs.hitsBoxes || could;
    if (could && traitsOf(scene.settings.method).boxBox) {
      addPair(needs, touching(a.material, b.material), pulled);
    }
  });
  needs.hitsWalls = needs.movingBoxes > 0 && !needs.walls.empty();
  return needs;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

PlanItem modelled(const char* what, const std::string& reason) { return {what, true, reason}; }
PlanItem leftOut(const char* what, const std::string& reason) { return {what, false, reason}; }

// Those that have this trait: "method exact or listing1".
std::string methodsWith(bool MethodTraits::*trait) {
  std::string text = "method";
  for (const MethodTraits& each : kMethods) {
    if (each.*trait) {
      text += (text == "method" ? " " : " or ") + std::string(each.name);
    }
  }
  return text;
}

std::string nameOf(Method method) { return std::string(traitsOf(method).name); }

PlanItem gravity(const Scene& scene) {
  const std::string changes =
      scene.gravityChanges.empty() ? ""
      : scene.gravityPath == GravityPath::kLinear
          ? "; it runs straight through " + counted(scene.gravityChanges.size() + 1, "point", "points")
          : "; it changes " + counted(scene.gravityChanges.size(), "time", "times");
  return isPulled(scene) ? modelled("gravity", "the scene sets it" + changes)
                         : leftOut("gravity", "the scene has none");
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

// What the scene has of `each`, which a joint may be.
template <class Is>
PlanItem joints(const Scene& scene, const char* what, const std::string& one, const Is& is) {
  const auto count = static_cast<std::size_t>(std::count_if(scene.joints.begin(), scene.joints.end(), is));
  return count == 0 ? leftOut(what, "the scene has none")
                    : modelled(what, counted(count, one, one + "s") + " in the scene");
}

PlanItem motors(const Scene& scene) {
  const std::size_t motors = scene.control ? scene.control->motors.size() : 0;
  const auto drives = static_cast<std::size_t>(std::count_if(
      scene.joints.begin(), scene.joints.end(), [](const Joint& joint) { return joint.keptRate != 0; }));
  std::string all = motors == 0 ? "" : counted(motors, "motor", "motors");
  if (drives > 0) {
    all += (motors == 0 ? "" : " and ") + counted(drives, "drive", "drives");
  }
  return all.empty() ? leftOut("motors", "the scene has none") : modelled("motors", all + " in the scene");
}

bool isRope(const Joint& joint) { return joint.kind == Joint::Kind::kRope; }
bool isLimited(const Joint& joint) { return joint.lowest > -Joint::kFree; }

PlanItem boxWall(const Needs& needs) {
  if (needs.walls.empty()) {
    return leftOut("box-wall", "the scene has no walls");
  }
  if (!needs.hitsWalls) {
    return leftOut("box-wall", "every box is fixed");
  }
  return modelled("box-wall", counted(needs.walls.size(), "wall", "walls") + " and " +
                                  counted(needs.movingBoxes, "box", "boxes") + " that can move");
}

PlanItem boxBox(const Scene& scene, const Needs& needs) {
  if (!needs.hitsBoxes) {
    return leftOut("box-box", "no two boxes can collide");
  }
  return traitsOf(scene.settings.method).boxBox
             ? modelled("box-box", counted(scene.boxes.size(), "box", "boxes") + " that can collide")
             : leftOut("box-box", "method " + nameOf(scene.settings.method) +
                                      " has none: boxes pass through one another");
}

const char* noCollision(const Scene& scene) {
  return traitsOf(scene.settings.method).boxBox ? "nothing can collide" : "no box can hit a wall";
}
const char* zeroInEveryPair(const Scene& scene) {
  return traitsOf(scene.settings.method).boxBox ? "it is 0 for every pair that can collide"
                                                : "it is 0 for every box and wall";
}

PlanItem restitution(const Scene& scene, const Needs& needs) {
  if (!needs.collides) {
    return leftOut("restitution", noCollision(scene));
  }
  return needs.rebounds ? modelled("restitution", "the scene sets it")
                        : leftOut("restitution", zeroInEveryPair(scene));
}

PlanItem friction(const Scene& scene, const Needs& needs) {
  if (!needs.collides) {
    return leftOut("friction", noCollision(scene));
  }
  if (!needs.hasFriction) {
    return leftOut("friction", zeroInEveryPair(scene));
  }
  return traitsOf(scene.settings.method).friction
             ? modelled("friction", traitsOf(scene.settings.method).rests
                                        ? "the scene sets it; at impacts and in contact"
                                        : "the scene sets it; at impacts")
             : leftOut("friction", "THE SCENE ASKS FOR IT, but method " + nameOf(scene.settings.method) +
                                       " has none: everything slides freely");
}

PlanItem belts(const Scene& scene, const Needs& needs) {
  const auto moves = [](const auto& each) { return each.material.surface.moves(); };
  const auto count = static_cast<std::size_t>(std::count_if(scene.walls.begin(), scene.walls.end(), moves) +
                                              std::count_if(scene.boxes.begin(), scene.boxes.end(), moves));
  return count == 0           ? leftOut("belts", "no surface moves along itself")
         : !needs.hasFriction ? leftOut("belts", "nothing that moves along itself is rough")
                              : modelled("belts", counted(count, "surface that moves", "surfaces that move"));
}

PlanItem courses(const Scene& scene) {
  const auto moving = [](const auto& all) {
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const auto& each) { return !each.course.empty(); }));
  };
  const std::size_t boxes = moving(scene.boxes);
  const std::size_t walls = moving(scene.walls);
  const std::string ofBoxes = counted(boxes, "fixed box that moves", "fixed boxes that move");
  const std::string ofWalls = counted(walls, "wall that moves", "walls that move");
  return boxes + walls == 0 ? leftOut("motions", "no fixed box moves by itself")
                            : modelled("motions", walls == 0   ? ofBoxes
                                                  : boxes == 0 ? ofWalls
                                                               : ofBoxes + " and " + ofWalls);
}

PlanItem resting(const Scene& scene, const Needs& needs) {
  if (!needs.collides) {
    return leftOut("resting", noCollision(scene));
  }
  if (!traitsOf(scene.settings.method).rests) {
    return leftOut("resting", "method " + nameOf(scene.settings.method) +
                                  " cannot rest: where a box would come to lie, the run ends in an error");
  }
  return needs.stops
             ? modelled("resting", "bounces die out; what touches slides, rocks, stacks and comes to rest")
             : leftOut("resting", "no collision under gravity has a restitution below 1");
}

// Of a box that can move.
MassProperties massOf(const SceneBox& box) {
  return box.inertia ? massWithTensor(box.mass, *box.inertia) : solidBox(box.halfExtents, box.mass);
}

// A scene places boxes by their middles, a world bodies by their centres of mass.
Body bodyOf(const SceneBox& box, const Material& material) {
  Body body{.name = box.name,
            .halfExtents = box.halfExtents,
            .boxCenter = box.center.isZero(0) ? box.center : Vec3(-box.center),
            .mass = box.fixed ? immovable() : massOf(box),
            .material = material,
            .initial = {}};
  if (!box.parts.empty()) {
    std::vector<BodyPart> parts;
    for (const BodyPart& part : box.parts) {
      parts.push_back(part.seenFrom(box.center));
    }
    setParts(body, std::move(parts));
  }
  if (!box.course.empty()) {
    body.course = box.course;
    body.initial = stateOf(box.course.front().at(0));
    return body;
  }
  body.initial.pose = bodyPose(body, box.pose);
  body.initial.velocity = bodyVelocity(body, box.pose.worldFromBody, box.velocity, box.angularVelocity);
  body.initial.angularMomentum = angularMomentum(body.mass, box.pose.worldFromBody, box.angularVelocity);
  return body;
}

template <class End>
End fromCenterOfMass(End end, const World& world) {
  if (end.body) {
    end.point += world.bodies[static_cast<std::size_t>(*end.body)].boxCenter;
  }
  return end;
}

void assembleJoints(const Scene& scene, const Plan& plan, World& world) {
  for (Joint joint : scene.joints) {
    if (!plan.models(isRope(joint) ? "ropes" : "joints")) {
      continue;
    }
    joint.from = fromCenterOfMass(joint.from, world);
    joint.to = fromCenterOfMass(joint.to, world);
    if (!plan.models("limits")) {
      joint.lowest = -Joint::kFree;
      joint.highest = Joint::kFree;
    }
    world.joints.push_back(std::move(joint));
  }
  world.apart = scene.apart;
}

void requireMethod(const Scene& scene, bool MethodTraits::*trait, const std::string& what) {
  if (!(traitsOf(scene.settings.method).*trait)) {
    throw InputError("scene " + scene.name + " has " + what + ", which method " +
                     nameOf(scene.settings.method) + " does not model; expected " + methodsWith(trait));
  }
}

// Of walls in the order of wallsOf. Lists only if one of them says something.
void takeSounds(const Scene& scene, Stage& stage) {
  const auto isSaid = [](const auto& each) { return each.has_value(); };
  if (std::any_of(scene.boxes.begin(), scene.boxes.end(),
                  [](const SceneBox& box) { return box.sound.has_value(); })) {
    for (const SceneBox& box : scene.boxes) {
      stage.boxSounds.push_back(box.sound.value_or(SoundMaterial()));
    }
  }
  const bool roomSays = scene.room && scene.room->sound;
  if (!roomSays && std::none_of(scene.wallSounds.begin(), scene.wallSounds.end(), isSaid)) {
    return;
  }
  const std::size_t walls = wallsOf(scene).size() - scene.walls.size();
  stage.wallSounds.assign(walls, roomSays ? *scene.room->sound : kSoundOfWalls);
  for (const std::optional<SoundMaterial>& sound : scene.wallSounds) {
    stage.wallSounds.push_back(sound.value_or(kSoundOfWalls));
  }
}

}  // namespace

Plan plan(const Scene& scene) {
  const Needs needs = needsOf(scene);
  return {{gravity(scene), drag(scene), springs(scene),
           joints(scene, "joints", "joint", [](const Joint& joint) { return !isRope(joint); }),
           joints(scene, "limits", "joint", isLimited), joints(scene, "ropes", "rope", isRope), motors(scene),
           boxWall(needs), boxBox(scene, needs), restitution(scene, needs), friction(scene, needs),
           belts(scene, needs), courses(scene), resting(scene, needs)}};
}

World assemble(const Scene& scene, const Plan& plan) {
  const auto modelledPart = [&plan](const Material& material) {
    return Material{.restitution = plan.models("restitution") ? material.restitution : 0,
                    .friction = plan.models("friction") ? material.friction : 0,
                    .surface = plan.models("belts") ? material.surface : SurfaceMotion{}};
  };
  if (plan.models("springs") || plan.models("drag")) {
    requireMethod(scene, &MethodTraits::forces, "springs or drag");
  }
  if (plan.models("joints") || plan.models("ropes")) {
    requireMethod(scene, &MethodTraits::joints, "joints");
  }
  if (plan.models("belts")) {
    requireMethod(scene, &MethodTraits::belts, "surfaces that move");
  }
  if (plan.models("motions")) {
    requireMethod(scene, &MethodTraits::belts,
                  std::any_of(scene.boxes.begin(), scene.boxes.end(),
                              [](const SceneBox& box) { return !box.course.empty(); })
                      ? "fixed boxes that move"
                      : "walls that move");
  }
  if (!scene.gravityChanges.empty()) {
    requireMethod(scene, &MethodTraits::gravityChanges, "gravity that changes");
  }
  World world;
  for (const SceneBox& box : scene.boxes) {
    world.bodies.push_back(bodyOf(box, modelledPart(box.material)));
  }
  if (plan.models("gravity")) {
    world.gravity = scene.gravity;
    world.gravityChanges = scene.gravityChanges;
    world.gravityPath = scene.gravityPath;
  }
  if (plan.models("box-wall")) {
    world.walls = wallsOf(scene);
    for (Wall& wall : world.walls) {
      wall.material = modelledPart(wall.material);
    }
  }
  if (plan.models("springs")) {
    for (Spring spring : scene.springs) {
      spring.from = fromCenterOfMass(spring.from, world);
      spring.to = fromCenterOfMass(spring.to, world);
      world.springs.push_back(spring);
    }
  }
  assembleJoints(scene, plan, world);
  if (plan.models("motors")) {
    world.control = scene.control;
  }
  if (plan.models("drag")) {
    world.drag = scene.drag;
  }
  return world;
}

Stage stageOf(const Scene& scene) {
  Stage stage;
  stage.name = scene.name;
  static_cast<Showing&>(stage) = scene;
  if (scene.room) {
    stage.room = *scene.room;
  }
  for (const Wall& wall : scene.walls) {
    stage.planes.push_back({.normal = wall.normal, .offset = wall.offset, .course = wall.course});
  }
  takeSounds(scene, stage);
  for (std::size_t body = 0; body < scene.boxes.size(); ++body) {
    const SceneBox& box = scene.boxes[body];
    stage.colors.push_back(box.color);
    if (!box.drawn.triangles.empty()) {
      stage.parts.push_back({.body = body, .mesh = box.drawn});
    }
  }
  return stage;
}

RunSetup setupOf(const Scene& scene) {
  RunSetup setup{.sceneText = scene.text,
                 .settings = scene.settings,
                 .world = {},
                 .stage = stageOf(scene),
                 .plan = plan(scene)};
  setup.world = assemble(scene, setup.plan);
  return setup;
}

}  // namespace careen
