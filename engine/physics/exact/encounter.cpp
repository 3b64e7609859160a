#include "physics/exact/encounter.h"

#include <algorithm>
#include <array>

#include "physics/contact/joint_rows.h"
#include "physics/geometry/separation.h"
#include "physics/world/forces.h"

namespace careen {
namespace {

/// [1] of the tolerance: bodies that go on by time steps are one group up to this gap.
constexpr double kNear = 64;
/// [1] of the lengths at a contact: its two points count as one.
constexpr double kOnePoint = 0x1p-42;

bool takesPart(const Encounter& encounter, int rank) {
  return encounter.indexOf(rank) < encounter.bodies.size();
}

void reach(Bodies& bodies, const Event& event, Encounter& encounter) {
  join(bodies, encounter, event.body);
  if (event.partner != Event::kNobody) {
    join(bodies, encounter, event.partner);
  }
  for (std::size_t reached = 0; reached < encounter.bodies.size(); ++reached) {
    const Mover& body = *encounter.bodies[reached].mover;
    if (body.isHeld()) {
      continue;
    }
    for (const int candidate : bodies.around(body.rank)) {
      const Mover& other = bodies[candidate];
      if (!takesPart(encounter, candidate) &&
          areTouching(*body.body, encounter.bodies[reached].before.pose, *other.body,
                      other.stateAt(encounter.time).pose, nearness(bodies, encounter))) {
        join(bodies, encounter, candidate);
      }
    }
  }
  std::sort(encounter.bodies.begin(), encounter.bodies.end(),
            [](const EncounterBody& x, const EncounterBody& y) { return x.mover->rank < y.mover->rank; });
}

void findJoints(const World& world, Encounter& encounter) {
  if (world.joints.empty()) {
    return;
  }
  const std::size_t boxes = encounter.boxes().size();
  encounter.joints = jointFeatures(world, encounter.time.hi, [&](const JointEnd& end) {
    if (!end.body) {
      return static_cast<int>(encounter.bodies.size()) - 1;  // nowhere
    }
    for (std::size_t i = 0; i < boxes; ++i) {
      if (encounter.bodies[i].listed() == *end.body) {
        return static_cast<int>(i);
      }
    }
    return -1;
  });
}

double pullOf(const Bodies& bodies, const Encounter& encounter) {
  double pull = gravityScale(bodies.world());
  for (const EncounterBody& body : encounter.bodies) {
    if (body.mover->isDriven()) {
      pull = std::max(pull, drivenAcceleration(std::array{body.touching(encounter.time)}));
    }
  }
  if (!isAnyForced(bodies, encounter)) {
    return pull;
  }
  const std::vector<double> all =
      pulls(bodies.world(), statesIn(bodies.world(), encounter, &EncounterBody::before));
  for (const EncounterBody& body : encounter.boxes()) {
    pull = std::max(pull, all[static_cast<std::size_t>(body.listed())]);
  }
  return pull;
}

}  // namespace

TouchingBody EncounterBody::touching(const Instant& time) const {
  const Vec3 spun = after.pose.worldFromBody.transpose() * after.angularMomentum;
  return {.body = mover->body,
          .halfSpace = mover->halfSpace,
          .index = listed(),
          .position = after.pose.position,
          .worldFromBody = attitude,
          .velocity = after.velocity,
          .angularVelocityBody = mover->isHeld() ? spun : body().mass.inverseInertiaTimes(spun),
          .drivenBy = mover->isDriven() ? mover->drivenBy : nullptr,
          .time = time.hi};
}

std::size_t Encounter::indexOf(int rank) const {
  return static_cast<std::size_t>(
      std::find_if(bodies.begin(), bodies.end(),
                   [&](const EncounterBody& body) { return body.mover->rank == rank; }) -
      bodies.begin());
}

std::vector<int> Encounter::ranks() const {
  std::vector<int> all;
  for (const EncounterBody& body : bodies) {
    all.push_back(body.mover->rank);
  }
  return all;
}

std::span<const EncounterBody> Encounter::boxes() const {
  const auto walls = std::find_if(bodies.begin(), bodies.end(),
                                  [](const EncounterBody& body) { return !body.mover->isBox(); });
  return std::span(bodies).first(static_cast<std::size_t>(walls - bodies.begin()));
}

// A wall's offset is no larger than the body's part.
double Encounter::lengthsAt(std::size_t contact) const {
  const auto of = [](const EncounterBody& body) {
    return body.after.pose.position.cwiseAbs().sum() + radiusOf(body.body());
  };
  return of(a(contact)) + of(b(contact).mover->isBox() ? b(contact) : a(contact));
}

// Where the gap is only rounding the arms stay as they are, or a cube that lands flat would tilt.
ImpactContact Encounter::joined(std::size_t contact) const {
  ImpactContact at = contacts[contact];
  if (b(contact).mover->isBox() && at.joint == ImpactContact::kNoJoint) {
    const Vec3 link = (a(contact).after.pose.position - b(contact).after.pose.position) + (at.armA - at.armB);
    if (link.norm() > kOnePoint * lengthsAt(contact)) {
      at.armA -= 0.5 * link;
      at.armB += 0.5 * link;
    }
  }
  return at;
}

Encounter gather(Bodies& bodies, const Event& event) {
  Encounter encounter;
  encounter.time = event.time;
  encounter.bodies.reserve(bodies.walls().size() + 2);
  // The same pair triggers again without approaching (edges passing within rounding): what hardly parts
  // persists. If that does not help, they go on by a few time steps, which need no list of contacts.
  constexpr int kMostMeetings = 2;
  constexpr int kMostSlowMeetings = 8;
  constexpr int kTimeStepsOfMeeting = 8;
  const int meetings = event.kind == EventKind::kStep ? 0 : bodies[event.body].atOneMoment;
  encounter.passing = meetings > kMostMeetings ? kHardlyParts : 0;
  encounter.timeSteps = meetings > kMostSlowMeetings ? kTimeStepsOfMeeting : 0;
  encounter.cause = meetings > kMostMeetings ? EventKind::kTouching : event.kind;
  reach(bodies, event, encounter);
  for (const Mover& each : bodies.walls()) {
    EncounterBody& wall = encounter.bodies.emplace_back();
    wall.mover = &bodies[each.rank];
    if (!each.course().empty()) {
      wall.attitude = each.attitudeAt(event.time);
      wall.before = each.stateAt(event.time, wall.attitude);
    }
  }
  for (EncounterBody& body : encounter.bodies) {
    body.after = body.before;
  }
  if (endsInWorld(bodies.world())) {
    encounter.bodies.emplace_back().mover = &bodies[bodies.count() + static_cast<int>(bodies.walls().size())];
  }
  encounter.pull = pullOf(bodies, encounter);
  findJoints(bodies.world(), encounter);
  return encounter;
}

bool areTouching(const EncounterBody& a, const EncounterBody& b, double apart) {
  return areTouching(a.body(), a.before.pose, b.body(), b.before.pose, apart);
}

void join(Bodies& bodies, Encounter& encounter, int rank) {
  Mover& body = bodies[rank];
  if (!body.isBox() || takesPart(encounter, rank)) {
    return;
  }
  if (!body.group) {
    const Quat attitude = body.attitudeAt(encounter.time);
    encounter.bodies.push_back(
        {.mover = &body, .attitude = attitude, .before = body.stateAt(encounter.time, attitude)});
  } else if (!body.group->enter(encounter, rank)) {
    return;
  }
  for (const int other : bodies.joinedTo(rank)) {
    join(bodies, encounter, other);
  }
}

double nearness(const Bodies& bodies, const Encounter& encounter) {
  return encounter.timeSteps > 0 ? kNear * bodies.tolerance() : 0;
}

std::vector<BodyState> statesIn(const World& world, const Encounter& encounter,
                                BodyState EncounterBody::*state) {
  std::vector<BodyState> states;
  for (const Body& body : world.bodies) {
    states.push_back(body.initial);
  }
  for (const EncounterBody& body : encounter.boxes()) {
    states[static_cast<std::size_t>(body.listed())] = body.*state;
  }
  return states;
}

bool isAnyForced(const Bodies& bodies, const Encounter& encounter) {
  return std::any_of(encounter.bodies.begin(), encounter.bodies.end(),
                     [&](const EncounterBody& body) { return bodies.isForced(body.mover->rank); });
}

}  // namespace careen
