#include "trajectory/run_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <variant>

#include "core/error.h"
#include "physics/world/method.h"
#include "support/input_error.h"
#include "support/trajectories.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

const double kNoNumber = std::nan("");
const double kInfinity = std::numeric_limits<double>::infinity();

EulerStep& firstStep(Trajectory& run) { return std::get<EulerStep>(run.tracks[0].segments.open()[0].motion); }

template <class Motion>
Motion& instead(Trajectory& run) {
  return run.tracks[0].segments.open()[0].motion.emplace<Motion>();
}

// Sound, but for what is changed.
Joint& addLeash(Trajectory& run) {
  Joint leash{.name = "leash", .kind = Joint::Kind::kRope, .from = {.body = 0}, .to = {.body = 1}};
  leash.length = 9;
  return run.world.joints.emplace_back(leash);
}

/// What makes the run senseless, and what is then said.
struct Fault {
  const char* said;
  std::function<void(Trajectory&)> make;
};

const std::vector<Fault> kFaults = {
    // The world.
    {"has a world with a gravity that is not finite",
     [](Trajectory& run) { run.world.gravity.z() = kNoNumber; }},
    {"has a world with changes of gravity out of order",
     [](Trajectory& run) {
       run.world.gravityChanges = {{.time = 0.5}, {.time = 0.5}};
     }},
    {"has a world with gravity that slopes to nowhere",
     [](Trajectory& run) { run.world.gravityPath = GravityPath::kLinear; }},
    {"has a world with a gravity that is not finite",
     [](Trajectory& run) { run.world.gravityChanges = {{.time = 0.5, .gravity = Vec3(0, kNoNumber, 0)}}; }},
    {"has a wall 'room+x' with a surface whose motion is not finite",
     [](Trajectory& run) { run.world.walls[1].material.surface.spin.y() = kInfinity; }},
    {"has two bodies or walls of the name 'anchor'",
     [](Trajectory& run) { run.world.bodies[0].name = "anchor"; }},
    {"has two bodies or walls of the name 'drifter'",
     [](Trajectory& run) { run.world.walls[1].name = "drifter"; }},
    {"has a body 'drifter' with half extents that are not positive numbers",
     [](Trajectory& run) { run.world.bodies[0].halfExtents.y() = 0; }},
    {"has a body 'anchor' with half extents that are not positive numbers",
     [](Trajectory& run) { run.world.bodies[1].halfExtents.y() = kInfinity; }},
    {"has a body 'drifter' with a mass that is not positive",
     [](Trajectory& run) { run.world.bodies[0].mass.mass = -1; }},
    {"has a body 'drifter' with an inertia that no body has",
     [](Trajectory& run) { run.world.bodies[0].mass.inertiaBody.x() *= 3; }},
    {"has a body 'drifter' with an inertia that no body has",
     [](Trajectory& run) { run.world.bodies[0].mass.inverseInertiaBody.x() *= 1.0000001; }},
    {"has a body 'drifter' with an inertia that no body has",
     [](Trajectory& run) { run.world.bodies[0].mass.mass = 3; }},
    {"has a body 'drifter' with principal axes that are none",
     [](Trajectory& run) { run.world.bodies[0].mass.bodyFromPrincipal(0, 0) = 1.1; }},
    {"has a body 'drifter' with principal axes that are none",
     [](Trajectory& run) {
       run.world.bodies[0].mass.bodyFromPrincipal =
           Vec3(-1, -1, 1).asDiagonal();  // and not said to be turned
     }},
    {"has a body 'drifter' with a centre of mass outside its box",
     [](Trajectory& run) { run.world.bodies[0].boxCenter.z() = 99; }},
    {"has a body 'anchor' with a mass though it cannot be moved",
     [](Trajectory& run) { run.world.bodies[1].mass.mass = 1; }},
    {"has a body 'drifter' with a restitution outside 0 to 1",
     [](Trajectory& run) { run.world.bodies[0].material.restitution = 1.5; }},
    {"has a body 'drifter' with an invalid initial state",
     [](Trajectory& run) { run.world.bodies[0].initial.pose.worldFromBody *= 2; }},
    {"has a wall 'room+x' with a friction that is negative or not finite",
     [](Trajectory& run) { run.world.walls[1].material.friction = kNoNumber; }},
    {"has a wall 'room-x' with an invalid plane",
     [](Trajectory& run) { run.world.walls[0].normal = Vec3(1, 1, 0); }},
    {"has a spring with an end at an unknown body",
     [](Trajectory& run) { run.world.springs.push_back({.from = {.body = 2}, .to = {}}); }},
    {"has a spring with both ends at one body",
     [](Trajectory& run) { run.world.springs.push_back({.from = {.body = 1}, .to = {.body = 1}}); }},
    {"has a spring with invalid numbers",
     [](Trajectory& run) {
       run.world.springs.push_back({.from = {.body = 1}, .to = {.body = 0}, .stiffness = kInfinity});
     }},
    {"has a world with an invalid drag",
     [](Trajectory& run) { run.world.drag = Drag{.linear = -1, .angular = 0}; }},
    // The motions.
    {"has settings with a duration, time step or tolerance that is not positive",
     [](Trajectory& run) { run.settings.duration = kInfinity; }},
    {"has settings with a duration, time step or tolerance that is not positive",
     [](Trajectory& run) { run.settings.dt = 0; }},
    {"has 1 tracks for 2 bodies", [](Trajectory& run) { run.tracks.pop_back(); }},
    {"has no motion of body 'anchor' at the start",
     [](Trajectory& run) { run.tracks[1].segments.open().clear(); }},
    {"has no motion of body 'drifter' at the start",
     [](Trajectory& run) { run.tracks[0].segments.open()[0].start = 0.1; }},
    {"has a track of body 'drifter' with segments out of order",
     [](Trajectory& run) { run.tracks[0].segments.open()[1].start = -0.5; }},
    {"has a track of body 'drifter' with segments out of order",
     [](Trajectory& run) { run.tracks[0].segments.open()[1].start = kInfinity; }},
    {"has a track of body 'drifter' with segments out of order",
     [](Trajectory& run) { run.tracks[0].segments.open()[1].start = kNoNumber; }},
    {"has a track of body 'drifter' with an invalid motion",
     [](Trajectory& run) { firstStep(run).force.x() = kNoNumber; }},
    {"has a track of body 'drifter' with an invalid motion",
     [](Trajectory& run) { firstStep(run).start.pose.worldFromBody(0, 0) = 1.1; }},
    {"has a track of body 'drifter' with an invalid motion",
     [](Trajectory& run) { firstStep(run).start.pose.worldFromBody = -Mat3::Identity(); }},
    {"has a track of body 'anchor' with an invalid motion",
     [](Trajectory& run) {
       std::get<Rest>(run.tracks[1].segments.open()[0].motion).pose.position.x() = kInfinity;
     }},
    {"has a track of body 'drifter' with an invalid motion",
     [](Trajectory& run) { instead<Flight>(run).worldFromBody.w() = 2; }},
    {"has a track of body 'drifter' with an invalid motion",  // its duration is 0
     [](Trajectory& run) { instead<ContactStep>(run).worldFromBody[0].w() = 1; }},
    {"has a track of body 'drifter' with an invalid motion",  // by another method than the run
     [](Trajectory& run) {
       instead<SteppedFlight>(run) = {.method = Method::kStrang, .dt = 0.5, .start = {}};
     }},
    {"has a track of body 'drifter' with an invalid motion",  // steps that nobody would wait for
     [](Trajectory& run) {
       run.settings.method = Method::kStrang;
       run.settings.dt = 1e-9;
       instead<SteppedFlight>(run) = {.method = Method::kStrang, .dt = 1e-9, .start = {}};
     }},
    {"has a body 'drifter' with a track that does not begin at its initial pose",
     [](Trajectory& run) { run.world.bodies[0].initial.pose.position.x() += 0.01; }},
    // The impacts.
    {"names an unknown body or wall", [](Trajectory& run) { run.impacts[0].b = Partner::ofWall(2); }},
    {"names an unknown body or wall", [](Trajectory& run) { run.impacts[0].b = Partner::ofBody(7); }},
    {"has an impact with a time out of order or beyond the run's end",
     [](Trajectory& run) { run.impacts[0].time = 1.01; }},
    {"has an impact with a time out of order or beyond the run's end",
     [](Trajectory& run) {
       run.impacts.push_back(run.impacts[0]);
       run.impacts[1].time = 0.25;
     }},
    {"has an impact with invalid numbers", [](Trajectory& run) { run.impacts[0].impulse = kNoNumber; }},
    // The stage.
    {"has 3 colours for 2 bodies", [](Trajectory& run) { run.stage.colors.emplace_back(); }},
    {"has a room with a min that is not below its max", [](Trajectory& run) { run.stage.room.emplace(); }},
    {"has a wall to be drawn with an invalid plane",
     [](Trajectory& run) { run.stage.planes.push_back({.normal = Vec3::UnitX(), .offset = kNoNumber}); }},
    {"has a camera with a movement but no position",
     [](Trajectory& run) { run.stage.cameraMove.orbitDegrees = 1; }},
    {"has a camera with its target at its eye or its up along its view",
     [](Trajectory& run) { run.stage.camera.emplace(); }},
    {"has a camera with its target at its eye or its up along its view",
     [](Trajectory& run) { run.stage.camera = Camera{.eye = Vec3::UnitZ()}; }},
    {"has a camera with an angle not between 0 and 180",
     [](Trajectory& run) { run.stage.camera = Camera{.eye = Vec3::UnitX(), .fovDegrees = 180}; }},
    {"has a camera with an unknown body to follow",
     [](Trajectory& run) {
       run.stage.camera = Camera{.eye = Vec3::UnitX()};
       run.stage.cameraMove.followed = 2;
     }},
    {"has a joint 'leash' with both ends at one body",
     [](Trajectory& run) { addLeash(run).from.body.reset(); }},
    {"has a joint 'leash' with both ends at one body", [](Trajectory& run) { addLeash(run).to.body = 0; }},
    {"has a joint 'leash' with an end at an unknown body",
     [](Trajectory& run) { addLeash(run).to.body = 2; }},
    {"has a joint 'leash' with an end that is none",
     [](Trajectory& run) { addLeash(run).to.point.x() = kNoNumber; }},
    {"has a joint 'leash' with an end that is none",
     [](Trajectory& run) { addLeash(run).from.axes(0, 0) = 2; }},
    {"has a joint 'leash' with a length that is negative or not finite",
     [](Trajectory& run) { addLeash(run).length = -1; }},
    {"has a joint 'leash' with limits out of order",
     [](Trajectory& run) {
       Joint& leash = addLeash(run);
       leash.lowest = 0.1;
       leash.highest = 0.1;
     }},
    {"has a joint 'leash' with a spring with invalid numbers",
     [](Trajectory& run) { addLeash(run).damping = -1; }},
    {"has an effort with an unknown joint", [](Trajectory& run) { run.jointEfforts.emplace_back(); }},
    {"has an effort with a time out of order or beyond the run's end",
     [](Trajectory& run) {
       addLeash(run);
       run.jointEfforts = {{.time = 1.5}};
     }},
    {"has an effort with invalid numbers",
     [](Trajectory& run) {
       addLeash(run);
       run.jointEfforts = {{.effort = kNoNumber}};
     }},
    {"has a joint 'leash' with a restitution outside 0 to 1",
     [](Trajectory& run) { addLeash(run).restitution = kNoNumber; }},
    {"has a joint 'leash' with an end before it begins", [](Trajectory& run) { addLeash(run).until = 0; }},
    {"has a world with bodies that pass through each other out of order",
     [](Trajectory& run) {
       run.world.apart = {{1, 0}};
     }},
    {"has a world with bodies that pass through each other out of order",
     [](Trajectory& run) {
       run.world.apart = {{0, 1}, {0, 1}};
     }},
    {"has a world with bodies that pass through each other out of order",
     [](Trajectory& run) {
       run.world.apart = {{0, 2}};
     }},
    {"has an impulse with an unknown joint", [](Trajectory& run) { run.jointImpulses.emplace_back(); }},
    {"has an impulse with a time out of order or beyond the run's end",
     [](Trajectory& run) {
       addLeash(run);
       run.jointImpulses = {{.time = 0.5}, {.time = 0.25}};
     }},
    {"has an impulse with invalid numbers",
     [](Trajectory& run) {
       addLeash(run);
       run.jointImpulses = {{.angular = {0, kInfinity, 0}}};
     }},
    {"has a camera with keys out of order",
     [](Trajectory& run) {
       run.stage.camera = Camera{.eye = Vec3::UnitX()};
       run.stage.cameraMove.keys = {{.time = 1, .eye = Vec3::UnitX()}, {.time = 1, .eye = Vec3::UnitY()}};
     }},
    {"has a film with times out of order",
     [](Trajectory& run) {
       run.stage.timeMap.keys = {{.film = 0, .scene = 0.5}, {.film = 1, .scene = 0.4}};
     }},
    {"has a picture with a size beyond what can be drawn",
     [](Trajectory& run) { run.stage.picture.width = kLargestFilm + 1; }},
    {"has a picture with a size beyond what can be drawn",
     [](Trajectory& run) { run.stage.picture.height = 0; }},
    {"has a picture with an invalid shutter", [](Trajectory& run) { run.stage.picture.shutter.samples = 0; }},
};

