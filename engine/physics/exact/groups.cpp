#include <algorithm>
#include <numeric>
#include <utility>

#include "physics/contact/implicit_step.h"
#include "physics/exact/exact_world.h"
#include "physics/impact/wall_contacts.h"
#include "physics/search/first_contact_search.h"

// Contact groups: bodies that touch at one moment, and the impact on them.

namespace careen {
namespace {

/// [1] of the lengths at a contact: its two points count as one.
constexpr double kOnePoint = 0x1p-42;

}  // namespace

// ---- Detection of contacts.

ExactWorld::Encounter ExactWorld::gather(const Event& event) {
  Encounter encounter;
  encounter.time = event.time;
  // The same pair triggers again without approaching (edges passing within rounding): what hardly parts
  // persists. If that does not help, they go on by a few time steps, which need no list of contacts.
  constexpr int kMostMeetings = 2;
  constexpr int kMostSlowMeetings = 8;
  constexpr int kTimeStepsOfMeeting = 8;
  const int meetings = event.kind == EventKind::kStep ? 0 : mover(event.body).atOneMoment;
  encounter.passing = meetings > kMostMeetings ? kHardlyParts : 0;
  encounter.timeSteps = meetings > kMostSlowMeetings ? kTimeStepsOfMeeting : 0;
  encounter.cause = meetings > kMostMeetings ? EventKind::kTouching : event.kind;
  reach(event, encounter);
  encounter.pull = pullOf(encounter);
  return encounter;
}

void ExactWorld::findContacts(const Event& event, Encounter& encounter) {
  encounter.after = encounter.before;
  alignPlaces(encounter, event);
  encounter.after = encounter.before;
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    const Mover& body = mover(encounter.ranks[i]);
    if (!body.isHeld()) {
      account_.penetrates(addWallContacts(world_, *body.body, encounter.before[i].pose, static_cast<int>(i),
                                          encounter.contacts));
    }
    for (std::size_t j = i + 1; j < encounter.ranks.size(); ++j) {
      addPairContacts(encounter, i, j);
    }
  }
  encounter.shares.resize(encounter.contacts.size());
  encounter.persists.assign(encounter.contacts.size(), 0);
  encounter.next.assign(encounter.ranks.size(), Next::kGoesOn);
  encounter.since.assign(encounter.ranks.size(), encounter.time);
}

// Adds a body to an encounter, once, together with its island, which is advanced to this moment.
void ExactWorld::join(Encounter& encounter, int rank) {
  if (std::find(encounter.ranks.begin(), encounter.ranks.end(), rank) != encounter.ranks.end()) {
    return;
  }
  const Mover& body = mover(rank);
  if (body.crowd) {
    if (std::find(encounter.crowds.begin(), encounter.crowds.end(), body.crowd) == encounter.crowds.end()) {
      encounter.crowds.push_back(body.crowd);
    }
    return;
  }
  encounter.ranks.push_back(rank);
  if (!body.touches()) {
    encounter.attitudes.push_back(body.attitudeAt(encounter.time));
    encounter.before.push_back(body.stateAt(encounter.time, encounter.attitudes.back()));
  } else {
    ContactGroup& with = *body.contactGroup;
    if (earlier(encounter.time, with.end())) {
      with.step.length = secondsBetween(with.start, encounter.time);
      with.island->cutTo(with.step.length);
    }
    encounter.timeSteps = std::max(encounter.timeSteps, with.island->timeStepsLeft());
    with.island->endTimeSteps();
    const TouchingBody& here = with.island->bodies()[body.place];
    encounter.attitudes.push_back(here.worldFromBody);
    encounter.before.push_back(here.state());
    for (const int each : with.ranks) {
      join(encounter, each);
    }
  }
  for (const int other : springs_[static_cast<std::size_t>(rank)]) {
    join(encounter, other);
  }
}

// [m] Bodies that go on by time steps take those with them that they would meet at once: an arrival costs
// more.
double ExactWorld::nearness(const Encounter& encounter) const {
  return encounter.timeSteps > 0 ? kNear * tolerance_ : 0;
}

// Of all bodies of the world: those of the encounter as in `of`, the others as at the start.
std::vector<BodyState> ExactWorld::statesIn(const Encounter& encounter,
                                            const std::vector<BodyState>& of) const {
  std::vector<BodyState> states;
  for (const Body& body : world_.bodies) {
    states.push_back(body.initial);
  }
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    states[static_cast<std::size_t>(mover(encounter.ranks[i]).listed.value)] = of[i];
  }
  return states;
}

double ExactWorld::pullOf(const Encounter& encounter) const {
  double pull = world_.gravity.norm();
  if (std::none_of(encounter.ranks.begin(), encounter.ranks.end(),
                   [&](int rank) { return isForced(rank); })) {
    return pull;
  }
  const std::vector<double> all = pulls(world_, statesIn(encounter, encounter.before));
  for (const int rank : encounter.ranks) {
    pull = std::max(pull, all[static_cast<std::size_t>(mover(rank).listed.value)]);
  }
  return pull;
}

