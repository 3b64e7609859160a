#include "audit/external.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "audit/overlap.h"
#include "physics/world/forces.h"

namespace careen {
namespace {

// Gauss–Legendre on [0, 1], with two nodes exact for polynomials of degree 3, with three of degree 5. Steps
// are short; a place in flight has degree 2, where gravity slopes its torque 4.
struct Node {
  double at = 0;
  double weight = 0;
};
constexpr double kRootOfThird = 0.57735026918962576451;
constexpr double kRootOfThreeFifths = 0.77459666924148337704;
constexpr std::array<Node, 2> kTwoNodes = {{{(1 - kRootOfThird) / 2, 0.5}, {(1 + kRootOfThird) / 2, 0.5}}};
constexpr std::array<Node, 3> kThreeNodes = {
    {{(1 - kRootOfThreeFifths) / 2, 5.0 / 18}, {0.5, 8.0 / 18}, {(1 + kRootOfThreeFifths) / 2, 5.0 / 18}}};

bool isMovable(const World& world, const std::optional<int>& body) {
  return body && !isImmovable(world.bodies[static_cast<std::size_t>(*body)].mass);
}

bool turns(const Course& course) {
  return std::any_of(course.begin(), course.end(), [](const CoursePart& part) {
    return !part.motion.spin.isZero(0) || !part.motion.swing.isZero(0);
  });
}

}  // namespace

ExternalOf::ExternalOf(const Trajectory& run, const ExchangeGroup& group, Vec3 origin)
    : run_(run), group_(group), origin_(std::move(origin)), followers_(group.bodies.size()) {
  for (std::size_t body = 0; body < run.world.bodies.size(); ++body) {
    if (isImmovable(run.world.bodies[body].mass)) {
      immovables_.push_back(body);
    }
  }
  if (!group.springs.empty()) {
    states_.resize(run.world.bodies.size());
    for (const std::size_t fixed : immovables_) {
      states_[fixed] = {.pose = run.world.bodies[fixed].initial.pose};
    }
  }
  integrates_ = run.world.drag.has_value() ||
                std::any_of(group.springs.begin(), group.springs.end(), [&](std::size_t spring) {
                  return !isMovable(run.world, run.world.springs[spring].from.body) ||
                         !isMovable(run.world, run.world.springs[spring].to.body);
                });
}

External ExternalOf::until(double time) {
  External external;
  for (std::size_t member = 0; member < group_.bodies.size(); ++member) {
    follow(member, time, external);
  }
  addImpacts(time, external);
  external.isHeld = isHeldByJoint();
  time_ = time;
  return external;
}

// From the last moment on, or for a while since.
bool ExternalOf::isHeldByJoint() const {
  return std::any_of(group_.joints.begin(), group_.joints.end(), [&](std::size_t index) {
    const Joint& joint = run_.world.joints[index];
    return joint.until >= time_ &&
           !(isMovable(run_.world, joint.from.body) && isMovable(run_.world, joint.to.body));
  });
}

void ExternalOf::follow(std::size_t member, double time, External& external) {
  const std::size_t body = group_.bodies[member];
  const Segments& segments = run_.tracks[body].segments;
  std::size_t& k = followers_[member].segment;
  double from = time_;
  while (true) {
    const bool isLast = k + 1 >= segments.size() || segments[k + 1].start > time;
    const double to = isLast ? time : std::max(from, segments[k + 1].start);
    if (mayTouch(segments[k].motion)) {
      addTouches(member, k, external);
    }
    if (to > from) {
      addLoads(body, segments[k], from, to, external);
    }
    from = to;
    if (isLast) {
      return;
    }
    ++k;
  }
}

// Gravity, drag, and springs with one end on this body and the other on the world or an immovable body:
// springs between bodies of the group give it nothing.
void ExternalOf::addLoads(std::size_t body, const Segment& segment, double from, double to,
                          External& external) {
  const World& world = run_.world;
  const MassProperties& mass = world.bodies[body].mass;
  const bool slopes = world.gravityPath == GravityPath::kLinear;
  const Vec3 gravity = meanGravity(world, from, to);
  const double length = to - from;
  external.impulse += length * (mass.mass * gravity);
  if (gravity.isZero(0) && !integrates_ && !slopes) {
    return;
  }
  const Vec3 growth = slopes ? Vec3(gravityAt(world, to) - gravityAt(world, from)) : Vec3(Vec3::Zero());
  for (const auto& [node, share] : slopes ? std::span<const Node>(kThreeNodes) : kTwoNodes) {
    const double elapsed = from + node * length - segment.start;
    const double seconds = share * length;
    const Vec3 weight = mass.mass * (gravity + (node - 0.5) * growth);
    if (slopes) {
      external.rise -= share * mass.mass * dot(growth, centerAt(segment.motion, elapsed) - origin_);
    }
    if (!integrates_) {
      external.angularImpulse += seconds * (centerAt(segment.motion, elapsed) - origin_).cross(weight);
      continue;
    }
    const BodyState state = stateAt(segment.motion, mass, elapsed);
    const Vec3 arm = state.pose.position - origin_;
    Load load{.force = Vec3::Zero(), .torque = Vec3::Zero()};
    if (world.drag) {
      load = dragLoad(*world.drag, state.velocity, angularVelocity(mass, state));
      external.impulse += seconds * load.force;
    }
    external.angularImpulse += seconds * (arm.cross(load.force + weight) + load.torque);
    for (const std::size_t index : group_.springs) {
      const Spring& spring = world.springs[index];
      const bool isFrom = spring.from.body && static_cast<std::size_t>(*spring.from.body) == body;
      const bool isTo = spring.to.body && static_cast<std::size_t>(*spring.to.body) == body;
      if (isFrom == isTo || isMovable(world, isFrom ? spring.to.body : spring.from.body)) {
        continue;
      }
      states_[body] = state;
      const Stretch stretch = stretchOf(spring, world, states_);
      const Vec3 force = (isFrom ? 1 : -1) * springForce(spring, stretch) * stretch.direction;
      external.impulse += seconds * force;
      external.angularImpulse += seconds * ((isFrom ? stretch.from : stretch.to) - origin_).cross(force);
    }
  }
}

void ExternalOf::addTouches(std::size_t member, std::size_t segment, External& external) {
  Follower& follower = followers_[member];
  const std::size_t body = group_.bodies[member];
  if (follower.known != segment + 1) {
    follower.touches = touchesOf(body, segment);
    follower.known = segment + 1;
  }
  Touches& touches = follower.touches;
  external.lies = external.lies || !touches.immovables.empty() || !touches.walls.empty();
  if (!external.lies) {  // the others are looked at last: they may be many
    touches.other = touches.other ? touches.other : touchesOther(body, segment);
    external.lies = *touches.other;
  }
  external.liesOnImmovable = external.liesOnImmovable || !touches.immovables.empty();
  for (const std::size_t fixed : touches.immovables) {
    addFixed(fixed, time_, external);
  }
  for (const std::size_t wall : touches.walls) {
    const Wall& touched = run_.world.walls[wall];
    addSurface(touched, time_, external);
    if (turns(touched.course)) {  // any way
      external.liesOnImmovable = true;
    } else {
      addWall(wall, touching(run_.world.bodies[body].material, touched.material).friction, external);
    }
  }
}

// Or what does not move, beside it.
void ExternalOf::addBelt(const SurfaceMotion& surface, Of of, External& external) {
  const Vec3 before = external.belt.value_or(surface.velocity);
  external.hasUnknownBelts = external.hasUnknownBelts || !surface.spin.isZero(0) ||
                             before != surface.velocity || (of == Of::kBox && surface.moves());
  external.belt = surface.velocity;
}

// As it moves from that moment on.
void ExternalOf::addFixed(std::size_t fixed, double time, External& external) const {
  const Body& body = run_.world.bodies[fixed];
  if (body.course.empty()) {
    addBelt(body.material.surface, Of::kBox, external);
  } else {
    addCourse(body.course, time, external);
  }
}

void ExternalOf::addSurface(const Wall& wall, double time, External& external) {
  if (wall.course.empty()) {
    addBelt(wall.material.surface, Of::kWall, external);
  } else {
    addCourse(wall.course, time, external);
  }
}

void ExternalOf::addCourse(const Course& course, double time, External& external) {
  const Driven& motion = partAt(course, time).motion;
  addBelt({.velocity = motion.velocity}, Of::kWall, external);
  external.hasUnknownBelts = external.hasUnknownBelts || !motion.spin.isZero(0) || motion.swings();
}

void ExternalOf::addWall(std::size_t wall, double friction, External& external) const {
  const Vec3& normal = run_.world.walls[wall].normal;
  const auto known = std::find_if(external.walls.begin(), external.walls.end(),
                                  [&](const WallForce& force) { return force.normal == normal; });
  if (known == external.walls.end()) {
    external.walls.push_back({.normal = normal, .friction = friction});
  } else {
    known->friction = std::max(known->friction, friction);
  }
}

// [m] Several steps of a crowd are recorded as one, which does not tell what they touched, and nor do the
// rows of a table: the farthest that a body moves in this one or one beside it.
double ExternalOf::wayWithin(std::size_t body, std::size_t segment) const {
  const Segments& segments = run_.tracks[body].segments;
  const Body& owner = run_.world.bodies[body];
  const double size = radiusOf(owner);
  double way = 0;
  // Velocities that were estimated from rows beside an impact may be off two rows further.
  const std::size_t beside = run_.given && !run_.given->velocities ? 3 : 1;
  for (std::size_t k = segment - std::min(segment, beside);
       k < std::min(segment + beside + 1, segments.size()); ++k) {
    const Motion motion = segments[k].motion;
    if (const CrowdStep* const step = std::get_if<CrowdStep>(&motion)) {
      const StepBounds bounds = boundsOf(asContactStep(*step));
      way = std::max(way, step->duration * (bounds.speed + bounds.angularSpeed * size));
    } else if (const SampledStep* const row = std::get_if<SampledStep>(&motion)) {
      for (const BodyState& state : {row->start, row->end}) {
        way = std::max(
            way, row->duration * (state.velocity.norm() + size * angularVelocity(owner.mass, state).norm()));
      }
    }
  }
  return way;
}

bool ExternalOf::meets(const Body& owner, const Pose& place, double near, std::size_t other,
                       double time) const {
  const Body& body = run_.world.bodies[other];
  const Track& track = run_.tracks[other];
  const std::size_t segment = segmentAt(track, time);
  const BodyState there =
      stateAt(track.segments[segment].motion, body.mass, time - track.segments[segment].start);
  const double apart = near + touchingDistance(body, run_.settings) + wayWithin(other, segment);
  return (place.position - there.pose.position).norm() <= radiusOf(owner) + radiusOf(body) + apart &&
         separationOf(owner, place, body, there.pose) <= apart;
}

Pose ExternalOf::placeOf(std::size_t body, std::size_t segment, double elapsed) const {
  return stateAt(run_.tracks[body].segments[segment].motion, run_.world.bodies[body].mass, elapsed).pose;
}

// [s] A step may have been cut: where its polynomial ends the body never was.
double ExternalOf::lengthOf(std::size_t body, std::size_t segment) const {
  const Segments& segments = run_.tracks[body].segments;
  return (segment + 1 < segments.size() ? segments[segment + 1].start : run_.settings.duration) -
         segments[segment].start;
}

ExternalOf::Touches ExternalOf::touchesOf(std::size_t body, std::size_t segment) const {
  const Body& owner = run_.world.bodies[body];
  const double near = touchingDistance(owner, run_.settings) + wayWithin(body, segment);
  Touches touches;
  for (const double elapsed : {0.0, lengthOf(body, segment)}) {
    const Pose place = placeOf(body, segment, elapsed);
    const double time = run_.tracks[body].segments[segment].start + elapsed;
    for (std::size_t wall = 0; wall < run_.world.walls.size(); ++wall) {
      if (separationOf(owner, place, planeAt(run_.world.walls[wall], time)) <= near) {
        touches.walls.push_back(wall);
      }
    }
    for (const std::size_t fixed : immovables_) {
      const Body& other = run_.world.bodies[fixed];
      const double reach = radiusOf(owner) + radiusOf(other) + near;
      const Pose where = other.course.empty() ? other.initial.pose : partAt(other.course, time).at(time).pose;
      if (mayTouch(run_.world, static_cast<int>(body), static_cast<int>(fixed)) &&
          (place.position - where.position).norm() <= reach &&
          separationOf(owner, place, other, where) <= near) {
        touches.immovables.push_back(fixed);
      }
    }
  }
  return touches;
}

bool ExternalOf::touchesOther(std::size_t body, std::size_t segment) const {
  if (group_.springs.empty() && group_.joints.empty()) {
    return true;  // nothing else takes such steps but what touches
  }
  const Body& owner = run_.world.bodies[body];
  const double near = touchingDistance(owner, run_.settings) + wayWithin(body, segment);
  const double start = run_.tracks[body].segments[segment].start;
  for (const double elapsed : {0.0, lengthOf(body, segment)}) {
    const Pose place = placeOf(body, segment, elapsed);
    if (std::any_of(group_.bodies.begin(), group_.bodies.end(), [&](std::size_t other) {
          return other != body && mayTouch(run_.world, static_cast<int>(body), static_cast<int>(other)) &&
                 meets(owner, place, near, other, start + elapsed);
        })) {
      return true;
    }
  }
  return false;
}

void ExternalOf::addImpacts(double time, External& external) {
  const World& world = run_.world;
  for (; nextImpact_ < group_.impacts.size() && run_.impacts[group_.impacts[nextImpact_]].time <= time;
       ++nextImpact_) {
    const Impact& impact = run_.impacts[group_.impacts[nextImpact_]];
    const auto a = static_cast<std::size_t>(impact.a.value);
    const Material& other = impact.b.isWall()
                                ? world.walls[impact.b.wall()].material
                                : world.bodies[static_cast<std::size_t>(impact.b.body())].material;
    const Material pair = touching(world.bodies[a].material, other);
    if (isImmovable(world.bodies[a].mass)) {
      addFixed(a, impact.time, external);
    }
    if (impact.b.isWall()) {
      addSurface(world.walls[impact.b.wall()], impact.time, external);
    } else if (const auto b = static_cast<std::size_t>(impact.b.body()); isImmovable(world.bodies[b].mass)) {
      addFixed(b, impact.time, external);
    }
    external.losesInImpacts = external.losesInImpacts || pair.restitution < 1 || pair.friction > 0;
    const bool isA = group_.holds(a);
    const bool isB = !impact.b.isWall() && group_.holds(static_cast<std::size_t>(impact.b.body()));
    if (isA != isB) {
      external.isStruck = true;
      const Vec3 impulse = (isA ? 1 : -1) * impact.impulse * impact.normal;
      const Vec3 arm = impact.point - origin_;
      external.impulse += impulse;
      external.work += impulse.dot(external.belt.value_or(Vec3::Zero()));
      external.angularImpulse += arm.cross(impulse);
      external.friction += impact.tangential;
      external.angularFriction += impact.tangential * arm.norm();
    }
  }
}

}  // namespace careen
