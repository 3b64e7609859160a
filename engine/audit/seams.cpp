#include "audit/seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "audit/samples.h"
#include "physics/world/forces.h"

namespace careen {
namespace {

constexpr double kSeamUlps = 256 * std::numeric_limits<double>::epsilon();

bool isFinite(const BodyState& state) {
  return state.pose.position.allFinite() && state.pose.worldFromBody.allFinite() &&
         state.velocity.allFinite() && state.angularMomentum.allFinite();
}

// The farthest that a point of the box moves: one of its corners. A thin rod that rolls moves none far.
double jumpOf(const Body& body, const Pose& before, const Pose& after) {
  double farthest = 0;
  for (int k = 0; k < body.cornerCount(); ++k) {
    const Vec3 turned = (after.worldFromBody - before.worldFromBody) * corner(body, k);
    farthest = std::max(farthest, (after.position - before.position + turned).norm());
  }
  return farthest;
}

/// What impacts and joints gave a body.
struct Given {
  Vec3 momentum = Vec3::Zero();
  Vec3 angularMomentum = Vec3::Zero();
  double all = 0;          // [N s] of all impulses
  double couples = 0;      // [N m s] likewise
  double friction = 0;     // [N s] whose direction is not recorded
  double frictionArm = 0;  // [N m s] likewise, about the centre of mass
};

// Those of `own`, by index, after one time and not after the other [s].
template <class Event, class Add>
void forEventsBetween(const std::vector<Event>& events, const std::vector<std::size_t>& own, double from,
                      double to, const Add& add) {
  const auto later = [&](double time, std::size_t k) { return time < events[k].time; };
  for (auto k = std::upper_bound(own.begin(), own.end(), from, later);
       k != own.end() && events[*k].time <= to; ++k) {
    add(events[*k]);
  }
}

Given givenBy(const Trajectory& run, std::size_t body, const Vec3& center, const ImpulsesOfBody& impulses,
              double from, double to) {
  Given given;
  forEventsBetween(run.impacts, impulses.impacts, from, to, [&](const Impact& impact) {
    const double sign = impact.a.value == static_cast<int>(body) ? 1 : -1;
    const Vec3 impulse = sign * impact.impulse * impact.normal;
    const Vec3 arm = impact.point - center;
    given.momentum += impulse;
    given.angularMomentum += arm.cross(impulse);
    given.all += impact.impulse + impact.tangential;
    given.friction += impact.tangential;
    given.frictionArm += impact.tangential * arm.norm();
  });
  forEventsBetween(run.jointImpulses, impulses.joints, from, to, [&](const JointImpulse& passed) {
    const Joint& joint = run.world.joints[static_cast<std::size_t>(passed.joint)];
    const double sign = joint.from.body == static_cast<int>(body) ? 1 : -1;
    given.momentum += sign * passed.linear;
    given.angularMomentum += sign * (passed.angular + Vec3((passed.point - center).cross(passed.linear)));
    given.all += passed.linear.norm();
    given.couples += passed.angular.norm();
  });
  return given;
}

// [s] The time that speeds are derived from.
double lengthOf(const Motion& motion) {
  if (const CrowdStep* const step = std::get_if<CrowdStep>(&motion)) {
    return step->duration;
  }
  const ContactStep* const step = std::get_if<ContactStep>(&motion);
  return step != nullptr ? step->duration : std::numeric_limits<double>::infinity();
}

void checkImpulse(const Trajectory& run, std::size_t body, const Seam& seam, const BodyState& before,
                  const BodyState& after, const ImpulsesOfBody& impulses, double fallingSpeed,
                  Findings& findings) {
  const Body& owner = run.world.bodies[body];
  const Segments& segments = run.tracks[body].segments;
  const double time = segments[seam.after].start;
  const Given given = givenBy(run, body, after.pose.position, impulses, segments[seam.before].start, time);
  const double mass = owner.mass.mass;
  const double size = owner.halfExtents.norm();
  const double still = mass * fallingSpeed;
  const double linearScale =
      mass * std::max(before.velocity.norm(), after.velocity.norm()) + given.all + still;
  const double angularScale = std::max(before.angularMomentum.norm(), after.angularMomentum.norm()) +
                              size * (given.all + still) + given.couples;
  const double linear = (mass * (after.velocity - before.velocity) - given.momentum).norm() - given.friction;
  const double angular =
      (after.angularMomentum - before.angularMomentum - given.angularMomentum).norm() - given.frictionArm;
  // Points and centres are known to their rounding; speeds of contact steps to that of places over their
  // length.
  const double reach = after.pose.position.norm() + size + time * before.velocity.norm();
  const double shortest =
      std::min(lengthOf(segments[seam.before].motion), lengthOf(segments[seam.after].motion));
  const double rounding = kSeamUlps * (1 + reach / size) +
                          (linearScale > 0 ? kSeamUlps * reach / shortest * mass / linearScale : 0.0);
  const double worst =
      std::max(linearScale > 0 ? linear / linearScale : 0.0, angularScale > 0 ? angular / angularScale : 0.0);
  // Resting contacts record no impacts.
  const bool flies = !mayTouch(segments[seam.before].motion) && !mayTouch(segments[seam.after].motion);
  findings.add(AuditKind::kImpulse, rounding,
               {.size = worst, .time = time, .bodies = {body}, .wall = {}, .promised = flies});
}

}  // namespace

std::vector<Seam> seamsOf(const Track& track) {
  std::vector<Seam> seams;
  std::size_t before = 0;
  for (std::size_t k = 1; k < track.segments.size(); ++k) {
    const double start = track.segments[k].start;
    if (k + 1 < track.segments.size() && track.segments[k + 1].start == start) {
      continue;
    }
    if (start > track.segments[before].start) {
      seams.push_back({.before = before, .after = k});
    }
    before = k;
  }
  return seams;
}

std::vector<ImpulsesOfBody> impulsesOfBodies(const Trajectory& run) {
  std::vector<ImpulsesOfBody> bodies(run.tracks.size());
  for (std::size_t k = 0; k < run.impacts.size(); ++k) {
    bodies[static_cast<std::size_t>(run.impacts[k].a.value)].impacts.push_back(k);
    if (!run.impacts[k].b.isWall()) {
      bodies[static_cast<std::size_t>(run.impacts[k].b.body())].impacts.push_back(k);
    }
  }
  for (std::size_t k = 0; k < run.jointImpulses.size(); ++k) {
    const Joint& joint = run.world.joints[static_cast<std::size_t>(run.jointImpulses[k].joint)];
    for (const std::optional<int>& body : {joint.from.body, joint.to.body}) {
      if (body) {
        bodies[static_cast<std::size_t>(*body)].joints.push_back(k);
      }
    }
  }
  return bodies;
}

double placeRounding(const Body& body, const Vec3& position) {
  return kSeamUlps * (position.norm() + body.halfExtents.norm());
}

std::vector<double> fallingSpeeds(const World& world) {
  std::vector<double> speeds = accelerationsAtStart(world);
  const double gravity = world.gravityChanges.empty() ? 0 : mostGravity(world);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double acceleration = isImmovable(world.bodies[i].mass) ? speeds[i] : std::max(speeds[i], gravity);
    speeds[i] = std::sqrt(2 * acceleration * world.bodies[i].halfExtents.norm());
  }
  return speeds;
}

