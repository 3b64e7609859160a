#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "physics/contact/island.h"
#include "physics/geometry/separation.h"

// Event functions: what ends a smooth motion of an island, and when.

namespace careen {
namespace {

using Mode = ContactForces::Mode;
using Kind = ContactFeature::Kind;

constexpr int kMostRefinements = 60;
/// [1] of a step: accuracy of a root.
constexpr double kRootWidth = 0x1p-50;
/// How far below zero an event is located: [1] of what counts as touching, for gaps; of the accelerations,
/// for forces.
constexpr double kRootGap = 0x1p-10;
constexpr double kRootForce = 0x1p-44;
/// A first estimate is good enough this near to zero, [1] of that depth, and of the value at the start; or
/// this near to the root, [1] of a step.
constexpr double kEstimateDepth = 0x1p12;
constexpr double kEstimateValue = 0x1p-6;
constexpr double kEstimateWidth = 0x1p-40;
/// [1] of that depth: values this small have too much rounding error to tell a slope.
constexpr double kNoisy = 16;
/// [1] of a step: event functions that seem to fall this close together are located together.
constexpr double kAtOnce = 0x1p-20;
/// Steps taken by the slope of the estimate; then the bracket decides.
constexpr int kMostByEstimate = 6;
constexpr double kShortestHop = 0x1p-30;
constexpr double kShortestStep = 0x1p-40;

}  // namespace

double Island::touching(std::size_t body) const {
  return touchingWithin(boxAt(system_.kinematics(body).pose, *bodies()[body].body));
}

void Island::listEventFunctions() {
  eventFunctions_.clear();
  const std::vector<ContactFeature>& features = system_.features();
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (!system_.pushes(c)) {
      eventFunctions_.push_back({.kind = EventFunction::Kind::kGap, .contact = c});
      continue;
    }
    eventFunctions_.push_back({.kind = EventFunction::Kind::kPush, .contact = c});
    if (system_.modes()[c] == Mode::kStick) {
      eventFunctions_.push_back({.kind = EventFunction::Kind::kStick, .contact = c});
    }
    if (features[c].kind != Kind::kPointOnWall) {
      eventFunctions_.push_back({.kind = EventFunction::Kind::kWithin, .contact = c});
    }
  }
  for (std::size_t c = 0; c < features.size(); ++c) {
    const bool first = std::none_of(features.begin(), features.begin() + static_cast<std::ptrdiff_t>(c),
                                    [&](const ContactFeature& other) {
                                      return (other.a == features[c].a && other.b == features[c].b) ||
                                             (features[c].b.isBody(other.a) && other.b.isBody(features[c].a));
                                    });
    if (features[c].kind != Kind::kPointOnWall && first) {
      eventFunctions_.push_back({.kind = EventFunction::Kind::kOverlap, .contact = c});
    }
  }
  for (std::size_t i = 0; i < bodies().size(); ++i) {
    for (std::size_t w = 0; w < (bodies()[i].isHeld() ? 0 : world_.walls.size()); ++w) {
      for (int k = 0; k < kCorners; ++k) {
        const Vec3 at = corner(*bodies()[i].body, k);
        if (!hasCorner(features, static_cast<int>(i), Partner::ofWall(w), at)) {
          eventFunctions_.push_back(
              {.kind = EventFunction::Kind::kCorner, .contact = i, .wall = static_cast<int>(w), .corner = k});
        }
      }
    }
  }
}

void Island::noteStart() {
  atStart_.clear();
  for (EventFunction& event : eventFunctions_) {
    event.margin = 0;
    const double bare = value(event);
    if (EventFunction::isOfPlaces(event.kind)) {
      event.margin = marginOf(event, bare);
    }
    atStart_.push_back(bare + event.margin);
    event.rate = event.kind == EventFunction::Kind::kCorner ? rateOf(event) : 0;
  }
}

// [m] Penetration that is ignored, given the gap at the start of the step.
double Island::marginOf(const EventFunction& event, double gap) const {
  if (event.kind == EventFunction::Kind::kCorner) {
    // A corner that touches but is no contact is separating: rounding error must not count as an impact.
    const double within = touching(event.contact);
    return gap > within ? 0 : kTouching * within;
  }
  const ContactFeature& feature = system_.features()[event.contact];
  return kTouching * std::max(touching(static_cast<std::size_t>(feature.a)),
                              touching(static_cast<std::size_t>(feature.b.body())));
}

