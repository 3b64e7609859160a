#include "trajectory/impact_moment.h"

#include <algorithm>
#include <variant>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "physics/world/kinematics.h"
#include "physics/world/method.h"

namespace careen {
namespace {

// The state in which it comes to that moment; at the start that of the scene.
BodyState stateBefore(const Trajectory& run, std::size_t body, double time) {
  const Segments& segments = run.tracks[body].segments;
  std::size_t k = segments.countUntil(time);
  while (k > 0 && segments[k - 1].start >= time) {
    --k;
  }
  const Body& moved = run.world.bodies[body];
  if (k == 0) {
    return moved.initial;
  }
  const Segment last = segments[k - 1];
  return stateAt(last.motion, moved.mass, time - last.start);
}

template <class Event>
std::vector<std::size_t> eventsAt(const std::vector<Event>& events, double time) {
  const auto isBefore = [](const Event& event, double moment) { return event.time < moment; };
  std::vector<std::size_t> found;
  for (auto k = std::lower_bound(events.begin(), events.end(), time, isBefore);
       k != events.end() && k->time == time; ++k) {
    found.push_back(static_cast<std::size_t>(k - events.begin()));
  }
  return found;
}

// Which bodies that can move an impact concerns, by way of others.
class Concerned {
 public:
  explicit Concerned(const World& world) : world_(world), sets_(world.bodies.size()) {}

  void join(const std::vector<int>& named) {
    const std::vector<std::size_t> moving = movingOf(named);
    for (const std::size_t body : moving) {
      sets_.join(moving.front(), body);
    }
  }
  bool isOne(const std::vector<int>& named, const std::vector<int>& with) {
    const std::vector<std::size_t> a = movingOf(named);
    const std::vector<std::size_t> b = movingOf(with);
    return !a.empty() && !b.empty() && sets_.root(a.front()) == sets_.root(b.front());
  }