TEST(RunCheck, acceptsWhatMakesSense) {
  Trajectory run = driftAndReturn();
  EXPECT_NO_THROW(checkRun(run));
  addLeash(run);
  run.world.apart = {{0, 1}};
  run.jointImpulses = {{.time = 0.25}, {.time = 0.25}, {.time = 1}};
  EXPECT_NO_THROW(checkRun(run));
}

TEST(RunCheck, saysWhatMakesNoSense) {
  for (const Fault& fault : kFaults) {
    Trajectory run = driftAndReturn();
    fault.make(run);
    EXPECT_EQ(inputErrorOf([&run] { checkRun(run); }), fault.said);
  }
}

// Nothing can be made of a file of theirs: each is refused with the same words.
TEST(RunCheck, isMadeOfEveryFileThatIsRead) {
  for (const Fault& fault : kFaults) {
    Trajectory run = driftAndReturn();
    fault.make(run);
    std::string bytes;
    try {
      bytes = encodeTrajectory(run);
    } catch (const std::exception&) {
      continue;  // its last state, whose hash is in the file, cannot even be found
    }
    EXPECT_EQ(inputErrorOf([&bytes] { decodeTrajectory(bytes, "run.careen"); }),
              "run.careen: this trajectory file " + std::string(fault.said));
  }
}

}  // namespace
}  // namespace careen
