#include "scene/plan.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "physics/world/method.h"
#include "scene/scene_reader.h"
#include "support/input_error.h"
#include "support/scenes.h"

namespace careen {
namespace {

using Names = std::vector<std::string>;

Scene shipped(const std::string& name) {
  return readScene(std::filesystem::path(CAREEN_SOURCE_DIR) / "assets" / "scenes" / name);
}

Scene withParts(const std::string& parts) {
  return parseScene(R"({"careen": 1, "duration": 1, )" + parts + "}", "f");
}

std::string reasonFor(const Scene& scene, const std::string& what) {
  for (const PlanItem& item : plan(scene).items) {
    if (item.what == what) {
      return (item.modelled ? "modelled: " : "left out: ") + item.reason;
    }
  }
  return "not in the plan";
}

const std::string kBox = R"({"half_extents": [1, 1, 1], "mass": 1, "friction": 0.5, "position": [0, 0, 2]})";
const std::string kFixed =
    R"({"name": "post", "half_extents": [1, 1, 1], "fixed": true, "restitution": 1, "friction": 1})";
const std::string kFloor =
    R"("walls": [{"point": [0, 0, -1], "normal": [0, 0, 1], "restitution": 0.5, "friction": 0.5}])";

TEST(Plan, defaultSceneNeedsGravityAndWalls) {
  const Plan planned = plan(shipped("careen.json"));
  EXPECT_EQ(planned.modelled(), (Names{"gravity", "box-wall", "restitution", "resting"}));
  EXPECT_EQ(planned.leftOut(), (Names{"drag", "springs", "joints", "limits", "ropes", "motors", "box-box",
                                      "friction", "belts", "motions"}));
}

TEST(Plan, sampleOf1997NeedsSpringsAndDragToo) {
  const Plan planned = plan(shipped("hecker-1997.json"));
  EXPECT_EQ(planned.modelled(), (Names{"gravity", "drag", "springs", "box-wall", "restitution"}));
  EXPECT_EQ(planned.leftOut(), (Names{"joints", "limits", "ropes", "motors", "box-box", "friction", "belts",
                                      "motions", "resting"}));
}

TEST(Plan, saysWhyEachThingIsModelled) {
  const Scene scene = shipped("hecker-1997.json");
  EXPECT_EQ(reasonFor(scene, "gravity"), "modelled: the scene sets it");
  EXPECT_EQ(reasonFor(scene, "drag"), "modelled: the scene sets it");
  EXPECT_EQ(reasonFor(scene, "springs"), "modelled: 7 springs in the scene");
  EXPECT_EQ(reasonFor(scene, "box-wall"), "modelled: 6 walls and 6 boxes that can move");
  EXPECT_EQ(reasonFor(scene, "restitution"), "modelled: the scene sets it");
}

TEST(Plan, saysWhatTheMethodLacks) {
  const Scene scene =
      withParts(R"("method": "listing1", )" + kFloor + R"(, "boxes": [)" + kBox + ", " + kFixed + "]");
  EXPECT_EQ(reasonFor(scene, "box-box"),
            "left out: method listing1 has none: boxes pass through one another");
  EXPECT_EQ(reasonFor(scene, "friction"),
            "left out: THE SCENE ASKS FOR IT, but method listing1 has none: everything slides freely");
  EXPECT_EQ(reasonFor(scene, "resting"),
            "left out: method listing1 cannot rest: where a box would come to lie, the run ends in an error");
}

TEST(Plan, saysWhatTheExactMethodModels) {
  const Scene scene = withParts(kFloor + R"(, "boxes": [)" + kBox + ", " + kFixed + "]");
  EXPECT_EQ(reasonFor(scene, "box-box"), "modelled: 2 boxes that can collide");
  EXPECT_EQ(reasonFor(scene, "friction"), "modelled: the scene sets it; at impacts and in contact");
  EXPECT_EQ(reasonFor(scene, "resting"), "left out: no collision under gravity has a restitution below 1");
  const Scene pulled = withParts(R"("gravity": [0, 0, -1], )" + kFloor + R"(, "boxes": [)" + kBox + "]");
  EXPECT_EQ(reasonFor(pulled, "resting"),
            "modelled: bounces die out; what touches slides, rocks, stacks and comes to rest");
}

TEST(Plan, saysWhatTheSceneDoesNotAskFor) {
  const Scene lone = withParts(R"("boxes": [)" + kBox + "]");
  EXPECT_EQ(reasonFor(lone, "gravity"), "left out: the scene has none");
  EXPECT_EQ(reasonFor(lone, "drag"), "left out: the scene has none");
  EXPECT_EQ(reasonFor(lone, "springs"), "left out: the scene has none");
  for (const char* what : {"joints", "limits", "ropes", "motors"}) {
    EXPECT_EQ(reasonFor(lone, what), "left out: the scene has none");
  }
  EXPECT_EQ(reasonFor(lone, "box-wall"), "left out: the scene has no walls");
  EXPECT_EQ(reasonFor(lone, "box-box"), "left out: no two boxes can collide");
  for (const char* what : {"restitution", "friction", "resting"}) {
    EXPECT_EQ(reasonFor(lone, what), "left out: nothing can collide");
  }
  const Scene held = withParts(kFloor + R"(, "drag": {}, "boxes": [)" + kFixed + "]");
  EXPECT_EQ(reasonFor(held, "box-wall"), "left out: every box is fixed");
  EXPECT_EQ(reasonFor(held, "drag"), "left out: both its coefficients are 0");
  const Scene smooth =
      withParts(R"("walls": [{"point": [0, 0, -1], "normal": [0, 0, 1]}], "boxes": [)" + kBox + "]");
  EXPECT_EQ(reasonFor(smooth, "restitution"), "left out: it is 0 for every pair that can collide");
  EXPECT_EQ(reasonFor(smooth, "friction"), "left out: it is 0 for every pair that can collide");
}

TEST(Plan, countsJointsAndTheirLimits) {
  const Scene scene = parseScene(kJoints, "f");
  EXPECT_EQ(reasonFor(scene, "joints"), "modelled: 5 joints in the scene");
  EXPECT_EQ(reasonFor(scene, "limits"), "modelled: 2 joints in the scene");
  EXPECT_EQ(reasonFor(scene, "ropes"), "modelled: 1 rope in the scene");
  EXPECT_EQ(reasonFor(scene, "motors"), "modelled: 3 motors and 1 drive in the scene");
}

// Two boxes that are joined cannot collide; a third of the same kind can, with either.
TEST(Plan, boxesThatPassThroughEachOtherDoNotCollide) {
  const std::string two =
      R"("boxes": [{"name": "a", "half_extents": [1, 1, 1], "mass": 1, "restitution": 0.5},
                   {"name": "b", "half_extents": [1, 1, 1], "mass": 1, "restitution": 0.5}])";
  const Scene apart = withParts(two + R"(, "pass_through": [["b", "a"]])");
  EXPECT_EQ(reasonFor(apart, "box-box"), "left out: no two boxes can collide");
  EXPECT_EQ(reasonFor(apart, "restitution"), "left out: nothing can collide");
  EXPECT_EQ(assemble(apart, plan(apart)).apart, (std::vector<std::pair<int, int>>{{0, 1}}));
  const std::string three =
      std::string(two).replace(two.size() - 1, 1, R"(, {"name": "c", "half_extents": [1, 1, 1], "mass": 1,
                   "position": [4, 0, 0], "restitution": 0.5}])");
  const Scene some = withParts(three + R"(, "pass_through": [["b", "a"]])");
  EXPECT_EQ(reasonFor(some, "box-box"), "modelled: 3 boxes that can collide");
  EXPECT_EQ(assemble(some, plan(some)).apart, (std::vector<std::pair<int, int>>{{0, 1}}));
  const Scene none = withParts(three + R"(, "pass_through": [["b", "a", "c"]])");
  EXPECT_EQ(reasonFor(none, "box-box"), "left out: no two boxes can collide");
}

