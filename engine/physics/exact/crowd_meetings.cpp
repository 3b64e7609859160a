#include "physics/exact/crowd_meetings.h"

#include <algorithm>

#include "physics/geometry/separation.h"
#include "physics/motion/hermite_step.h"
#include "physics/search/first_contact_search.h"

namespace careen {
namespace {

/// Motion of a member in a step, for the contact search.
class MemberStep {
 public:
  MemberStep(const Body& body, const ContactStep& step) : body_(body), step_(step), bounds_(boundsOf(step)) {}
  Attitude operator()(double elapsed) const {
    const BodyState state = stateAt(Motion(step_), body_.mass, elapsed);
    return {.worldFromBody = state.pose.worldFromBody, .angularVelocity = angularVelocity(body_.mass, state)};
  }
  MovingBox moving(int box) const {
    const TouchingShape shape = shapeOf(body_, box);
    return {.halfExtents = shape.halfExtents,
            .center = shape.center,
            .bodyFromBox = shape.bodyFromBox,
            .position = step_.position[0],
            .velocity = Vec3::Zero(),
            .acceleration = Vec3::Zero(),
            .angularSpeedBound = bounds_.angularSpeed,
            .angularAccelerationBound = bounds_.angularAcceleration,
            .attitude = AttitudeView(*this),
            .step = &step_,
            .speedBound = bounds_.speed,
            .accelerationBound = bounds_.acceleration};
  }

