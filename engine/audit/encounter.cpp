#include "audit/encounter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "audit/flown.h"
#include "audit/overlap.h"

namespace careen {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kFlightLooks = 24;  // between two rows
constexpr int kHalvings = 48;
constexpr double kFlat = 1e-9;     // [1] of half the diagonal: corners that differ by less touch at once
constexpr double kAligned = 1e-6;  // 1 − cosine of directions that are the same
constexpr double kMostTurn = 0.5;  // [rad] from row to row, for slip to keep its direction
constexpr double kSameWay = 0.5;   // least cosine of the slips' angle
constexpr double kMeetAgain = 1.0 / 16;  // [1] of what counts as near: both flights meet within it

BodyState flownOf(const Body* body, const BodyState& from, const ObservedEncounter& encounter,
                  double seconds) {
  return body != nullptr ? flown(body->mass, from, encounter.gravity, seconds) : from;
}

double coefficientOf(const ObservedEncounter& encounter) {
  return touching(encounter.body->material,
                  encounter.wall != nullptr ? encounter.wall->material : encounter.other->material)
      .friction;
}

double restitutionOf(const ObservedEncounter& encounter) {
  return touching(encounter.body->material,
                  encounter.wall != nullptr ? encounter.wall->material : encounter.other->material)
      .restitution;
}

std::array<Vec3, kCorners> cornersOf(const AuditBox& box) {
  std::array<Vec3, kCorners> corners;
  for (int k = 0; k < kCorners; ++k) {
    corners.at(static_cast<std::size_t>(k)) =
        box.pose.position + box.pose.worldFromBody * corner(box.halfExtents, k);
  }
  return corners;
}

// The direction from b to a along which they are farthest apart; none if another is as good.
std::optional<Vec3> normalOf(const AuditBox& a, const AuditBox& b, double near) {
  struct Axis {
    Vec3 direction;
    double gap;
  };
  std::vector<Axis> axes;
  const Vec3 between = a.pose.position - b.pose.position;
  forEachAxis(a, b, [&](const Vec3& axis) {
    const Vec3 direction = between.dot(axis) < 0 ? Vec3(-axis) : axis;
    axes.push_back({direction, between.dot(direction) - reachAlong(a, axis) - reachAlong(b, axis)});
  });
  const auto best =
      std::max_element(axes.begin(), axes.end(), [](const Axis& x, const Axis& y) { return x.gap < y.gap; });
  const bool isOnly = std::all_of(axes.begin(), axes.end(), [&](const Axis& axis) {
    return axis.gap < best->gap - 2 * near || axis.direction.dot(best->direction) > 1 - kAligned;
  });
  return isOnly ? std::optional(best->direction) : std::nullopt;
}

// [m/s] No point is faster.
double speedOf(const ObservedEncounter& encounter, const BodyState& body, const BodyState& other) {
  const auto fastest = [](const Body& each, const BodyState& state) {
    return isImmovable(each.mass)
               ? 0.0
               : state.velocity.norm() + radiusOf(each) * angularVelocity(each.mass, state).norm();
  };
  return fastest(*encounter.body, body) +
         (encounter.other != nullptr ? fastest(*encounter.other, other) : 0.0);
}

// [m/s] How far the speeds of points may be off.
double doubtOf(const ObservedEncounter& encounter, const BodyState& body, const BodyState& other) {
  return encounter.part * speedOf(encounter, body, other) + encounter.doubt;
}

// [1/kg] Velocity of the point that an impulse of 1 N s in this direction gives.
Vec3 answerAt(const ObservedEncounter& encounter, const BodyState& body, const BodyState& other,
              const Vec3& direction, const Vec3& place) {
  Vec3 answer = Vec3::Zero();
  const auto add = [&](const Body& each, const BodyState& state) {
    const Mat3 inverse = inverseInertiaWorld(each.mass, state.pose.worldFromBody);
    const Vec3 arm = place - state.pose.position;
    answer += each.mass.inverseMass * direction + (inverse * arm.cross(direction)).cross(arm);
  };
  add(*encounter.body, body);
  if (encounter.other != nullptr) {
    add(*encounter.other, other);
  }
  return answer;
}

// [1/kg] Largest speed along the normal that an impulse along it gives, with what friction may add.
double inverseMassAt(const ObservedEncounter& encounter, const BodyState& body, const BodyState& other,
                     const Touch& touch, const Vec3& place) {
  const Vec3 answer = answerAt(encounter, body, other, touch.normal, place);
  const double along = answer.dot(touch.normal);
  return along + coefficientOf(encounter) * (answer - along * touch.normal).norm();
}

double energyOf(const ObservedEncounter& encounter, const BodyState& body, const BodyState& other) {
  const auto of = [&](const Body& each, const BodyState& state) {
    return kineticEnergy(each.mass, state) - each.mass.mass * encounter.gravity.dot(state.pose.position);
  };
  return of(*encounter.body, body) + (encounter.other != nullptr ? of(*encounter.other, other) : 0);
}

}  // namespace

