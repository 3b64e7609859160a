#include "physics/world/world.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace careen {

const Wall& nowhere() {
  static const Wall none{.name = "nowhere",
                         .normal = Vec3::UnitZ(),
                         .offset = -std::numeric_limits<double>::infinity(),
                         .material = {}};
  return none;
}

bool hasBelts(const World& world) {
  const auto moves = [](const auto& each) { return each.material.surface.moves(); };
  return std::any_of(world.walls.begin(), world.walls.end(), moves) ||
         std::any_of(world.bodies.begin(), world.bodies.end(), moves);
}

bool hasCourses(const World& world) {
  const auto moves = [](const auto& each) { return !each.course.empty(); };
  return std::any_of(world.walls.begin(), world.walls.end(), moves) ||
         std::any_of(world.bodies.begin(), world.bodies.end(), moves);
}

std::string whatHasCourses(const World& world) {
  const auto moves = [](const auto& each) { return !each.course.empty(); };
  const bool boxes = std::any_of(world.bodies.begin(), world.bodies.end(), moves);
  const bool walls = std::any_of(world.walls.begin(), world.walls.end(), moves);
  return boxes && walls ? "fixed boxes and walls" : walls ? "walls" : "fixed boxes";
}

Kinematics wallMotion(const Wall& wall, double time) {
  return wall.course.empty() ? Kinematics{} : partAt(wall.course, time).at(time);
}

namespace {

// [m/s³] From one moment to the next.
Vec3 slopeOf(const GravityChange& from, const GravityChange& to) {
  return (to.gravity - from.gravity) / (to.time - from.time);
}

}  // namespace

Vec3 gravityAt(const World& world, double time) {
  const auto after = std::find_if(world.gravityChanges.begin(), world.gravityChanges.end(),
                                  [&](const GravityChange& change) { return change.time > time; });
  const GravityChange start{.time = world.gravitySince, .gravity = world.gravity};
  const GravityChange& last = after == world.gravityChanges.begin() ? start : *std::prev(after);
  return world.gravityPath == GravityPath::kSteps || after == world.gravityChanges.end()
             ? last.gravity
             : Vec3(last.gravity + (time - last.time) * slopeOf(last, *after));
}

// Straight from one moment to the next the mean is that of both ends.
Vec3 meanGravity(const World& world, double from, double to) {
  Vec3 gravity = gravityAt(world, from);
  if (world.gravityChanges.empty() || !(to > from)) {
    return gravity;
  }
  if (world.gravityPath == GravityPath::kSteps) {
    Vec3 gained = (to - from) * gravity;
    for (const GravityChange& change : world.gravityChanges) {
      if (change.time > from && change.time < to) {
        gained += (to - change.time) * (change.gravity - gravity);
        gravity = change.gravity;
      }
    }
    return gained / (to - from);
  }
  Vec3 gained = Vec3::Zero();
  double time = from;
  const auto goTo = [&](double next, const Vec3& there) {
    gained += 0.5 * (next - time) * (gravity + there);
    time = next;
    gravity = there;
  };
  for (const GravityChange& change : world.gravityChanges) {
    if (change.time > from && change.time < to) {
      goTo(change.time, change.gravity);
    }
  }
  goTo(to, gravityAt(world, to));
  return gained / (to - from);
}

bool isGravitySloping(const World& world) {
  return world.gravityPath == GravityPath::kLinear && !world.gravityChanges.empty() &&
         world.gravityChanges.front().gravity != world.gravity;
}

Vec3 gravitySlope(const World& world) {
  return isGravitySloping(world)
             ? slopeOf({.time = world.gravitySince, .gravity = world.gravity}, world.gravityChanges.front())
             : Vec3(Vec3::Zero());
}

Vec3 gravityNow(const World& world, double time) {
  return isGravitySloping(world) ? Vec3(world.gravity + (time - world.gravitySince) * gravitySlope(world))
                                 : world.gravity;
}

// Its size is convex where it runs straight.
double gravityScale(const World& world) {
  const double now = world.gravity.norm();
  return isGravitySloping(world) ? std::max(now, world.gravityChanges.front().gravity.norm()) : now;
}

double mostGravity(const World& world) {
  double most = world.gravity.norm();
  for (const GravityChange& change : world.gravityChanges) {
    most = std::max(most, change.gravity.norm());
  }
  return most;
}

bool isJointed(const World& world, int body) {
  return std::any_of(world.joints.begin(), world.joints.end(),
                     [&](const Joint& joint) { return joint.from.body == body || joint.to.body == body; });
}

bool mayStillChange(const World& world, const Joint& joint) {
  const auto isOfJoint = [&](const Motor& motor) {
    return &world.joints[static_cast<std::size_t>(motor.joint)] == &joint;
  };
  return joint.until < Joint::kFree || joint.keptRate != 0 ||
         (world.control &&
          ((world.control->callback && joint.hasCoordinate()) ||
           std::any_of(world.control->motors.begin(), world.control->motors.end(), isOfJoint)));
}

}  // namespace careen
