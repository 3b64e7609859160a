#include "trajectory/run_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "core/brief.h"
#include "core/error.h"
#include "physics/world/given_inertia.h"
#include "physics/world/run_settings.h"

namespace careen {
namespace {

constexpr double kUnit = 1e-6;       // [1] tolerance of the length of a direction, quaternion or orientation
constexpr double kSamePlace = 1e-6;  // of a box size: between initial position and start of its track
constexpr double kMostSteps = 4096;  // per stepped flight; the methods end one after 64
constexpr double kRounding =
    1e-12;  // of the duration: earlier versions summed the times of a pile in two ways
constexpr double kLeastTilt = 1e-9;  // [rad] between line of sight and the camera's up

[[noreturn]] void fail(const std::string& what) { throw InputError(what); }

void require(bool holds, const char* what, const std::string& owner) {
  if (!holds) {
    fail("has " + owner + " with " + what);
  }
}

bool isPositive(double value) { return std::isfinite(value) && value > 0; }
bool isNotNegative(double value) { return std::isfinite(value) && value >= 0; }
bool isUnit(double length) { return std::abs(length - 1) <= kUnit; }
bool isRotation(const Mat3& matrix) {
  return matrix.allFinite() &&
         (matrix.transpose() * matrix - Mat3::Identity()).cwiseAbs().maxCoeff() <= kUnit &&
         matrix.determinant() > 0;
}
bool isSound(const BodyState& state) {
  return state.pose.position.allFinite() && state.velocity.allFinite() && state.angularMomentum.allFinite() &&
         isRotation(state.pose.worldFromBody);
}
bool isSound(const Driven& driven) {
  return driven.pivot.allFinite() && driven.arm.allFinite() && isRotation(driven.worldFromBody) &&
         driven.velocity.allFinite() && driven.spin.allFinite() && driven.amplitude.allFinite() &&
         driven.swing.allFinite() && isNotNegative(driven.rate) && std::isfinite(driven.phase);
}
bool isWithin(int index, std::size_t size) { return index >= 0 && static_cast<std::size_t>(index) < size; }

// ---- Motions: finite numbers, and a state at any time.

bool isSound(const Flight& flight) {
  return flight.position.allFinite() && flight.velocity.allFinite() && flight.acceleration.allFinite() &&
         flight.jerk.allFinite() && flight.angularMomentum.allFinite() && isUnit(flight.worldFromBody.norm());
}

/// Whether a motion lasting `seconds` is valid in a run with these settings.
struct Soundness {
  const RunSettings& settings;
  double seconds;