void checkState(const BodyState& state, std::size_t body, double time, Findings& findings) {
  if (!isFinite(state)) {
    findings.add(AuditKind::kNotFinite, 0, {.size = 1, .time = time, .bodies = {body}, .wall = {}});
    return;
  }
  const Mat3& a = state.pose.worldFromBody;
  findings.add(
      AuditKind::kOrthogonality, 0,
      {.size = (a * a.transpose() - Mat3::Identity()).norm(), .time = time, .bodies = {body}, .wall = {}});
}

void checkSeam(const Trajectory& run, std::size_t body, const Seam& seam, const ImpulsesOfBody& impulses,
               double fallingSpeed, Findings& findings) {
  const Body& owner = run.world.bodies[body];
  const Segments& segments = run.tracks[body].segments;
  const double time = segments[seam.after].start;
  const BodyState before =
      stateAt(segments[seam.before].motion, owner.mass, time - segments[seam.before].start);
  const BodyState after = stateAt(segments[seam.after].motion, owner.mass, 0);
  checkState(before, body, time, findings);
  checkState(after, body, time, findings);
  if (!isFinite(before) || !isFinite(after)) {
    return;
  }
  const double rounding = 4 * placeRounding(owner, after.pose.position) +
                          kSeamUlps * time *
                              (before.velocity.norm() + after.velocity.norm() +
                               angularVelocity(owner.mass, before).norm() * owner.halfExtents.norm());
  findings.add(AuditKind::kContinuity, rounding,
               {.size = jumpOf(owner, before.pose, after.pose), .time = time, .bodies = {body}, .wall = {}});
  if (!isImmovable(owner.mass)) {
    checkImpulse(run, body, seam, before, after, impulses, fallingSpeed, findings);
  }
}

void checkSteps(const Trajectory& run, std::size_t body, Findings& findings) {
  if (!run.given || !run.given->velocities) {
    return;
  }
  for (const Segment& segment : run.tracks[body].segments) {
    const SampledStep* const step = std::get_if<SampledStep>(&segment.motion);
    if (step == nullptr) {
      continue;
    }
    const Vec3 way = step->end.pose.position - step->start.pose.position;
    const Vec3 mean = 0.5 * (step->start.velocity + step->end.velocity);
    const Vec3 change = 0.5 * (step->end.velocity - step->start.velocity);
    // Between bounces it falls: below the first velocity and above the second.
    const double fallen = 0.5 * step->duration * step->duration * mostGravity(run.world);
    const double jump = (way - step->duration * mean).norm() - step->duration * change.norm() - fallen;
    findings.add(AuditKind::kContinuity,
                 placeRounding(run.world.bodies[body], step->end.pose.position) +
                     kSeamUlps * step->duration * mean.norm(),
                 {.size = jump, .time = segment.start, .bodies = {body}, .wall = {}});
  }
}

}  // namespace careen