double gapOf(const ObservedEncounter& encounter, const BodyState& body, const BodyState& other) {
  return encounter.wall != nullptr ? separationOf(*encounter.body, body.pose, planeAt(*encounter.wall, 0))
                                   : separationOf(*encounter.body, body.pose, *encounter.other, other.pose);
}

std::optional<Touch> touchOf(const ObservedEncounter& encounter, const BodyState& body,
                             const BodyState& other) {
  const std::vector<AuditBox> boxes = auditBoxes(*encounter.body, body.pose);
  const AuditBox& box = boxes.front();
  Touch touch;
  const auto take = [&](std::span<const AuditBox> of, double sign, double plane) {
    std::vector<Touch::Point> points;
    for (const AuditBox& from : of) {
      for (const Vec3& place : cornersOf(from)) {
        points.push_back({.place = place, .gap = sign * (touch.normal.dot(place) - plane)});
      }
    }
    return points;
  };
  const auto least = [](const std::vector<Touch::Point>& points) {
    double gap = kInfinite;
    for (const Touch::Point& point : points) {
      gap = std::min(gap, point.gap);
    }
    return gap;
  };
  const auto nearOnes = [&](const std::vector<Touch::Point>& points) {
    const double nearest = least(points);
    return std::count_if(points.begin(), points.end(),
                         [&](const Touch::Point& point) { return point.gap <= nearest + encounter.near; });
  };
  if (encounter.wall != nullptr) {
    touch.normal = encounter.wall->normal;
    touch.points = take(boxes, 1, encounter.wall->offset);
  } else {
    const std::vector<AuditBox> others = auditBoxes(*encounter.other, other.pose);
    if (boxes.size() > 1 || others.size() > 1) {
      return std::nullopt;  // they may touch in several places
    }
    const AuditBox& second = others.front();
    const std::optional<Vec3> normal = normalOf(box, second, encounter.near);
    if (!normal) {
      return std::nullopt;
    }
    touch.normal = *normal;
    const auto reach = [&](const AuditBox& of) {
      return (of.pose.worldFromBody.transpose() * touch.normal).cwiseAbs().dot(of.halfExtents);
    };
    std::vector<Touch::Point> own =
        take({&box, 1}, 1, touch.normal.dot(second.pose.position) + reach(second));
    std::vector<Touch::Point> ofOther =
        take({&second, 1}, -1, touch.normal.dot(box.pose.position) - reach(box));
    const auto sizeOf = [](const AuditBox& of) { return of.halfExtents.norm(); };
    const bool isOwn = nearOnes(own) < nearOnes(ofOther) ||
                       (nearOnes(own) == nearOnes(ofOther) && sizeOf(box) <= sizeOf(second));
    touch.points = isOwn ? std::move(own) : std::move(ofOther);
  }
  touch.gap = least(touch.points);
  return touch;
}

Vec3 approachAt(const ObservedEncounter& encounter, const BodyState& body, const BodyState& other,
                const Vec3& place) {
  return velocityAt(encounter.body->mass, body, place) -
         (encounter.other != nullptr ? velocityAt(encounter.other->mass, other, place) : Vec3(Vec3::Zero()));
}

Vec3 impulseOf(const ObservedEncounter& encounter) {
  return encounter.passed +
         encounter.body->mass.mass *
             (encounter.after.velocity - encounter.before.velocity - encounter.seconds * encounter.gravity);
}

double leastDistance(std::span<const ObservedEncounter> encounters) {
  std::array<double, kFlightLooks + 1> first{};
  std::array<double, kFlightLooks + 1> last{};
  const ObservedEncounter& any = encounters.front();
  const double step = any.seconds / kFlightLooks;
  const auto gapAt = [&](const BodyState& body) {
    double gap = kInfinite;
    for (const ObservedEncounter& encounter : encounters) {
      gap = std::min(gap, gapOf(encounter, body, encounter.otherBefore));
    }
    return gap;
  };
  if (gapAt(any.before) <= any.near && gapAt(any.after) <= any.near) {
    return any.near;
  }
  BodyState forward = any.before;
  BodyState backward = any.after;
  for (std::size_t k = 0; k <= kFlightLooks; ++k) {
    first.at(k) = std::min(gapAt(forward), k > 0 ? first.at(k - 1) : kInfinite);
    last.at(kFlightLooks - k) = std::min(gapAt(backward), k > 0 ? last.at(kFlightLooks - k + 1) : kInfinite);
    forward = flownOf(any.body, forward, any, step);
    backward = flownOf(any.body, backward, any, -step);
  }
  double least = kInfinite;
  for (std::size_t k = 0; k <= kFlightLooks; ++k) {
    // It may have touched first, and last, between the same two looks.
    least = std::min(least, std::max(first.at(k), last.at(k > 0 ? k - 1 : 0)));
  }
  return least;
}