  bool operator()(const Rest& rest) const {
    return rest.pose.position.allFinite() && isRotation(rest.pose.worldFromBody);
  }
  bool operator()(const EulerStep& step) const {
    return isSound(step.start) && step.force.allFinite() && step.torque.allFinite();
  }
  bool operator()(const Flight& flight) const { return isSound(flight); }
  bool operator()(const SteppedFlight& stepped) const {
    return stepped.method == settings.method && stepped.dt == settings.dt &&
           seconds <= kMostSteps * stepped.dt && isSound(stepped.start);
  }
  bool operator()(const CrowdStep& step) const { return (*this)(asContactStep(step)); }
  bool operator()(const ContactStep& step) const {
    const auto isFinite = [](const auto& vector) { return vector.allFinite(); };
    return isPositive(step.duration) && std::all_of(step.position.begin(), step.position.end(), isFinite) &&
           std::all_of(step.worldFromBody.begin(), step.worldFromBody.end(), isFinite) &&
           isUnit(step.worldFromBody[0].norm());
  }
  bool operator()(const SampledStep& step) const {
    return isPositive(step.duration) && isSound(step.start) && isSound(step.end);
  }
  bool operator()(const Driven& driven) const { return isSound(driven); }
};

void checkTrack(const Track& track, const std::string& name, const RunSettings& settings) {
  const std::string owner = "a track of body '" + name + "'";
  if (track.segments.empty() || track.segments.front().start != 0) {
    fail("has no motion of body '" + name + "' at the start");
  }
  for (std::size_t k = 0; k < track.segments.size(); ++k) {
    const Segment segment = track.segments[k];
    // The last step may end after the run.
    const double end = k + 1 < track.segments.size() ? track.segments[k + 1].start
                                                     : std::max(segment.start, settings.duration);
    require(end >= segment.start - kRounding * settings.duration && std::isfinite(end),
            "segments out of order", owner);
    require(std::visit(Soundness{.settings = settings, .seconds = end - segment.start}, segment.motion),
            "an invalid motion", owner);
  }
}

template <class Event>
void checkTimes(const Trajectory& run, const std::vector<Event>& events, const std::string& owner) {
  double before = 0;
  for (const Event& event : events) {
    require(event.time >= before && event.time <= run.settings.duration,
            "a time out of order or beyond the run's end", owner);
    before = event.time;
  }
}

void checkImpacts(const Trajectory& run) {
  checkTimes(run, run.impacts, "an impact");
  for (const Impact& impact : run.impacts) {
    const bool known = isWithin(impact.a.value, run.world.bodies.size()) &&
                       (impact.b.isWall() ? impact.b.wall() < run.world.walls.size()
                                          : isWithin(impact.b.body(), run.world.bodies.size()));
    if (!known) {
      fail("names an unknown body or wall");
    }
    require(impact.point.allFinite() && isUnit(impact.normal.norm()) && std::isfinite(impact.approach) &&
                std::isfinite(impact.impulse) && std::isfinite(impact.tangential),
            "invalid numbers", "an impact");
  }
}

void checkJointImpulses(const Trajectory& run) {
  checkTimes(run, run.jointImpulses, "an impulse");
  for (const JointImpulse& impulse : run.jointImpulses) {
    require(isWithin(impulse.joint, run.world.joints.size()), "an unknown joint", "an impulse");
    require(impulse.point.allFinite() && impulse.linear.allFinite() && impulse.angular.allFinite(),
            "invalid numbers", "an impulse");
  }
}

void checkJointEfforts(const Trajectory& run) {
  checkTimes(run, run.jointEfforts, "an effort");
  for (const JointEffort& effort : run.jointEfforts) {
    require(isWithin(effort.joint, run.world.joints.size()), "an unknown joint", "an effort");
    require(std::isfinite(effort.effort), "invalid numbers", "an effort");
  }
}

// ---- World.

void checkMaterial(const Material& material, const std::string& owner) {
  require(isNotNegative(material.restitution) && material.restitution <= 1, "a restitution outside 0 to 1",
          owner);
  require(isNotNegative(material.friction), "a friction that is negative or not finite", owner);
  require(material.surface.velocity.allFinite() && material.surface.spin.allFinite(),
          "a surface whose motion is not finite", owner);
}

void checkCourse(const Course& course, const std::string& owner) {
  double before = 0;
  for (const CoursePart& part : course) {
    require(isSound(part.motion), "a motion of its own that is none", owner);
    require(&part == course.data() ? part.from == 0 : part.from > before && std::isfinite(part.from),
            "parts of its motion out of order", owner);
    before = part.from;
  }
}

void checkBody(const Body& body) {
  const std::string owner = "a body '" + body.name + "'";
  require(std::all_of(body.halfExtents.begin(), body.halfExtents.end(), isPositive),
          "half extents that are not positive numbers", owner);
  if (isImmovable(body.mass)) {
    require(body.mass == immovable(), "a mass though it cannot be moved", owner);
    checkCourse(body.course, owner);
  } else {
    require(isPositive(body.mass.mass), "a mass that is not positive", owner);
    require(body.course.empty(), "a motion of its own though it can be moved", owner);
    MassProperties along = body.mass;
    along.turned = false;
    along.bodyFromPrincipal = Mat3::Identity();
    require(whyNoInertia(body.mass.inertiaBody).empty() &&
                along == massWithInertia(body.mass.mass, body.mass.inertiaBody),
            "an inertia that no body has", owner);
    require(isRotation(body.mass.bodyFromPrincipal) &&
                (body.mass.turned || body.mass.bodyFromPrincipal == Mat3::Identity()),
            "principal axes that are none", owner);
  }
  require((body.boxCenter.cwiseAbs().array() <= body.halfExtents.array()).all(),
          "a centre of mass outside its box", owner);
  require(body.parts.size() <= Body::kMostParts, "too many parts", owner);
  for (const BodyPart& part : body.parts) {
    require(std::all_of(part.halfExtents.begin(), part.halfExtents.end(), isPositive) &&
                part.center.allFinite() && isRotation(part.bodyFromPart) &&
                part.turned == (part.bodyFromPart != Mat3::Identity()),
            "a part that is no box", owner);
  }
  checkMaterial(body.material, owner);
  require(isSound(body.initial), "an invalid initial state", owner);
}

void checkWall(const Vec3& normal, double offset, const std::string& owner) {
  require(isUnit(normal.norm()) && std::isfinite(offset), "an invalid plane", owner);
}

void checkNames(const World& world) {
  std::set<std::string_view> names;
  const auto claim = [&names](const std::string& name) {
    if (!names.insert(name).second) {
      fail("has two bodies or walls of the name '" + name + "'");
    }
  };
  for (const Body& body : world.bodies) {
    claim(body.name);
  }
  for (const Wall& wall : world.walls) {
    claim(wall.name);
  }
}

void checkSpring(const Spring& spring, std::size_t bodies) {
  for (const SpringEnd& end : {spring.from, spring.to}) {
    require(!end.body || isWithin(*end.body, bodies), "an end at an unknown body", "a spring");
    require(end.point.allFinite(), "an end that is not finite", "a spring");
  }
  require(spring.from.body != spring.to.body, "both ends at one body", "a spring");
  require(
      isNotNegative(spring.stiffness) && isNotNegative(spring.damping) && isNotNegative(spring.restLength),
      "invalid numbers", "a spring");
}

void checkJoint(const Joint& joint, std::size_t bodies) {
  const std::string owner = "a joint '" + joint.name + "'";
  for (const JointEnd& end : {joint.from, joint.to}) {
    require(!end.body || isWithin(*end.body, bodies), "an end at an unknown body", owner);
    require(end.point.allFinite() && isRotation(end.axes), "an end that is none", owner);
  }
  require(joint.from.body && joint.from.body != joint.to.body, "both ends at one body", owner);
  require(isNotNegative(joint.length), "a length that is negative or not finite", owner);
  require(joint.lowest < joint.highest, "limits out of order", owner);
  require(isNotNegative(joint.stiffness) && isNotNegative(joint.damping) && std::isfinite(joint.rest),
          "a spring with invalid numbers", owner);
  require(isNotNegative(joint.grip) && std::isfinite(joint.keptRate), "a drive with invalid numbers", owner);
  require(joint.restitution >= 0 && joint.restitution <= 1, "a restitution outside 0 to 1", owner);
  require(joint.until > 0, "an end before it begins", owner);
}

void checkApart(const World& world) {
  std::pair<int, int> before{-1, 0};
  for (const std::pair<int, int>& bodies : world.apart) {
    require(before < bodies && bodies.first < bodies.second && isWithin(bodies.first, world.bodies.size()) &&
                isWithin(bodies.second, world.bodies.size()),
            "bodies that pass through each other out of order", "a world");
    before = bodies;
  }
}

void checkWorld(const World& world) {
  require(world.gravity.allFinite(), "a gravity that is not finite", "a world");
  double before = 0;
  for (const GravityChange& change : world.gravityChanges) {
    require(change.gravity.allFinite(), "a gravity that is not finite", "a world");
    require(change.time > before && std::isfinite(change.time), "changes of gravity out of order", "a world");
    before = change.time;
  }
  require(world.gravityPath == GravityPath::kSteps || !world.gravityChanges.empty(),
          "gravity that slopes to nowhere", "a world");
  checkNames(world);
  for (const Body& body : world.bodies) {
    checkBody(body);
  }
  for (const Wall& wall : world.walls) {
    const std::string owner = "a wall '" + wall.name + "'";
    checkWall(wall.normal, wall.offset, owner);
    checkMaterial(wall.material, owner);
    checkCourse(wall.course, owner);
  }
  for (const Spring& spring : world.springs) {
    checkSpring(spring, world.bodies.size());
  }
  for (const Joint& joint : world.joints) {
    checkJoint(joint, world.bodies.size());
  }
  checkApart(world);
  require(!world.drag || (isNotNegative(world.drag->linear) && isNotNegative(world.drag->angular)),
          "an invalid drag", "a world");
}

// A track starts at its body's initial state, up to the rounding of a motion.
void checkStart(const Trajectory& run, std::size_t body) {
  const Body& moved = run.world.bodies[body];
  const Pose first = run.state(body, 0).pose;
  const Pose& start = moved.initial.pose;
  require((first.position - start.position).norm() <= kSamePlace * moved.halfExtents.norm() &&
              (first.worldFromBody - start.worldFromBody).cwiseAbs().maxCoeff() <= kSamePlace,
          "a track that does not begin at its initial pose", "a body '" + moved.name + "'");
}

// ---- Stage.

void checkSight(const Vec3& eye, const Vec3& target, const Vec3& up, double fovDegrees) {
  const Vec3 sight = target - eye;
  require(eye.allFinite() && target.allFinite() && sight.norm() > 0 && isUnit(up.norm()) &&
              sight.normalized().cross(up).norm() > kLeastTilt,
          "its target at its eye or its up along its view", "a camera");
  require(isPositive(fovDegrees) && fovDegrees < 180, "an angle not between 0 and 180", "a camera");
}

void checkCamera(const Stage& stage, std::size_t bodies) {
  const CameraMove& move = stage.cameraMove;
  const bool moves = move.orbitDegrees != 0 || move.followed || !move.keys.empty();
  require(stage.camera || !moves, "a movement but no position", "a camera");
  if (!stage.camera) {
    return;
  }
  checkSight(stage.camera->eye, stage.camera->target, stage.camera->up, stage.camera->fovDegrees);
  require(std::isfinite(move.orbitDegrees) && (move.orbitDegrees == 0 || move.keys.empty()),
          "an invalid orbit", "a camera");
  require(!move.followed || *move.followed < bodies, "an unknown body to follow", "a camera");
  double before = -1;
  for (const CameraKey& key : move.keys) {
    checkSight(key.eye, key.target, stage.camera->up, key.fovDegrees);
    require(std::isfinite(key.time) && key.time > before, "keys out of order", "a camera");
    before = std::max(key.time, 0.0);
  }
}

void checkTimeMap(const TimeMap& map) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    const TimeKey& key = map.keys[i];
    const bool follows =
        i == 0 ? key.film == 0 : key.film > map.keys[i - 1].film && key.scene >= map.keys[i - 1].scene;
    require(follows && isNotNegative(key.film) && isNotNegative(key.scene), "times out of order", "a film");
  }
}