 private:
  std::vector<std::size_t> movingOf(const std::vector<int>& named) const {
    std::vector<std::size_t> moving;
    for (const int body : named) {
      if (!isImmovable(world_.bodies[static_cast<std::size_t>(body)].mass)) {
        moving.push_back(static_cast<std::size_t>(body));
      }
    }
    return moving;
  }
  const World& world_;
  DisjointSets sets_;
};

template <class Event>
std::vector<int> namedBy(const Event& event) {
  std::vector<int> named;
  addNamed(event, named);
  return named;
}

ImpactLaw lawOf(const Trajectory& run, const ImpactMoment& moment) {
  if (run.settings.method != Method::kExact) {
    return run.settings.method == Method::kListing1 ? ImpactLaw::kLoop1997 : ImpactLaw::kStepped;
  }
  ImpactLaw law = moment.impacts.size() + moment.joints.size() == 1 ? ImpactLaw::kOneContact
                                                                    : ImpactLaw::kSeveralContacts;
  for (const StruckBody& struck : moment.bodies) {
    const Segments& segments = run.tracks[struck.body].segments;
    const std::size_t begun = segments.countUntil(moment.time);
    for (std::size_t k = begun - std::min<std::size_t>(begun, 2); k < begun; ++k) {
      const Segment segment = segments[k];
      if (std::holds_alternative<CrowdStep>(segment.motion)) {
        return ImpactLaw::kInCrowd;
      }
      if (k + 1 < begun && std::holds_alternative<ContactStep>(segment.motion)) {
        law = ImpactLaw::kInSteps;
      }
    }
  }
  return law;
}

}  // namespace

void addNamed(const Impact& impact, std::vector<int>& named) {
  named.push_back(impact.a.value);
  if (!impact.b.isWall()) {
    named.push_back(impact.b.body());
  }
}

void addNamed(const Joint& joint, std::vector<int>& named) {
  for (const JointEnd* const end : {&joint.from, &joint.to}) {
    if (end->body) {
      named.push_back(*end->body);
    }
  }
}

std::vector<StruckBody> struckBodies(const Trajectory& run, std::vector<int> named, double time) {
  std::sort(named.begin(), named.end());
  named.erase(std::unique(named.begin(), named.end()), named.end());
  std::vector<StruckBody> struck;
  for (const int index : named) {
    const auto body = static_cast<std::size_t>(index);
    if (!isImmovable(run.world.bodies[body].mass)) {
      struck.push_back(
          {.body = body, .before = stateBefore(run, body, time), .after = run.state(body, time)});
    }
  }
  return struck;
}

ImpactMoment impactMoment(const Trajectory& run, int index) {
  const auto asIndex = static_cast<std::size_t>(index);
  if (index < 0 || asIndex >= run.impacts.size()) {
    const std::size_t count = run.impacts.size();
    throw InputError("found impact " + std::to_string(index) + ", expected " +
                     (count == 0 ? "none: the run has no impacts"
                                 : "0 to " + std::to_string(count - 1) + ": the run has " +
                                       std::to_string(count) + (count == 1 ? " impact" : " impacts")));
  }
  ImpactMoment moment;
  moment.time = run.impacts[asIndex].time;
  Concerned concerned(run.world);
  const std::vector<std::size_t> impacts = eventsAt(run.impacts, moment.time);
  const std::vector<std::size_t> passed = eventsAt(run.jointImpulses, moment.time);
  const auto jointOf = [&](std::size_t k) -> const Joint& {
    return run.world.joints[static_cast<std::size_t>(run.jointImpulses[k].joint)];
  };
  for (const std::size_t k : impacts) {
    concerned.join(namedBy(run.impacts[k]));
  }
  for (const std::size_t k : passed) {
    concerned.join(namedBy(jointOf(k)));
  }
  const std::vector<int> asked = namedBy(run.impacts[asIndex]);
  std::vector<int> named;
  for (const std::size_t k : impacts) {
    if (k == asIndex || concerned.isOne(namedBy(run.impacts[k]), asked)) {
      moment.impacts.push_back(k);
      addNamed(run.impacts[k], named);
    } else {
      moment.atTheSameTime.push_back(k);
    }
  }
  for (const std::size_t k : passed) {
    if (concerned.isOne(namedBy(jointOf(k)), asked)) {
      moment.joints.push_back(static_cast<std::size_t>(run.jointImpulses[k].joint));
      addNamed(jointOf(k), named);
    }
  }
  std::sort(moment.joints.begin(), moment.joints.end());
  moment.joints.erase(std::unique(moment.joints.begin(), moment.joints.end()), moment.joints.end());
  moment.bodies = struckBodies(run, std::move(named), moment.time);
  moment.law = lawOf(run, moment);
  return moment;
}

PointVelocities pointVelocities(const Impact& impact, const std::vector<StruckBody>& bodies,
                                const World& world) {
  PointVelocities velocities;
  const auto addDriven = [&](const Course& course, double sign) {
    if (!course.empty()) {
      const Kinematics driven = partAt(course, impact.time).at(impact.time);
      const Vec3 velocity = sign * driven.velocityAt(impact.point - driven.pose.position);
      velocities.before += velocity;
      velocities.after += velocity;
    }
  };
  const auto add = [&](int index, double sign) {
    const auto found = std::find_if(bodies.begin(), bodies.end(), [&](const StruckBody& struck) {
      return struck.body == static_cast<std::size_t>(index);
    });
    if (found == bodies.end()) {  // no impulse moves it
      addDriven(world.bodies[static_cast<std::size_t>(index)].course, sign);
      return;
    }
    const MassProperties& mass = world.bodies[found->body].mass;
    const auto at = [&](const BodyState& state) -> Vec3 {
      return sign *
             pointVelocity(state.velocity, angularVelocity(mass, state), impact.point - state.pose.position);
    };
    velocities.before += at(found->before);
    velocities.after += at(found->after);
  };
  add(impact.a.value, 1);
  if (impact.b.isWall()) {
    addDriven(world.walls[impact.b.wall()].course, -1);
  } else {
    add(impact.b.body(), -1);
  }
  const Vec3 surface = pairOf(impact, world).surface.along(impact.normal, impact.point);
  velocities.before -= surface;
  velocities.after -= surface;
  return velocities;
}

FrictionOutcome frictionOutcome(const Impact& impact, const World& world) {
  constexpr double kLimitRounding = 1e-9;  // [1]
  const double most = pairOf(impact, world).friction * impact.impulse;
  if (most == 0 || impact.tangential == 0) {
    return most == 0 ? FrictionOutcome::kNone : FrictionOutcome::kIdle;
  }
  return impact.tangential < (1 - kLimitRounding) * most ? FrictionOutcome::kSticks
                                                         : FrictionOutcome::kSlides;
}

Material pairOf(const Impact& impact, const World& world) {
  return touching(world.bodies[static_cast<std::size_t>(impact.a.value)].material,
                  impact.b.isWall() ? world.walls[impact.b.wall()].material
                                    : world.bodies[static_cast<std::size_t>(impact.b.body())].material);
}

}  // namespace careen