namespace {

/// The first time that both touch, as they fly from their first rows.
struct Meeting {
  double time = 0;  // [s] from the first row
  BodyState body;
  BodyState other;
};

std::optional<Meeting> meetingOf(const ObservedEncounter& encounter) {
  const auto at = [&](double time) {
    return Meeting{.time = time,
                   .body = flownOf(encounter.body, encounter.before, encounter, time),
                   .other = flownOf(encounter.other, encounter.otherBefore, encounter, time)};
  };
  const auto gapAt = [&](double time) {
    const Meeting meeting = at(time);
    return gapOf(encounter, meeting.body, meeting.other);
  };
  if (gapAt(0) <= encounter.near) {
    return std::nullopt;  // they may have touched before
  }
  double apart = 0;
  double touched = -1;
  for (int k = 1; k <= kFlightLooks && touched < 0; ++k) {
    const double time = encounter.seconds * k / kFlightLooks;
    (gapAt(time) > 0 ? apart : touched) = time;
  }
  if (touched < 0) {
    return std::nullopt;
  }
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (apart + touched);
    (gapAt(middle) > 0 ? apart : touched) = middle;
  }
  return at(touched);
}

/// Least and largest.
struct Range {
  double low = kInfinite;
  double high = -kInfinite;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// What of a restitution the rows allow.
struct Allowed {
  double low = 0;
  double high = 1;
};

bool meetAgain(const Body* body, const BodyState& x, const BodyState& y, double within) {
  return body == nullptr ||
         ((x.pose.position - y.pose.position).norm() +
              radiusOf(*body) * turnBetween(x.pose.worldFromBody, y.pose.worldFromBody).norm() <=
          within);
}

// If both fly on to their second rows after one impact.
void allowByParting(const ObservedEncounter& encounter, const Meeting& meeting, const Touch& touch,
                    const std::vector<Vec3>& places, Range approach, double doubt, Allowed& allowed) {
  const double left = encounter.seconds - meeting.time;
  const BodyState body = flownOf(encounter.body, encounter.after, encounter, -left);
  const BodyState other = flownOf(encounter.other, encounter.otherAfter, encounter, -left);
  const double within = kMeetAgain * encounter.near;
  if (!meetAgain(encounter.body, body, meeting.body, within) ||
      !meetAgain(encounter.other, other, meeting.other, within)) {
    return;
  }
  double off = std::max(doubt, doubtOf(encounter, body, other));
  if (gapOf(encounter, encounter.after, encounter.otherAfter) <= encounter.near) {
    // It may have stayed: forces since then.
    const double spin = angularVelocity(encounter.body->mass, body).norm();
    off += 2 * left * (encounter.gravity.norm() + spin * spin * radiusOf(*encounter.body));
  }
  Range parting;
  for (const Vec3& place : places) {
    parting.add(approachAt(encounter, body, other, place).dot(touch.normal));
  }
  allowed.low = std::max(allowed.low, (parting.low - off) / (approach.high + off));
  if (approach.low > off) {
    allowed.high = std::min(allowed.high, std::max(0.0, (parting.high + off) / (approach.low - off)));
  }
}

}  // namespace