 private:
  const Body& body_;
  ContactStep step_;
  StepBounds bounds_;
};

// The next step if nothing pushes it.
ContactStep unpushed(const Crowd& crowd, std::size_t place, const Vec3& gravity, double length) {
  PileBody body = crowd.body(place);
  const StepEnd from{.position = body.position,
                     .velocity = body.velocity + body.behind * gravity,
                     .worldFromBody = body.attitude,
                     .spinBody = body.attitude.conjugate() * body.omega};
  turnFree(body, length);
  const StepEnd to{.position = body.position + length * (from.velocity + 0.5 * length * gravity),
                   .velocity = from.velocity + length * gravity,
                   .worldFromBody = body.attitude,
                   .spinBody = body.attitude.conjugate() * body.omega};
  return asContactStep(cubicStep(from, to, length));
}

// Whether any box of a body meets one of another in so long [s] from `time` on; `moving(box)` of the other.
template <class Moving>
bool anyMeet(const Bodies& bodies, const Mover& body, const Instant& time, const Body& other, double length,
             const Moving& moving) {
  for (int i = 0; i < body.body->partCount(); ++i) {
    for (int j = 0; j < other.partCount(); ++j) {
      if (firstContactOfBoxes(body.moving(time, i, bodies.foreseen()), moving(j),
                              {.from = 0, .until = length})
              .kind != ContactKind::kNone) {
        return true;
      }
    }
  }
  return false;
}

bool meetsWithin(const Bodies& bodies, const CrowdGroup& group, const Mover& outsider, const Mover& member,
                 const Instant& time, double length) {
  const MemberStep step(*member.body, unpushed(group.crowd(), member.place,
                                               gravityNow(bodies.world(), time.hi + 0.5 * length), length));
  const bool sleeps = group.crowd().sleeps(member.place);
  return anyMeet(bodies, outsider, time, *member.body, length, [&](int box) {
    return sleeps ? member.moving(time, box, bodies.foreseen()) : step.moving(box);
  });
}

/// Whether any member in the cells around that body, which may touch it, does that.
template <class Does>
bool anyMember(const Bodies& bodies, const CrowdGroup& group, int rank, const Does& does) {
  return bodies.anyAround(rank, [&](int candidate) {
    const Mover& member = bodies[candidate];
    return group.has(member) && mayTouch(bodies.world(), bodies[rank].listed.value, member.listed.value) &&
           does(member);
  });
}

}  // namespace

bool restsOnlySince(const Mover& body, const Instant& time) {
  return !body.moves() && earlier(time, body.start);
}

bool fliesSince(const Bodies& bodies, const Mover& body, const Instant& time) {
  return body.flies() && bodies.joinedTo(body.rank).empty() && !earlier(time, body.start);
}

std::vector<int> outsidersIn(const Bodies& bodies, const CrowdGroup& group, const Crowd::Extent& extent,
                             const Instant& time, double length, Outsiders which) {
  std::vector<int> found;
  for (const int rank : bodies.mayReach(extent.low, extent.high, time, length)) {
    const Mover& body = bodies[rank];
    if (group.has(body) || (which == Outsiders::kInNoGroup && body.group)) {
      continue;
    }
    const double way = body.flies()   ? length * (body.flight.velocityAt(body.elapsed(time)).norm() +
                                                length * gravityScale(bodies.world()))
                       : body.moves() ? length * body.bounds.speed
                                      : 0;
    const Vec3 reach = Vec3::Constant(radiusOf(*body.body) + way);
    const Vec3 center = body.moves() ? body.positionAt(time) : body.pose.position;
    const bool inside = ((center + reach).array() >= extent.low.array()).all() &&
                        ((center - reach).array() <= extent.high.array()).all();
    if (inside && !(body.isHeld() &&
                    std::find(group.ranks().begin(), group.ranks().end(), rank) != group.ranks().end())) {
      found.push_back(rank);
    }
  }
  return found;
}

bool wasMet(const Bodies& bodies, const CrowdGroup& group, int rank, const Instant& time) {
  const Mover& body = bodies[rank];
  const Crowd& crowd = group.crowd();
  const double length =
      body.steps() ? std::min(crowd.length(), secondsBetween(time, body.group->end())) : crowd.length();
  const Pose pose = body.moves() ? body.stateAt(time).pose : body.pose;
  const double way = body.steps() || body.isDriven() ? length * body.bounds.speed : 0;
  return length > 0 && anyMember(bodies, group, rank, [&](const Mover& member) {
           if (!crowd.cameNear(member.place, *body.body, pose, way)) {
             return false;
           }
           const MemberStep step(
               *member.body,
               asContactStep(cubicStep(crowd.begin(member.place), crowd.end(member.place), crowd.length())));
           return anyMeet(bodies, body, time, *member.body, length,
                          [&](int box) { return step.moving(box); });
         });
}

bool meetsNext(const Bodies& bodies, const CrowdGroup& group, int rank, const Instant& time, double length) {
  const Mover& body = bodies[rank];
  const bool isOfCrowd = body.group && !body.group->isPredicted();
  if (isOfCrowd && body.group->ranks().size() > group.ranks().size()) {
    return false;
  }
  const double within = isOfCrowd ? kStepsAhead * length : length;
  const BodyState state = body.stateAt(time);
  const double radius = radiusOf(*body.body);
  const double turning = body.moves() ? angularVelocity(body.body->mass, state).norm() * radius : 0;
  return anyMember(bodies, group, rank, [&](const Mover& member) {
    if (!body.moves() && group.crowd().sleeps(member.place)) {
      return false;
    }
    const PileBody& at = group.crowd().body(member.place);
    const double way =
        bodies.crowds().tolerance +
        within * ((state.velocity - at.velocity).norm() + turning + at.radius * at.omega.norm() +
                  (within + at.behind) * gravityScale(bodies.world()));
    if ((state.pose.position - at.position).norm() > radius + at.radius + way ||
        !anyBoxes(*body.body, state.pose, *member.body, stateOf(at).pose,
                  [&](const BoxAt& a, const BoxAt& b) { return BoxAxes(a, b).gap() <= way; })) {
      return false;
    }
    return !body.moves() || body.isDriven() || isOfCrowd ||
           (body.flies() && meetsWithin(bodies, group, body, member, time, length));
  });
}

std::vector<int> nearStep(const Bodies& bodies, const CrowdGroup& group) {
  const double length = group.length();
  std::vector<int> near =
      outsidersIn(bodies, group, group.crowd().swept(), group.start(), length, Outsiders::kAll);
  std::erase_if(near, [&](int rank) {
    const Mover& body = bodies[rank];
    if (!body.moves()) {
      return true;
    }
    const BodyState state = body.stateAt(group.start());
    const double speed =
        state.velocity.norm() + angularVelocity(body.body->mass, state).norm() * radiusOf(*body.body);
    const double way =
        length *
        (body.steps() || body.isDriven() ? body.bounds.speed : speed + length * gravityScale(bodies.world()));
    return !anyMember(bodies, group, rank, [&](const Mover& member) {
      return group.crowd().cameNear(member.place, *body.body, state.pose, way);
    });
  });
  return near;
}

}  // namespace careen