void checkPicture(const PictureSettings& picture) {
  const auto isSize = [](int size) { return size >= 1 && size <= kLargestFilm; };
  require(isSize(picture.width) && isSize(picture.height), "a size beyond what can be drawn", "a picture");
  require(isNotNegative(picture.shutter.degrees) && picture.shutter.degrees <= kWidestShutter &&
              picture.shutter.samples >= 1 && picture.shutter.samples <= kMostShutterSamples,
          "an invalid shutter", "a picture");
}

void checkParts(const std::vector<DrawnPart>& parts, std::size_t bodies) {
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const TriangleMesh& mesh = parts[k].mesh;
    require(parts[k].body < bodies && (k == 0 || parts[k - 1].body < parts[k].body), "an unknown body",
            "a mesh to be drawn");
    require(std::all_of(mesh.points.begin(), mesh.points.end(),
                        [](const Vec3& point) { return point.allFinite(); }) &&
                std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                            [&](const auto& triangle) {
                              return std::all_of(triangle.begin(), triangle.end(), [&](std::size_t corner) {
                                return corner < mesh.points.size();
                              });
                            }),
            "invalid corners", "a mesh to be drawn");
  }
}

void checkFocus(const Focus& focus, std::size_t bodies) {
  require(isPositive(focus.fStop) && (!focus.distance || isPositive(*focus.distance)) &&
              (!focus.body || *focus.body < bodies) && focus.samples >= 1 &&
              focus.samples <= kMostShutterSamples,
          "an invalid lens or nothing that is sharp", "a focus");
}