double restitutionBeyond(const ObservedEncounter& encounter) {
  const std::optional<Meeting> meeting = meetingOf(encounter);
  const std::optional<Touch> touch =
      meeting ? touchOf(encounter, meeting->body, meeting->other) : std::nullopt;
  if (!touch) {
    return 0;
  }
  const double size = encounter.body->halfExtents.norm();
  std::vector<Vec3> places;
  Range approach;
  double inverseMass = 0;
  for (const Touch::Point& point : touch->points) {
    if (point.gap <= touch->gap + kFlat * size) {
      places.push_back(point.place);
      approach.add(-approachAt(encounter, meeting->body, meeting->other, point.place).dot(touch->normal));
      inverseMass =
          std::max(inverseMass, inverseMassAt(encounter, meeting->body, meeting->other, *touch, point.place));
    } else if (point.gap <= touch->gap + encounter.near) {
      return 0;  // it touches next, and this before the impact of the first tells anything
    }
  }
  const double doubt = doubtOf(encounter, meeting->body, meeting->other);
  const double least = approach.low - doubt;
  if (least <= doubt) {
    return 0;
  }
  Allowed allowed;
  allowByParting(encounter, *meeting, *touch, places, approach, doubt, allowed);
  allowed.high =
      std::min(allowed.high,
               std::max(0.0, (impulseOf(encounter).dot(touch->normal) * inverseMass + doubt) / least - 1));
  const double lost = energyOf(encounter, encounter.before, encounter.otherBefore) -
                      energyOf(encounter, encounter.after, encounter.otherAfter) +
                      encounter.body->mass.mass * doubt * (approach.high + doubt);
  const double part = 2 * lost * inverseMass / (least * least);
  allowed.low = std::max(allowed.low, part < 1 ? std::sqrt(1 - std::max(part, 0.0)) : 0.0);
  const double restitution = restitutionOf(encounter);
  return std::max({allowed.low - restitution, restitution - allowed.high, 0.0});
}

std::optional<Friction> frictionOf(const ObservedEncounter& encounter) {
  const std::optional<Touch> first = touchOf(encounter, encounter.before, encounter.otherBefore);
  const std::optional<Touch> second = touchOf(encounter, encounter.after, encounter.otherAfter);
  const auto spinOf = [&](const Body* body, const BodyState& state) {
    return body == nullptr || isImmovable(body->mass) ? 0.0 : angularVelocity(body->mass, state).norm();
  };
  const double spin =
      std::max(spinOf(encounter.body, encounter.before) + spinOf(encounter.other, encounter.otherBefore),
               spinOf(encounter.body, encounter.after) + spinOf(encounter.other, encounter.otherAfter));
  const double turn = spin * encounter.seconds;
  if (!first || !second || turn > kMostTurn ||
      first->normal.dot(second->normal) < std::cos(turn) - kAligned) {
    return std::nullopt;
  }
  // Boxes apart may meet along another normal.
  if (encounter.wall == nullptr && std::max(first->gap, second->gap) > encounter.near) {
    return std::nullopt;
  }
  const Vec3& normal = first->normal;
  const Vec3 impulse = impulseOf(encounter);
  const double pushed = std::max(impulse.dot(normal), 0.0);
  const double most = coefficientOf(encounter) * pushed;
  Friction friction;
  friction.surplus =
      (impulse - pushed * normal).norm() - most - (encounter.wall == nullptr ? turn : 0) * impulse.norm();
  std::vector<Vec3> slips;
  std::vector<Vec3> places;
  double doubt = 0;
  const auto add = [&](const Touch& touch, const BodyState& body, const BodyState& other) {
    // What turns meanwhile turns the slip.
    doubt = std::max(doubt, doubtOf(encounter, body, other) + turn * speedOf(encounter, body, other));
    for (const Touch::Point& point : touch.points) {
      const Vec3 velocity = approachAt(encounter, body, other, point.place);
      const double speed =
          std::fabs(velocity.dot(normal)) +
          encounter.seconds * (encounter.gravity.norm() + spin * spin * radiusOf(*encounter.body));
      if (point.gap <= encounter.near + speed * encounter.seconds) {
        slips.emplace_back(velocity - velocity.dot(normal) * normal);
        places.push_back(point.place);
      }
    }
  };
  add(*first, encounter.before, encounter.otherBefore);
  add(*second, encounter.after, encounter.otherAfter);
  Vec3 way = Vec3::Zero();
  for (const Vec3& slip : slips) {
    way += slip;
  }
  way = way.isZero(0) ? way : way.normalized();
  double cosine = 1;
  for (const Vec3& slip : slips) {
    cosine = slip.dot(way) > doubt ? std::min(cosine, slip.dot(way) / slip.norm()) : 0;
  }
  if (cosine < kSameWay || slips.empty()) {
    return friction;
  }
  const double missing = impulse.dot(way) + std::max(std::cos(std::acos(cosine) + turn), 0.0) * most;
  // Had it acted, would all slip yet? Else it may have stuck within an impact.
  for (std::size_t k = 0; k < slips.size(); ++k) {
    const double slower = std::max(missing, 0.0) *
                          answerAt(encounter, encounter.after, encounter.otherAfter, way, places[k]).dot(way);
    if (slips[k].dot(way) <= doubt + slower) {
      return friction;
    }
  }
  friction.missing = missing;
  return friction;
}

}  // namespace careen
