#include "physics/impact/impact_law.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "physics/geometry/separating_axes.h"
#include "physics/impact/simultaneous_impact.h"
#include "physics/solver/taking_part.h"

namespace careen {
namespace {

// [m/s] Of a relative to b at a contact.
struct AtContact {
  Vec3 velocity = Vec3::Zero();
  double speeds = 0;  // of which it is the difference
};

AtContact at(const ImpactContact& contact, std::span<const ImpactBody> bodies) {
  AtContact found;
  const auto add = [&](int index, const Vec3& arm, double sign) {
    const ImpactBody& body = bodies[static_cast<std::size_t>(index)];
    const Vec3 spin = angularVelocity(*body.mass, *body.state);
    found.velocity += sign * (body.state->velocity + spin.cross(arm));
    found.speeds += body.state->velocity.norm() + spin.norm() * arm.norm();
  };
  add(contact.a, contact.armA, 1);
  add(contact.b, contact.armB, -1);
  return found;
}

/// An impact of which some contacts have a choice of directions.
class ImpactWithChoice {
 public:
  ImpactWithChoice(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts,
                   ImpactAccuracy accuracy)
      : bodies_(bodies), contacts_(contacts.begin(), contacts.end()), accuracy_(accuracy) {
    for (const ImpactBody& body : bodies) {
      before_.push_back(*body.state);
    }
    for (const ImpactContact& contact : contacts) {
      takes_.push_back(contact.directions.empty() ? 1 : 0);
      const AtContact now = at(contact, bodies);
      rounding_ = std::max(rounding_, kApproachRounding * now.speeds);
      approach_.push_back(-dot(contact.normal, now.velocity));
    }
  }

  ContactResiduals resolve(std::span<ImpactShare> shares) {
    ContactResiduals residuals;
    std::vector<ImpactShare> found;
    solveWithTakingPart(
        takes_,
        [&](const std::vector<char>& takes) {
          residuals.add(resolveSome(takes, found));
          return true;
        },
        [&](std::size_t c) { return enters(c); });
    for (std::size_t c = 0, next = 0; c < contacts_.size(); ++c) {
      shares[c] = takes_[c] != 0 ? found[next++]
                                 : ImpactShare{.approach = approach_[c], .normal = contacts_[c].normal};
    }
    return residuals;
  }

 private:
  ContactResiduals resolveSome(const std::vector<char>& takes, std::vector<ImpactShare>& found) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      *bodies_[i].state = before_[i];
    }
    std::vector<ImpactContact> some;
    for (std::size_t c = 0; c < takes.size(); ++c) {
      if (takes[c] != 0) {
        some.push_back(contacts_[c]);
      }
    }
    found.assign(some.size(), {});
    return some.empty() ? ContactResiduals{} : resolveTogether(bodies_, some, found, accuracy_);
  }

  /// One that enters no faster than what the others were solved to has the direction in which it does so the
  /// slowest as its normal: the centre of the cone would make a kick of it.
  bool enters(std::size_t c) {
    ImpactContact& contact = contacts_[c];
    const Vec3 velocity = at(contact, bodies_).velocity;
    const double closing = -partingSpeed(contact.directions, velocity);
    if (!(closing > rounding_)) {
      return false;
    }
    if (closing <= std::max(accuracy_.enough, accuracy_.tolerable)) {
      contact.normal = *std::max_element(
          contact.directions.begin(), contact.directions.end(),
          [&](const Vec3& x, const Vec3& y) { return dot(x, velocity) < dot(y, velocity); });
    }
    return true;
  }

  std::span<const ImpactBody> bodies_;
  std::vector<BodyState> before_;
  std::vector<ImpactContact> contacts_;
  std::vector<char> takes_;
  std::vector<double> approach_;  // [m/s] along the centres, before
  ImpactAccuracy accuracy_;
  double rounding_ = 0;  // [m/s]
};

}  // namespace

ContactResiduals resolveImpact(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts,
                               std::span<ImpactShare> shares, ImpactAccuracy accuracy) {
  const bool isChoice = std::any_of(contacts.begin(), contacts.end(),
                                    [](const ImpactContact& contact) { return !contact.directions.empty(); });
  return isChoice ? ImpactWithChoice(bodies, contacts, accuracy).resolve(shares)
                  : resolveTogether(bodies, contacts, shares, accuracy);
}

}  // namespace careen
