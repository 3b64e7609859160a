#include <algorithm>
#include <memory>

#include "physics/exact/exact_world.h"
#include "physics/geometry/separation.h"

// What a crowd is about to meet.

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
  MovingBox moving() const {
    return {.halfExtents = body_.halfExtents,
            .center = body_.boxCenter,
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

}  // namespace

// Bodies that are no members and may get into that space within that time; if it began in the past, only such
// as are in no group: of the others it is known where they are now.
std::vector<int> ExactWorld::outsidersIn(const Crowd::Extent& extent, const ContactGroup& group,
                                         const Instant& time, double length, bool past) const {
  std::vector<int> found;
  for (int rank = 0; rank < static_cast<int>(movers_.size()); ++rank) {
    const Mover& body = mover(rank);
    if (body.crowd.get() == &group || (past && (body.crowd || body.touches()))) {
      continue;
    }
    const double way =
        body.flies
            ? length * (body.flight.velocityAt(body.elapsed(time)).norm() + length * world_.gravity.norm())
        : body.touches() ? length * body.speedBound
                         : 0;
    const Vec3 reach = Vec3::Constant(radiusOf(*body.body) + way);
    const Vec3 center = body.moves() ? body.positionAt(time) : body.pose.position;
    const bool inside = ((center + reach).array() >= extent.low.array()).all() &&
                        ((center - reach).array() <= extent.high.array()).all();
    if (inside &&
        !(body.isHeld() && std::find(group.ranks.begin(), group.ranks.end(), rank) != group.ranks.end())) {
      found.push_back(rank);
    }
  }
  return found;
}

// Admits what its members meet within the next step if nothing pushes them, and bodies at rest near them.
void ExactWorld::admitNear(const std::shared_ptr<ContactGroup>& group, const Instant& time, double length) {
  for (bool added = true; added;) {
    added = false;
    for (const int rank : outsidersIn(group->crowd->extent(length), *group, time, length, false)) {
      const Mover& body = mover(rank);
      if (body.crowd != group && meetsNext(*group, rank, time, length)) {
        admitOutsider(group, rank, time);
        added = true;
      }
    }
  }
}

// With those that it is in contact with, and all that springs join to them.
void ExactWorld::admitOutsider(const std::shared_ptr<ContactGroup>& group, int rank, const Instant& time) {
  Encounter with;
  with.time = time;
  join(with, rank);
  for (const std::shared_ptr<ContactGroup>& other : with.crowds) {
    if (other != group) {
      endAt(other, time);
      merge(group, *other);
    }
  }
  for (std::size_t i = 0; i < with.ranks.size(); ++i) {
    enlist(group, with.ranks[i], time, with.before[i], with.attitudes[i]);
  }
}

// Admits whom its members, pushed otherwise than expected, met in the step that they have taken: bodies at
// rest and members of other crowds, none of which look for contacts; if it was taken `again`, in place of the
// latter those who had looked when it was another. Returns whether there were any.
bool ExactWorld::admitMet(const std::shared_ptr<ContactGroup>& group, const Instant& time, bool again) {
  bool any = false;
  for (const int rank : outsidersIn(group->crowd->swept(), *group, time, group->crowd->length(), again)) {
    const Mover& body = mover(rank);
    const bool asked = again
                           ? !body.crowd && (body.moves() ? fliesSince(rank, time) : !restsSince(rank, time))
                           : body.crowd != group && (body.crowd || !body.flies);
    if (asked && wasMet(*group, rank, time)) {
      admitOutsider(group, rank, time);
      any = true;
    }
  }
  return any;
}

bool ExactWorld::wasMet(const ContactGroup& group, int rank, const Instant& time) {
  const Mover& body = mover(rank);
  const double length = body.touches()
                            ? std::min(group.crowd->length(), secondsBetween(time, body.contactGroup->end()))
                            : group.crowd->length();
  const Pose pose = body.moves() ? body.stateAt(time).pose : body.pose;
  const double way = body.touches() ? length * body.speedBound : 0;
  neighbors_.findCandidates(rank, candidates_);
  return length > 0 && std::any_of(candidates_.begin(), candidates_.end(), [&](Neighbors::Key candidate) {
           const Mover& member = mover(candidate);
           if (member.crowd.get() != &group ||
               !group.crowd->cameNear(member.place, boxAt(pose, *body.body), way)) {
             return false;
           }
           const StepEnd from = group.crowd->begin(member.place);
           const MemberStep step(*member.body, asContactStep(cubicStep(from, group.crowd->end(member.place),
                                                                       group.crowd->length())));
           return firstContactOfBoxes(body.moving(time), step.moving(), {.from = 0, .until = length}).kind !=
                  ContactKind::kNone;
         });
}

bool ExactWorld::meetsNext(const ContactGroup& group, int rank, const Instant& time, double length) {
  const Mover& body = mover(rank);
  const BodyState state = body.stateAt(time);
  const double radius = radiusOf(*body.body);
  const double turning = body.moves() ? angularVelocity(body.body->mass, state).norm() * radius : 0;
  neighbors_.findCandidates(rank, candidates_);
  return std::any_of(candidates_.begin(), candidates_.end(), [&](Neighbors::Key candidate) {
    const Mover& member = mover(candidate);
    if (member.crowd.get() != &group || (!body.moves() && group.crowd->sleeps(member.place))) {
      return false;
    }
    const PileBody& at = group.crowd->body(member.place);
    const double way = crowds_.tolerance +
                       length * ((state.velocity - at.velocity).norm() + turning +
                                 at.radius * at.omega.norm() + (length + at.behind) * world_.gravity.norm());
    if ((state.pose.position - at.position).norm() > radius + at.radius + way ||
        BoxAxes(boxAt(state.pose, *body.body), boxAt(stateOf(at).pose, *member.body)).gap() > way) {
      return false;
    }
    return !body.moves() || body.crowd || (body.flies && meetsWithin(group, rank, member, time, length));
  });
}

// Who may meet a member in the step that it has taken, perhaps another way than it was going.
std::vector<int> ExactWorld::nearStep(const ContactGroup& group) {
  const double length = group.step.length;
  std::vector<int> near = outsidersIn(group.crowd->swept(), group, group.start, length, false);
  std::erase_if(near, [&](int rank) {
    const Mover& body = mover(rank);
    if (!body.moves()) {
      return true;
    }
    const BodyState state = body.stateAt(group.start);
    const double speed =
        state.velocity.norm() + angularVelocity(body.body->mass, state).norm() * radiusOf(*body.body);
    const double way = length * (body.touches() ? body.speedBound : speed + length * world_.gravity.norm());
    neighbors_.findCandidates(rank, candidates_);
    return std::none_of(candidates_.begin(), candidates_.end(), [&](Neighbors::Key candidate) {
      const Mover& member = mover(candidate);
      return member.crowd.get() == &group &&
             group.crowd->cameNear(member.place, boxAt(state.pose, *body.body), way);
    });
  });
  return near;
}

bool ExactWorld::meetsWithin(const ContactGroup& group, int rank, const Mover& member, const Instant& time,
                             double length) const {
  const MovingBox body = mover(rank).moving(time);
  const SearchWindow window{.from = 0, .until = length};
  const MemberStep step(*member.body, unpushed(*group.crowd, member.place, world_.gravity, length));
  const FirstContact contact = group.crowd->sleeps(member.place)
                                   ? firstContactOfBoxes(body, member.moving(time), window)
                                   : firstContactOfBoxes(body, step.moving(), window);
  return contact.kind != ContactKind::kNone;
}

}  // namespace careen
