#include "physics/next_contact.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.h"
#include "physics/first_contact_search.h"
#include "physics/time_of_impact.h"
#include "physics/translating_contact.h"

namespace careen {
namespace {

// Searches on where a search ran out of evaluations.
template <class Search>
FirstContact searchUntil(double until, const Search& search) {
  FirstContact found;
  do {
    const double from = found.time;
    found = search(SearchWindow{.from = from, .until = until});
    if (found.kind == ContactKind::kNone && found.time < until && !(found.time > from)) {
      throw NumericalError("the search for the next impact does not come forward");
    }
  } while (found.kind == ContactKind::kNone && found.time < until);
  return found;
}

EventKind kindOf(const FirstContact& contact) {
  return contact.kind == ContactKind::kImpact ? EventKind::kContact : EventKind::kTouching;
}

// Nothing changes between two that move alike and do not turn: blocks that lie in a row.
bool moveAsOne(const Mover& a, const Mover& b) {
  return a.angularSpeedBound == 0 && b.angularSpeedBound == 0 &&
         a.flight.acceleration == b.flight.acceleration && a.flight.velocity == b.flight.velocity &&
         a.flight.acceleration.isZero(0);
}

}  // namespace

std::optional<Event> firstWall(const Mover& body, int rank, const std::vector<Wall>& walls,
                               const Instant& end) {
  const MovingBox box = body.moving(body.start);
  // The wall whose turn is likely first, so that the others need not be followed further than it.
  std::size_t likely = 0;
  double soonest = kNever;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const double clear = sphereClearUntil(box, walls[w].normal, walls[w].offset);
    if (clear > 0 && clear < soonest) {
      soonest = clear;
      likely = w;
    }
  }
  std::optional<Event> first;
  double until = body.elapsed(end);
  const auto meet = [&](std::size_t w) {
    const Wall& wall = walls[w];
    const FirstContact contact = body.angularSpeedBound == 0
                                     ? firstContactTranslating(box, wall.normal, wall.offset, until)
                                     : searchUntil(until, [&](const SearchWindow& window) {
                                         return firstContactWithWall(box, wall.normal, wall.offset, window);
                                       });
    if (contact.kind != ContactKind::kNone && (!first || contact.time < until)) {
      until = contact.time;
      first = {.time = instantAfter(body.start, contact.time),
               .kind = kindOf(contact),
               .body = rank,
               .partner = wallPartner(w)};
    }
  };
  for (std::size_t k = 0; k < walls.size(); ++k) {
    meet((likely + k) % walls.size());
  }
  return first;
}