// Ends the step where the first event function falls below zero. The one that seems to fall first is located
// first, so that the order of listing decides nothing, together with those that seem to fall at once with it,
// as at the two ends of an edge; functions checked at the former end may be negative at the new one, hence
// several passes.
void Island::locate(Step& step) {
  const double shortest = kShortestStep * step.length;  // for events at the very start
  std::vector<char> located(eventFunctions_.size(), 0);
  for (;;) {
    std::vector<Fall> falls;
    for (std::size_t w = 0; w < eventFunctions_.size(); ++w) {
      if (const std::optional<Fall> fall = located[w] == 0 ? fallOf(w, step.length) : std::nullopt) {
        falls.push_back(*fall);
      }
    }
    if (falls.empty()) {
      return;
    }
    const Fall first = firstOf(falls);
    for (const std::size_t event : first.events) {
      located[event] = 1;
    }
    step.length = std::min(step.length, std::max(shortest, rootWithin(first, step.length)));
    step.end = End::kChanges;
    restep(step.length);
  }
}

Island::Fall Island::firstOf(std::span<const Fall> falls) {
  Fall first = *std::min_element(falls.begin(), falls.end(), [](const Fall& x, const Fall& y) {
    return std::pair(x.estimate, x.kind) < std::pair(y.estimate, y.kind);
  });
  const double within = first.estimate + kAtOnce * first.until;
  first.events.clear();
  for (const Fall& fall : falls) {
    if (fall.kind == first.kind && fall.until == first.until && fall.estimate <= within) {
      first.events.push_back(fall.events.front());
      first.atStart = std::min(first.atStart, fall.atStart);
      first.value = std::min(first.value, fall.value);
    }
  }
  return first;
}

// Whether an event function falls below zero within a step of that length, which is the last one taken.
std::optional<Island::Fall> Island::fallOf(std::size_t event, double length) {
  Fall fall{.events = {event},
            .kind = eventFunctions_[event].kind,
            .until = length,
            .atStart = atStart_[event],
            .value = value(eventFunctions_[event])};
  if (const double lowest = lowestWithin(length, event, fall.value); lowest > 0) {
    restep(lowest);
    const double there = value(eventFunctions_[event]);
    restep(length);
    if (there < 0) {
      fall.until = lowest;
      fall.value = there;
    }
  }
  if (!(fall.value < 0 && (fall.atStart >= 0 || fall.value < 2 * fall.atStart))) {
    return std::nullopt;
  }
  fall.estimate = fall.atStart > 0 ? fall.until * (fall.atStart / (fall.atStart - fall.value)) : 0;
  return fall;
}

bool Island::handlesPair(std::size_t a, std::size_t b) const {
  if (tookTimeStep_) {
    return true;
  }
  const std::vector<ContactFeature>& features = system_.features();
  const auto isBetween = [&](std::size_t c) {
    const auto first = static_cast<std::size_t>(features[c].a);
    const auto second = static_cast<std::size_t>(features[c].b.body());
    return (first == a && second == b) || (first == b && second == a);
  };
  for (std::size_t c = 0; c < features.size(); ++c) {
    if (!features[c].b.isWall() && isBetween(c) && system_.pushes(c)) {
      return true;
    }
  }
  const double within = kTouching * std::max(touching(a), touching(b));
  for (std::size_t w = 0; w < eventFunctions_.size(); ++w) {
    if (eventFunctions_[w].kind == EventFunction::Kind::kOverlap && isBetween(eventFunctions_[w].contact) &&
        atStart_[w] - eventFunctions_[w].margin <= within) {
      return true;
    }
  }
  return false;
}

double Island::value(const EventFunction& event) const {
  const std::size_t c = event.contact;
  const ContactForces& forces = system_.forces();
  switch (event.kind) {
    case EventFunction::Kind::kPush:
      return forces.forces()[c][0] / forces.normalMass(c);
    case EventFunction::Kind::kStick: {
      const ContactForces::Force& force = forces.forces()[c];
      return (system_.features()[c].material.friction * force[0] -
              std::sqrt(force[1] * force[1] + force[2] * force[2])) /
             forces.normalMass(c);
    }
    case EventFunction::Kind::kGap:
      return system_.states()[c].gap +
             kTouching * touching(static_cast<std::size_t>(system_.features()[c].a));
    case EventFunction::Kind::kWithin:
      return kTouching * touching(static_cast<std::size_t>(system_.features()[c].a)) -
             system_.states()[c].beyond;
    case EventFunction::Kind::kOverlap: {
      const ContactFeature& feature = system_.features()[c];
      const auto a = static_cast<std::size_t>(feature.a);
      const auto b = static_cast<std::size_t>(feature.b.body());
      return BoxAxes(boxAt(system_.kinematics(a).pose, *bodies()[a].body),
                     boxAt(system_.kinematics(b).pose, *bodies()[b].body))
                 .gap() +
             event.margin;
    }
    case EventFunction::Kind::kCorner: {
      const Wall& wall = world_.walls[static_cast<std::size_t>(event.wall)];
      return cornerGap(system_.kinematics(c).pose, corner(*bodies()[c].body, event.corner), wall.normal,
                       wall.offset) +
             event.margin;
    }
  }
  return 0;
}

