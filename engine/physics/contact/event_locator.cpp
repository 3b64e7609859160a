#include "physics/contact/event_locator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "physics/contact/dips.h"
#include "physics/geometry/separation.h"

namespace careen {
namespace {

constexpr int kMostRefinements = 60;
/// [1] of a step: accuracy of a root.
constexpr double kRootWidth = 0x1p-50;
/// A first estimate is good enough this near to zero, [1] of the depth at which it is located, and of the
/// value at the start; or this near to the root, [1] of a step.
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

// The one that seems to fall first is located first, so that the order of listing decides nothing, together
// with those that seem to fall at once with it, as at the two ends of an edge; functions checked at the
// former end may be negative at the new one, hence several passes.
bool EventLocator::locate() {
  dips_.clear();
  const double shortest = kShortestStep * step_.length();  // for events at the very start
  std::vector<char> located(events_.all().size(), 0);
  for (bool any = false;; any = true) {
    std::vector<Fall> falls;
    for (std::size_t w = 0; w < located.size(); ++w) {
      if (const std::optional<Fall> fall = located[w] == 0 ? fallOf(w) : std::nullopt) {
        falls.push_back(*fall);
      }
    }
    if (falls.empty()) {
      return any;
    }
    const Fall first = firstOf(falls);
    for (const std::size_t event : first.events) {
      located[event] = 1;
    }
    const double length = step_.length();
    step_.retake(std::min(length, std::max(shortest, rootOf(first))));
  }
}

EventLocator::Fall EventLocator::firstOf(std::span<const Fall> falls) {
  Fall first = *std::min_element(falls.begin(), falls.end(), [](const Fall& x, const Fall& y) {
    return std::pair(x.estimate, x.kind) < std::pair(y.estimate, y.kind);
  });
  const double within = first.estimate + kAtOnce * first.until;
  first.events.clear();
  for (const Fall& fall : falls) {
    if (fall.kind == first.kind && fall.until == first.until && fall.estimate <= within) {
      first.events.push_back(fall.events.front());
      first.start = std::min(first.start, fall.start);
      first.value = std::min(first.value, fall.value);
    }
  }
  return first;
}

// Whether an event function falls below zero within the step.
std::optional<EventLocator::Fall> EventLocator::fallOf(std::size_t event) {
  const double length = step_.length();
  Fall fall{.events = {event},
            .kind = events_[event].kind,
            .until = length,
            .start = events_[event].start,
            .value = events_.value(event)};
  if (const double lowest = lowestWithin(event, fall.value); lowest > 0) {
    step_.retake(lowest);
    const double there = events_.value(event);
    step_.retake(length);
    if (there < 0) {
      fall.until = lowest;
      fall.value = there;
    }
  }
  if (!(fall.value < 0 && (fall.start >= 0 || fall.value < 2 * fall.start))) {
    return std::nullopt;
  }
  fall.estimate = fall.start > 0 ? fall.until * (fall.start / (fall.start - fall.value)) : 0;
  return fall;
}

// Time within the step of a possible penetration that is gone at its end; else 0.
double EventLocator::lowestWithin(std::size_t event, double atEnd) {
  const EventFunction& function = events_[event];
  if (atEnd >= 0 && function.kind == EventFunction::Kind::kOverlap) {
    return dipOf(event);
  }
  const ContactFeature* const end = events_.endOf(function);
  if (end != nullptr) {
    return atEnd >= 0 && function.start >= 0 && system_.stateOf(*end).rate > 0
               ? lowestOfEnd(*end, atEnd - system_.stateOf(*end).gap)
               : 0;
  }
  if (atEnd >= 0 && function.hasRate() && function.start >= 0) {
    return lowestOfCubic(step_.length(), function.start, function.rate, atEnd, events_.rateOf(function));
  }
  return 0;
}

// Of an open end of a joint, whose gap rises at the end of the step: it is no cubic, where a spring swings
// it. `margin` [m] is added to it.
double EventLocator::lowestOfEnd(const ContactFeature& end, double margin) const {
  const auto motionOf = [&](int index, double time) {
    const auto i = static_cast<std::size_t>(index);
    const TouchingBody& body = system_.bodies()[i];
    return body.isHeld() ? system_.kinematics(i)
                         : Kinematics{.pose = stateAt(Motion(step_.motion(i)), body.body->mass, time).pose};
  };
  const auto shapeAt = [&](int index, int box) {
    return system_.bodies()[static_cast<std::size_t>(index)].shape(box);
  };
  const auto valueAt = [&](double time) {
    const ContactState state = contactState(end, motionOf(end.a, time), shapeAt(end.a, end.boxA),
                                            motionOf(end.b, time), shapeAt(end.b, end.boxB));
    return state.gap + margin;
  };
  const double lowest = lowestBetween(0, step_.length(), valueAt);
  return valueAt(lowest) < 0 ? lowest : 0;
}

double EventLocator::dipOf(std::size_t event) {
  if (dips_.empty() || dipsOf_ != step_.length()) {
    dips_.assign(events_.all().size(), std::nullopt);
    dipsOf_ = step_.length();
  }
  if (!dips_[event]) {
    dips_[event] = deepMomentOf(events_[event].contact);
  }
  return *dips_[event];
}

bool EventLocator::dips() {
  for (std::size_t event = 0; event < events_.all().size(); ++event) {
    if (events_[event].kind == EventFunction::Kind::kOverlap && dipOf(event) > 0) {
      return true;
    }
  }
  return false;
}

// Of the gap of a contact's boxes in the step.
double EventLocator::deepMomentOf(std::size_t contact) const {
  const ContactFeature& feature = system_.features()[contact];
  const auto a = static_cast<std::size_t>(feature.a);
  const auto b = static_cast<std::size_t>(feature.b);
  const std::vector<TouchingBody>& bodies = system_.bodies();
  const auto motionOf = [&](std::size_t i) {
    const TouchingBody& body = bodies[i];
    return body.isDriven() ? Motion(body.drivenBy->motion.after(body.time - body.drivenBy->from))
           : body.isHeld() ? Motion(Rest{system_.kinematics(i).pose})
                           : Motion(step_.motion(i));
  };
  const Motion ofA = motionOf(a);
  const Motion ofB = motionOf(b);
  const auto gapAt = [&](double time) {
    const Pose poseA = stateAt(ofA, bodies[a].body->mass, time).pose;
    const Pose poseB = stateAt(ofB, bodies[b].body->mass, time).pose;
    return BoxAxes(boxAt(poseA, *bodies[a].body, feature.boxA), boxAt(poseB, *bodies[b].body, feature.boxB))
        .gap();
  };
  return deepMoment(gapAt, step_.length(), tolerance_);
}

// Just after a separation the event function is positive in between.
FallingBracket EventLocator::bracketOf(const Fall& fall) {
  FallingBracket bracket{.high = fall.until, .valueLow = fall.start, .valueHigh = fall.value};
  for (double part = 0.5; !(bracket.valueLow > 0) && part >= kShortestHop; part /= 2) {
    const double at = part * fall.until;
    step_.retake(at);
    const double there = events_.lowest(fall.events);
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
EventLocator::Estimate EventLocator::estimateOf(const Fall& fall, FallingBracket bracket,
                                                std::span<const ContactStep> path) {
  const double least = kEstimateWidth * bracket.high;
  const double valueLow = bracket.valueLow;
  Estimate estimate{.time = bracket.low, .value = bracket.valueLow};
  SmoothStep::State rate;
  while (bracket.width() > least) {
    const double at = bracket.next(least);
    const SmoothStep::State between = step_.stateWithin(path, at);
    if (events_[fall.events.front()].isOfForces()) {
      system_.rate(between, rate);
    } else {
      system_.look(between);
    }
    const double there = events_.lowest(fall.events);
    bracket.add(at, there);
    estimate = {.time = at, .value = there, .slope = (there - estimate.value) / (at - estimate.time)};
    if (std::fabs(there) <=
        std::min(kEstimateDepth * events_.depth(fall.events), kEstimateValue * valueLow)) {
      break;
    }
  }
  return estimate;
}

// Time where the event function falls to zero: the end of the bracket where it is negative.
double EventLocator::rootOf(const Fall& fall) {
  const std::vector<ContactStep> path = step_.motions();
  FallingBracket bracket = bracketOf(fall);
  if (!(bracket.valueLow > 0)) {
    return bracket.high;
  }
  const double least = kRootWidth * fall.until;
  Estimate at = estimateOf(fall, bracket, path);
  for (int k = 0; k < kMostRefinements && bracket.width() > least; ++k) {
    const double aim = at.value + events_.depth(fall.events);
    double next = bracket.next(least);
    if (k < kMostByEstimate && std::fabs(aim) < -at.slope * bracket.width()) {
      const double estimate = at.time - aim / at.slope;
      next = estimate > bracket.low && estimate < bracket.high ? estimate : next;
    }
    step_.retake(next);
    const double there = events_.lowest(fall.events);
    const double depth = events_.depth(fall.events);
    if (k > 0 && std::fabs(there) > kNoisy * depth) {
      at.slope = (there - at.value) / (next - at.time);
    }
    at.time = next;
    at.value = there;
    bracket.add(next, there);
    if (at.value < 0 && at.value >= -4 * depth) {
      break;
    }
  }
  return bracket.high;
}

}  // namespace careen
