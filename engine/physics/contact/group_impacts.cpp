#include "physics/contact/group_impacts.h"

#include <algorithm>
#include <cmath>

#include "core/disjoint_sets.h"

namespace careen {
namespace {

/// [1] of a closed gap: hops no higher are not followed.
constexpr double kHop = 0x1p-4;
/// [1] of the residual to which impulses are solved: approach no faster is none.
constexpr double kResiduals = 4;
constexpr int kMostRounds = 8;

}  // namespace

void GroupImpacts::resolve(GroupState& state, FoundContacts& contacts, double acceleration) {
  contacts.follow(state);
  for (int round = 0; round < kMostRounds && resolveOnce(state, contacts, acceleration); ++round) {
    contacts.follow(state);
  }
}

// All contacts of bodies that are joined to one of those that approach; but grips, whose force is finite.
GroupImpacts::Struck GroupImpacts::struckAt(const GroupState& state, const FoundContacts& contacts,
                                            double acceleration) const {
  const TouchingGroup& group = equations_.group();
  const std::vector<ContactFeature>& features = contacts.features();
  double speeds = 0;
  for (const GroupBody& body : state) {
    speeds = std::max(speeds, body.velocity.norm());
  }
  const double slow = -std::max(0x1p-40 * speeds, kResiduals * equations_.residual());
  DisjointSets joined(group.size());
  for (const ContactFeature& feature : features) {
    const auto a = static_cast<std::size_t>(feature.a);
    const auto b = static_cast<std::size_t>(feature.b);
    if (!group.isHeld(a) && !group.isHeld(b)) {
      joined.join(a, b);
    }
  }
  const auto rootOf = [&](const ContactFeature& feature) {
    const auto a = static_cast<std::size_t>(feature.a);
    return joined.root(group.isHeld(a) ? static_cast<std::size_t>(feature.b) : a);
  };
  Struck struck;
  std::vector<char> isStruck(group.size(), 0);
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (contacts.rate(c) < slow && !features[c].grips()) {
      isStruck[rootOf(features[c])] = 1;
      const double parting = -features[c].material.restitution * contacts.rate(c);
      struck.bounces = struck.bounces || parting * parting > 2 * acceleration * kHop * contacts.closed();
    }
  }
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (isStruck[rootOf(features[c])] != 0 && !features[c].grips()) {
      struck.features.push_back(features[c]);
      struck.contacts.push_back(contacts.impactAt(c));
      struck.fastest = std::max(struck.fastest, -contacts.rate(c));
    }
  }
  return struck;
}

bool GroupImpacts::resolveOnce(GroupState& state, const FoundContacts& contacts, double acceleration) {
  const Struck struck = struckAt(state, contacts, acceleration);
  if (struck.contacts.empty()) {
    return false;
  }
  std::vector<ImpactShare> shares(struck.contacts.size());
  if (struck.bounces) {
    bounce(state, struck.contacts, shares);
  } else if (!compress(state, struck, shares)) {
    return false;
  }
  for (std::size_t c = 0; c < shares.size(); ++c) {
    if (shares[c].impulse > 0) {
      impacts_.push_back({struck.contacts[c], shares[c], struck.fastest});
    }
  }
  return true;
}

void GroupImpacts::bounce(GroupState& state, std::span<const ImpactContact> contacts,
                          std::span<ImpactShare> shares) {
  std::vector<BodyState> states;
  std::vector<ImpactBody> bodies;
  for (const GroupBody& body : state) {
    states.push_back(body.state());
  }
  for (std::size_t i = 0; i < states.size(); ++i) {
    bodies.push_back({.mass = &equations_.group().body(i).mass, .state = &states[i]});
  }
  const double residual = equations_.residual();
  residuals_.add(resolveImpact(bodies, contacts, shares, {.enough = residual, .tolerable = residual}));
  for (std::size_t i = 0; i < states.size(); ++i) {
    state[i].velocity = states[i].velocity;
    state[i].angularMomentum = states[i].angularMomentum;
  }
}

bool GroupImpacts::compress(GroupState& state, const Struck& struck, std::span<ImpactShare> shares) {
  std::vector<ContactProblem::Triple> impulses;
  const GroupState before = state;
  if (!equations_.compress(state, struck.features, impulses)) {
    return false;
  }
  for (std::size_t c = 0; c < shares.size(); ++c) {
    const ContactProblem::Triple& impulse = impulses[c];
    if (struck.contacts[c].rows) {
      shares[c] = {.impulse = Vec3(impulse[0], impulse[1], impulse[2]).norm(), .rows = impulse};
      continue;
    }
    shares[c] = {.approach = -equations_.group().contactAt(struck.features[c], before).rate,
                 .impulse = impulse[0],
                 .tangential = std::sqrt(impulse[1] * impulse[1] + impulse[2] * impulse[2]),
                 .normal = struck.contacts[c].normal};
  }
  return true;
}

void GroupImpacts::addWithoutApproach(const FoundContacts& contacts, std::span<const ClosedContact> law,
                                      double h, double change) {
  for (std::size_t c = 0; c < contacts.features().size(); ++c) {
    const auto with = std::find_if(law.begin(), law.end(), [&](const ClosedContact& contact) {
      return isSame(contact.feature, contacts.features()[c]);
    });
    if (with != law.end() && with->push > 0 && contacts.features()[c].isOfJoint()) {
      const Vec3 along = contacts.features()[c].isTwoSided() ? with->friction : Vec3(with->push, 0, 0);
      impacts_.push_back({.contact = contacts.impactAt(c),
                          .share = {.impulse = h * with->push,
                                    .normal = contacts.states()[c].normal,
                                    .rows = {h * along[0], h * along[1], h * along[2]}},
                          .cause = change});
    } else if (with != law.end() && with->push > 0) {
      impacts_.push_back({.contact = contacts.impactAt(c),
                          .share = {.approach = std::max(0.0, -contacts.rate(c)),
                                    .impulse = h * with->push,
                                    .tangential = h * with->friction.norm(),
                                    .normal = contacts.states()[c].normal},
                          .cause = change});
    }
  }
}

void GroupImpacts::keepLarger(double speed) {
  const auto inverseMass = [&](int body) {
    return equations_.group().body(static_cast<std::size_t>(body)).mass.inverseMass;
  };
  std::erase_if(impacts_, [&](const GroupImpact& impact) {
    const ImpactContact& contact = impact.contact;
    const double gives = impact.share.impulse * (inverseMass(contact.a) + inverseMass(contact.b));
    return impact.cause <= speed || gives <= speed;
  });
}

}  // namespace careen