// An impact propagates to every body that touches one it reaches, except through immovable bodies.
void ExactWorld::reach(const Event& event, Encounter& encounter) {
  join(encounter, event.body);
  if (!event.partner.isWall()) {
    join(encounter, event.partner.body());
  }
  std::vector<Neighbors::Key> candidates;
  for (std::size_t reached = 0; reached < encounter.ranks.size(); ++reached) {
    if (mover(encounter.ranks[reached]).isHeld()) {
      continue;
    }
    neighbors_.findCandidates(encounter.ranks[reached], candidates);
    for (const Neighbors::Key candidate : candidates) {
      const Mover& other = mover(candidate);
      if (std::find(encounter.ranks.begin(), encounter.ranks.end(), candidate) == encounter.ranks.end() &&
          areTouching(boxOf(encounter, reached), boxAt(other.stateAt(encounter.time).pose, *other.body),
                      nearness(encounter))) {
        join(encounter, candidate);
      }
    }
  }
  std::vector<std::size_t> order(encounter.ranks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t x, std::size_t y) { return encounter.ranks[x] < encounter.ranks[y]; });
  Encounter sorted;
  for (const std::size_t i : order) {
    sorted.ranks.push_back(encounter.ranks[i]);
    sorted.attitudes.push_back(encounter.attitudes[i]);
    sorted.before.push_back(encounter.before[i]);
  }
  encounter.ranks = std::move(sorted.ranks);
  encounter.attitudes = std::move(sorted.attitudes);
  encounter.before = std::move(sorted.before);
}

// ---- Impacts.

// Lets both bodies' impulses act at one point: at two, a gap apart, friction would change angular momentum.
// Where the gap is only rounding the arms stay as they are, or a cube that lands flat would tilt.
void ExactWorld::joinPoints(const Encounter& encounter, std::size_t index, ImpactContact& contact) const {
  if (contact.b.isWall()) {
    return;
  }
  const auto place = [&](int body) -> const Vec3& {
    return encounter.after[static_cast<std::size_t>(body)].pose.position;
  };
  const Vec3 link = (place(contact.a) - place(contact.b.body())) + (contact.armA - contact.armB);
  if (link.norm() > kOnePoint * lengthsAt(encounter, index)) {
    contact.armA -= 0.5 * link;
    contact.armB += 0.5 * link;
  }
}

void ExactWorld::resolve(Encounter& encounter) {
  std::vector<ImpactBody> bodies;
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    bodies.push_back({.mass = &mover(encounter.ranks[i]).body->mass, .state = &encounter.after[i]});
  }
  bool mayLose = std::any_of(encounter.ranks.begin(), encounter.ranks.end(),
                             [&](int rank) { return mover(rank).touches(); });
  for (const ImpactContact& contact : encounter.contacts) {
    mayLose = mayLose || contact.material.restitution < 1 || contact.material.friction > 0;
  }
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    if (mover(encounter.ranks[i]).flies) {
      arrive(mover(encounter.ranks[i]), encounter.time, encounter.before[i]);
    }
  }
  account_.strikes(mayLose);
  std::vector<ImpactContact> contacts = encounter.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    joinPoints(encounter, k, contacts[k]);
  }
  double radius = 0;
  double rate = 0;  // [1/s]
  for (std::size_t i = 0; i < encounter.ranks.size(); ++i) {
    const Body& body = *mover(encounter.ranks[i]).body;
    if (!isImmovable(body.mass)) {
      const BodyState& state = encounter.before[i];
      radius = std::max(radius, radiusOf(body));
      rate = std::max(
          rate, state.velocity.norm() / radiusOf(body) + careen::angularVelocity(body.mass, state).norm());
    }
  }
  account_.solved(resolveImpact(bodies, contacts, encounter.shares,
                                {.tolerable = tolerableResidual(tolerance_, radius, rate, encounter.pull)}));
}

void ExactWorld::record(const Encounter& encounter) {
  for (std::size_t k = 0; k < encounter.contacts.size(); ++k) {
    const ImpactShare& share = encounter.shares[k];
    if (share.impulse > 0) {
      ImpactContact contact = encounter.contacts[k];
      joinPoints(encounter, k, contact);
      const auto a = static_cast<std::size_t>(contact.a);
      const auto listed = [&](int index) {
        return mover(encounter.ranks[static_cast<std::size_t>(index)]).listed;
      };
      recorder_.strikes(
          {.time = encounter.time.hi,
           .a = listed(contact.a),
           .b = contact.b.isWall() ? contact.b : Partner::ofBody(listed(contact.b.body()).value),
           .point = encounter.before[a].pose.position + contact.armA,
           .normal = share.normal,
           .approach = share.approach,
           .impulse = share.impulse,
           .tangential = share.tangential});
    }
  }
}

void ExactWorld::record(const ContactGroup& contactGroup) {
  for (const GroupImpact& impact : contactGroup.island->impacts()) {
    const auto listed = [&](int place) {
      return mover(contactGroup.ranks[static_cast<std::size_t>(place)]).listed;
    };
    const ImpactContact& contact = impact.contact;
    const BodyState at =
        mover(contactGroup.ranks[static_cast<std::size_t>(contact.a)]).stateAt(contactGroup.start);
    recorder_.strikes({.time = contactGroup.start.hi,
                       .a = listed(contact.a),
                       .b = contact.b.isWall() ? contact.b : Partner::ofBody(listed(contact.b.body()).value),
                       .point = at.pose.position + contact.armA,
                       .normal = impact.share.normal,
                       .approach = impact.share.approach,
                       .impulse = impact.share.impulse,
                       .tangential = impact.share.tangential});
  }
}

}  // namespace careen