TEST(Plan, knowsNoOtherItems) {
  EXPECT_TRUE(plan(shipped("careen.json")).models("gravity"));
  EXPECT_FALSE(plan(shipped("careen.json")).models("drag"));
  EXPECT_THROW(plan(shipped("careen.json")).models("magnetism"), std::logic_error);
}

TEST(Assemble, buildsWhatThePlanModels) {
  const Scene scene = parseScene(kEveryKey, "f");
  const World world = assemble(scene, plan(scene));
  EXPECT_EQ(world.gravity, Vec3(0, 0, -9.81));
  ASSERT_EQ(world.walls.size(), 6U);  // of the room's six, two are open
  EXPECT_EQ(world.walls[0].name, "room-x");
  EXPECT_EQ(world.walls[4].name, "ramp");
  EXPECT_EQ(world.springs.size(), 2U);
  EXPECT_EQ(world.drag->linear, 0.5);
  ASSERT_EQ(world.bodies.size(), 3U);
  const Body& crate = world.bodies[0];
  EXPECT_EQ(crate.name, "crate");
  EXPECT_EQ(crate.halfExtents, Vec3(0.5, 0.25, 0.125));
  EXPECT_EQ(crate.mass.mass, 2);
  EXPECT_EQ(crate.initial.pose.position, Vec3(1, 0.5, 2));
  EXPECT_EQ(crate.initial.velocity, Vec3(6, 1.5, 0));
  EXPECT_EQ(crate.material.restitution, 0.75);
}