namespace {

/// Bounds of a motion up to a moment.
struct MotionBounds {
  double speed = 0;                ///< [m/s]
  double acceleration = 0;         ///< [m/s²]
  double angularSpeed = 0;         ///< [rad/s]
  double angularAcceleration = 0;  ///< [rad/s²]
};

MotionBounds boundsOf(const Mover& body, double seconds) {
  if (body.flies) {
    const double pull = body.flight.acceleration.norm();
    return {body.flight.velocity.norm() + pull * seconds, pull, body.angularSpeedBound,
            body.angularAccelerationBound};
  }
  MotionBounds bounds;
  if (body.touches()) {
    const ContactStep& step = body.touchers->motions[body.place];
    for (std::size_t k = 1; k < step.position.size(); ++k) {
      const double first = static_cast<double>(k) / step.duration;
      const double second = first * static_cast<double>(k - 1) / step.duration;
      bounds.speed += first * step.position[k].norm();
      bounds.acceleration += second * step.position[k].norm();
      bounds.angularSpeed += 2 * first * step.worldFromBody[k].norm();
      bounds.angularAcceleration += 2 * second * step.worldFromBody[k].norm();
    }
    // Between its ends the quaternion's length is not quite 1.
    constexpr double kLength = 1 + 0x1p-6;
    bounds.angularSpeed *= kLength;
    bounds.angularAcceleration =
        kLength * (bounds.angularAcceleration + bounds.angularSpeed * bounds.angularSpeed);
  }
  return bounds;
}

double gapAt(const Mover& a, const Mover& b, const Instant& time) {
  const Pose poseA = a.stateAt(time).pose;
  const Pose poseB = b.stateAt(time).pose;
  return BoxAxes(poseA.worldFromBody, a.body->halfExtents, poseB.worldFromBody, b.body->halfExtents,
                 poseA.position - poseB.position)
      .gap();
}

/// As firstContactOfBoxes, for steps of Contact: time advances by what the gap allows at the largest speed
/// the two can have, or at the largest acceleration from the speed they do have.
std::optional<Event> firstMeetingInStep(const Mover& body, int rank, const Mover& other, int partner,
                                        const Instant& until) {
  const Instant zero = later(body.start, other.start);
  Instant last = until;
  for (const Mover* each : {&body, &other}) {
    if (each->touches() && earlier(each->touchers->end(), last)) {
      last = each->touchers->end();
    }
  }
  const double end = secondsBetween(zero, last);
  if (!(end > 0)) {
    return std::nullopt;
  }
  const double radiusA = body.body->halfExtents.norm();
  const double radiusB = other.body->halfExtents.norm();
  const MotionBounds a = boundsOf(body, body.elapsed(last));
  const MotionBounds b = boundsOf(other, other.elapsed(last));
  const double speed = a.speed + b.speed;
  const double closing = speed + a.angularSpeed * radiusA + b.angularSpeed * radiusB;
  const Vec3 bToA = body.positionAt(zero) - other.positionAt(zero);
  if (bToA.norm() > radiusA + radiusB + speed * end || closing <= 0) {
    return std::nullopt;
  }
  // Second derivative of a separation: see time_of_impact.h, with room for edges that cross at an angle.
  constexpr double kRoom = 2;
  const double turning = a.angularSpeed + b.angularSpeed;
  const double bending =
      kRoom * (a.acceleration + b.acceleration + 2 * turning * speed +
               (turning * turning + a.angularAcceleration + b.angularAcceleration) * 2 * (radiusA + radiusB));
  const double lengths =
      body.positionAt(zero).cwiseAbs().sum() + other.positionAt(zero).cwiseAbs().sum() + radiusA + radiusB;
  const double within = touchingWithin(std::min(radiusA, radiusB), lengths);
  constexpr int kMostEvaluations = 20'000;
  constexpr double kProbe = 0x1p10;  // of the tolerance: how far rates are taken over
  bool watching = false;
  double watch = 0;
  double t = 0;
  for (int k = 0; k < kMostEvaluations && t < end; ++k) {
    const double gap = gapAt(body, other, instantAfter(zero, t));
    if (gap > within) {
      watching = false;
      const double probe = kProbe * within / closing;
      const double rate = (gapAt(body, other, instantAfter(zero, t + probe)) - gap) / probe;
      // The root of gap + rate t − ½ bending t², in the form that adds.
      const double root = std::sqrt(rate * rate + 2 * bending * gap);
      const double bent = rate < 0      ? 2 * gap / (root - rate)
                          : bending > 0 ? (rate + root) / bending
                                        : gap / closing;
      t += std::max(bent, gap / closing);
      continue;
    }
    // In touch from the start: it may be parting.
    if ((!watching && t > 0) || gap < -2 * within) {
      return Event{.time = instantAfter(zero, t),
                   .kind = EventKind::kContact,
                   .body = rank,
                   .partner = partner,
                   .partnerMotion = other.motion};
    }
    watch = watching ? 2 * watch : within / closing;
    watching = true;
    t += watch;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Event> firstMeeting(const Mover& body, int rank, const Mover& other, int partner,
                                  const Instant& until) {
  if (body.touches() || other.touches()) {
    return firstMeetingInStep(body, rank, other, partner, until);
  }
  const Instant zero = later(body.start, other.start);
  const double end = secondsBetween(zero, until);
  if (!(end >= 0) || moveAsOne(body, other)) {
    return std::nullopt;
  }
  const FirstContact contact = searchUntil(end, [&](const SearchWindow& window) {
    return firstContactOfBoxes(body.moving(zero), other.moving(zero), window);
  });
  if (contact.kind == ContactKind::kNone) {
    return std::nullopt;
  }
  return Event{.time = instantAfter(zero, contact.time),
               .kind = kindOf(contact),
               .body = rank,
               .partner = partner,
               .partnerMotion = other.motion};
}

}  // namespace careen