// How far below zero an event function is located, at most four times that: a part of what the contacts count
// as zero anyway, above rounding errors.
double Island::depthOf(const Fall& fall) const {
  if (EventFunction::isOfForces(fall.kind)) {
    return kRootForce * system_.forces().scale();
  }
  double within = 0;
  for (const std::size_t event : fall.events) {
    const std::size_t c = eventFunctions_[event].contact;
    within = std::max(within, touching(fall.kind == EventFunction::Kind::kCorner
                                           ? c
                                           : static_cast<std::size_t>(system_.features()[c].a)));
  }
  return kRootGap * within;
}

double Island::valueOf(const Fall& fall) const {
  double lowest = std::numeric_limits<double>::infinity();
  for (const std::size_t event : fall.events) {
    lowest = std::min(lowest, value(eventFunctions_[event]));
  }
  return lowest;
}

// Just after a separation the event function is positive in between.
FallingBracket Island::bracketOf(const Fall& fall) {
  FallingBracket bracket{.high = fall.until, .valueLow = fall.atStart, .valueHigh = fall.value};
  for (double part = 0.5; !(bracket.valueLow > 0) && part >= kShortestHop; part /= 2) {
    const double at = part * fall.until;
    restep(at);
    const double there = valueOf(fall);
    if (there > 0) {
      bracket.low = at;
      bracket.valueLow = there;
    } else {
      bracket.high = at;
      bracket.valueHigh = there < 0 ? there : bracket.valueHigh;
    }
  }
  return bracket;
}

// The first estimate of a root, on the polynomials of the step, and how fast the event function falls there.
Island::Estimate Island::estimateOf(const Fall& fall, FallingBracket bracket,
                                    std::span<const ContactStep> path) {
  const double least = kEstimateWidth * bracket.high;
  const double valueLow = bracket.valueLow;
  Estimate estimate{.time = bracket.low, .value = bracket.valueLow};
  State rate;
  while (bracket.width() > least) {
    const double at = bracket.next(least);
    const State between = stateWithin(path, at);
    if (EventFunction::isOfForces(fall.kind)) {
      system_.rate(between, rate);
    } else {
      system_.look(between);
    }
    const double there = valueOf(fall);
    bracket.add(at, there);
    estimate = {.time = at, .value = there, .slope = (there - estimate.value) / (at - estimate.time)};
    if (std::fabs(there) <= std::min(kEstimateDepth * depthOf(fall), kEstimateValue * valueLow)) {
      break;
    }
  }
  return estimate;
}

// Time where the event function falls to zero: the end of the bracket where it is negative. Each look at it
// costs a whole step from the start, a look at the step's polynomials hardly anything.
double Island::rootWithin(const Fall& fall, double length) {
  const std::vector<ContactStep> path = motions(length);
  FallingBracket bracket = bracketOf(fall);
  if (!(bracket.valueLow > 0)) {
    return bracket.high;
  }
  const double least = kRootWidth * fall.until;
  Estimate at = estimateOf(fall, bracket, path);
  for (int k = 0; k < kMostRefinements && bracket.width() > least; ++k) {
    const double aim = at.value + depthOf(fall);
    double next = bracket.next(least);
    if (k < kMostByEstimate && std::fabs(aim) < -at.slope * bracket.width()) {
      const double estimate = at.time - aim / at.slope;
      next = estimate > bracket.low && estimate < bracket.high ? estimate : next;
    }
    restep(next);
    const double there = valueOf(fall);
    if (k > 0 && std::fabs(there) > kNoisy * depthOf(fall)) {
      at.slope = (there - at.value) / (next - at.time);
    }
    at.time = next;
    at.value = there;
    bracket.add(next, there);
    if (at.value < 0 && at.value >= -4 * depthOf(fall)) {
      break;
    }
  }
  return bracket.high;
}

}  // namespace careen