TEST(Assemble, namesTheMethodsThatModelSpringsAndDrag) {
  for (const MethodTraits& method : kMethods) {
    Scene scene = withParts(R"("drag": {"linear": 1}, "boxes": [)" + kBox + "]");
    scene.settings.method = method.method;
    std::string message;
    try {
      assemble(scene, plan(scene));
    } catch (const InputError& error) {
      message = error.what();
    }
    if (method.name == "exact" || method.name == "listing1") {
      EXPECT_EQ(message, "");
    } else {
      EXPECT_EQ(message, "scene " + scene.name + " has springs or drag, which method " +
                             std::string(method.name) + " does not model; expected method exact or listing1");
    }
  }
}

// The crate's centre of mass is 0.125 m from its middle along its x axis, the world's y: ends are relative to
// it. The lid's is its middle.
TEST(Assemble, endsOfJointsAreRelativeToCentresOfMass) {
  const Scene scene = parseScene(kJoints, "f");
  const World world = assemble(scene, plan(scene));
  ASSERT_EQ(world.joints.size(), 6U);
  const Joint& knee = world.joints[0];
  EXPECT_EQ(knee.name, "knee");
  EXPECT_EQ(knee.from.point, Vec3(0, 0.5, -0.125));
  EXPECT_LT((knee.to.point - Vec3(0.375, 0, 0)).norm(), 1e-15);
  EXPECT_EQ(knee.highest, 2.25);
  for (const Joint& joint : world.joints) {
    const auto poseOf = [&](const JointEnd& end) {
      return end.body ? world.bodies[static_cast<std::size_t>(*end.body)].initial.pose : Pose{};
    };
    const double apart =
        Vec3(joint.from.pointAt(poseOf(joint.from)) - joint.to.pointAt(poseOf(joint.to))).norm();
    EXPECT_NEAR(apart, joint.name == "stick" ? 1.75 : joint.name == "string" ? 2 : 0, 1e-15) << joint.name;
  }
  EXPECT_EQ(world.apart, (std::vector<std::pair<int, int>>{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 4}}));
}

TEST(Assemble, assemblesOnlyTheJointsOfThePlan) {
  const Scene scene = parseScene(kJoints, "f");
  Plan some = plan(scene);
  for (PlanItem& item : some.items) {
    item.modelled = item.what == "joints";
  }
  const World world = assemble(scene, some);
  ASSERT_EQ(world.joints.size(), 5U);
  EXPECT_EQ(world.joints[0].lowest, -Joint::kFree);
  EXPECT_EQ(world.joints[0].highest, Joint::kFree);
  EXPECT_EQ(world.apart, scene.apart);
  EXPECT_FALSE(world.control);
}

TEST(Assemble, namesTheMethodThatModelsJoints) {
  for (const MethodTraits& method : kMethods) {
    Scene scene = parseScene(kJoints, "f");
    scene.settings.method = method.method;
    const std::string message = inputErrorOf([&] { assemble(scene, plan(scene)); });
    EXPECT_EQ(message, method.name == "exact"
                           ? "no error"
                           : "scene untitled has joints, which method " + std::string(method.name) +
                                 " does not model; expected method exact");
  }
}

TEST(Assemble, surfacesThatMoveAreOfTheMethodExact) {
  const std::string belt =
      R"("walls": [{"point": [0, 0, -1], "normal": [0, 0, 1], "surface_velocity": [1, 0, 0], "friction": )";
  Scene scene = withParts(belt + R"(0.5}], "boxes": [)" + kBox + "]");
  EXPECT_EQ(reasonFor(scene, "belts"), "modelled: 1 surface that moves");
  EXPECT_EQ(assemble(scene, plan(scene)).walls[0].material.surface.velocity, Vec3(1, 0, 0));
  scene.settings.method = Method::kTaylor8;
  EXPECT_EQ(
      inputErrorOf([&] { assemble(scene, plan(scene)); }),
      "scene untitled has surfaces that move, which method taylor-8 does not model; expected method exact");
  const Scene smooth = withParts(belt + R"(0}], "boxes": [)" + kBox + "]");
  EXPECT_EQ(reasonFor(smooth, "belts"), "left out: nothing that moves along itself is rough");
  EXPECT_FALSE(assemble(smooth, plan(smooth)).walls[0].material.surface.moves());
}