void checkScenery(const Scenery& scenery) {
  require(!scenery.towardsLight || isUnit(scenery.towardsLight->norm()), "no direction", "a light");
  require(!scenery.lightDegrees ||
              (isNotNegative(*scenery.lightDegrees) && *scenery.lightDegrees <= kWidestLight),
          "an invalid size", "a light");
  require(!scenery.gloss || (isNotNegative(*scenery.gloss) && *scenery.gloss <= 1), "an invalid gloss",
          "a stage");
  require(std::all_of(scenery.titles.begin(), scenery.titles.end(),
                      [](const Title& title) {
                        return isNotNegative(title.from) && std::isfinite(title.to) && title.to > title.from;
                      }),
          "an invalid time", "a title");
}

void checkStage(const Stage& stage, std::size_t bodies) {
  checkParts(stage.parts, bodies);
  if (stage.colors.size() != bodies) {
    fail("has " + std::to_string(stage.colors.size()) + " colours for " + std::to_string(bodies) + " bodies");
  }
  if (stage.room) {
    require(stage.room->min.allFinite() && stage.room->max.allFinite() &&
                (stage.room->min.array() < stage.room->max.array()).all(),
            "a min that is not below its max", "a room");
  }
  for (const Plane& plane : stage.planes) {
    checkWall(plane.normal, plane.offset, "a wall to be drawn");
    checkCourse(plane.course, "a wall to be drawn");
  }
  checkCamera(stage, bodies);
  checkTimeMap(stage.timeMap);
  checkPicture(stage.picture);
  checkScenery(stage.scenery);
  if (stage.focus) {
    checkFocus(*stage.focus, bodies);
  }
}

}  // namespace

void checkMotions(const Trajectory& run) {
  require(
      isPositive(run.settings.duration) && isPositive(run.settings.dt) && isPositive(run.settings.tolerance),
      "a duration, time step or tolerance that is not positive", "settings");
  if (run.tracks.size() != run.world.bodies.size()) {
    fail("has " + std::to_string(run.tracks.size()) + " tracks for " +
         std::to_string(run.world.bodies.size()) + " bodies");
  }
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    checkTrack(run.tracks[body], run.world.bodies[body].name, run.settings);
  }
  checkImpacts(run);
  checkJointImpulses(run);
  checkJointEfforts(run);
}

void checkRun(const Trajectory& run) {
  checkWorld(run.world);
  checkMotions(run);
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    checkStart(run, body);
  }
  checkStage(run.stage, run.world.bodies.size());
}

}  // namespace careen