TEST(Assemble, gravityThatChangesIsOfTheMethodExact) {
  const std::string boxes =
      R"("gravity": { "path": [[0, 0, 0, 0], [2, 0, 0, -1]] }, "boxes": [)" + kBox + "]";
  Scene scene = withParts(boxes);
  EXPECT_EQ(reasonFor(scene, "gravity"), "modelled: the scene sets it; it changes 1 time");
  const World world = assemble(scene, plan(scene));
  EXPECT_EQ(world.gravity, Vec3::Zero());
  ASSERT_EQ(world.gravityChanges.size(), 1U);
  EXPECT_EQ(world.gravityChanges[0].time, 2);
  EXPECT_EQ(world.gravityChanges[0].gravity, Vec3(0, 0, -1));
  scene.settings.method = Method::kListing1;
  EXPECT_EQ(
      inputErrorOf([&] { assemble(scene, plan(scene)); }),
      "scene untitled has gravity that changes, which method listing1 does not model; expected method exact");
}

TEST(Assemble, gravityMayRunStraightFromPointToPoint) {
  const auto with = [](const std::string& linear) {
    return withParts(R"("gravity": { "path": [[0, 0, 0, 0], [2, 0, 0, -1]], "linear": )" + linear +
                     R"( }, "boxes": [)" + kBox + "]");
  };
  Scene scene = with("true");
  EXPECT_EQ(reasonFor(scene, "gravity"), "modelled: the scene sets it; it runs straight through 2 points");
  const World world = assemble(scene, plan(scene));
  EXPECT_EQ(gravityAt(world, 1), Vec3(0, 0, -0.5));
  EXPECT_EQ(world.gravityPath, GravityPath::kLinear);
  EXPECT_EQ(gravityAt(assemble(with("false"), plan(with("false"))), 1), Vec3::Zero());
  scene.settings.method = Method::kListing1;
  EXPECT_EQ(
      inputErrorOf([&] { assemble(scene, plan(scene)); }),
      "scene untitled has gravity that changes, which method listing1 does not model; expected method exact");
}

// The crate is turned by 90° about z, so its x axis lies along the world's y: half sizes (0.25, 0.5, 0.125)
// along the world's axes, mass 2 kg, ω = (3, 7, -2): L = 2/3 (0.5² + 0.125², 0.25² + 0.125², 0.25² + 0.5²) ·
// ω.
TEST(Assemble, angularMomentumFollowsFromAngularVelocity) {
  const Scene scene = parseScene(kEveryKey, "f");
  const World world = assemble(scene, plan(scene));
  const Vec3 expected = 2.0 / 3 * Vec3(0.265625 * 3, 0.078125 * 7, 0.3125 * -2);
  EXPECT_LT((world.bodies[0].initial.angularMomentum - expected).norm(), 1e-15);  // measured 0
}

TEST(Assemble, fixedBoxesAreImmovable) {
  const Scene scene = parseScene(kEveryKey, "f");
  const World world = assemble(scene, plan(scene));
  EXPECT_FALSE(isImmovable(world.bodies[0].mass));
  EXPECT_TRUE(isImmovable(world.bodies[2].mass));
  EXPECT_EQ(world.bodies[2].mass.inverseInertiaBody, Vec3::Zero());
}

TEST(Assemble, leavesOutWhatThePlanLeavesOut) {
  const Scene scene = parseScene(kEveryKey, "f");
  const World world = assemble(scene, plan(scene));
  for (const Wall& wall : world.walls) {
    EXPECT_EQ(wall.material.friction, 0) << wall.name;
  }
  EXPECT_EQ(world.bodies[0].material.friction, 0);
  EXPECT_EQ(world.walls[0].material.restitution, 0.5);

  Plan nothing = plan(scene);
  for (PlanItem& item : nothing.items) {
    item.modelled = false;
  }
  const World empty = assemble(scene, nothing);
  EXPECT_EQ(empty.bodies.size(), 3U);
  EXPECT_EQ(empty.gravity, Vec3::Zero());
  EXPECT_TRUE(empty.walls.empty() && empty.springs.empty() && empty.joints.empty() && !empty.drag);
  EXPECT_EQ(empty.bodies[0].material.restitution, 0);
}

}  // namespace
}  // namespace careen
