#include "physics/contact/impulses_without_approach.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

/// [1] of a step: a moment, in which forces do next to nothing and only impulses count. In a much shorter one
/// what gravity gives would count as none, and no impulses be found. It is no longer than what moves nothing.
constexpr double kMoment = 0x1p-6;
/// [1] of the fastest speed and, in the step, of what counts as closed: a change of velocity that is looked
/// at again. Of that change: one that stays however short the step.
constexpr double kJolt = 0x1p-4;
constexpr double kStays = 0.5;

// [m/s] The largest change of a velocity, corners included.
double changeOf(const TouchingGroup& group, const GroupState& from, const GroupState& to) {
  GroupState change = from;
  for (std::size_t i = 0; i < change.size(); ++i) {
    change[i].velocity = to[i].velocity - from[i].velocity;
    change[i].angularMomentum = to[i].angularMomentum - from[i].angularMomentum;
  }
  return group.fastest(change);
}

// Whatever is pushed in the moment has the velocities of its end from its start on: so impulses act, and so
// they are recorded.
void strikeAtStart(JammedMoment& moment, ImplicitStep& equations) {
  const TouchingGroup& group = equations.group();
  GroupStep& step = moment.step;
  const std::vector<ContactFeature> features = pushing(moment.law);
  std::vector<char> struck(group.size(), 0);
  for (const ContactFeature& feature : features) {
    struck[static_cast<std::size_t>(feature.a)] = 1;
    struck[static_cast<std::size_t>(feature.b)] = 1;
  }
  const auto takeVelocities = [&](std::size_t i, const GroupState& from, GroupState& to) {
    to[i].velocity = from[i].velocity;
    to[i].angularMomentum = from[i].angularMomentum;
  };
  const auto isStruck = [&](std::size_t i) { return struck[i] != 0 && !group.isHeld(i); };
  const GroupState before = step.start;
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (isStruck(i)) {
      takeVelocities(i, step.end, step.start);
    }
  }
  group.keepMomenta(before, 0, features, step.start);  // the impulses were those of the middle of the moment
  std::vector<ClosedContact> none;
  equations.advance(step.start, step.length, none, step.end);
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (isStruck(i)) {
      step.end[i].position = step.start[i].position + step.length * step.start[i].velocity;
      takeVelocities(i, step.start, step.end);
    }
  }
  group.keepMomenta(before, step.length, features, step.end);
}

}  // namespace

std::optional<JammedMoment> jammedMomentOf(const GroupStep& step, const FoundContacts& contacts,
                                           const std::vector<ClosedContact>& known, ImplicitStep& equations) {
  const TouchingGroup& group = equations.group();
  const double closed = contacts.closed();
  const double change = changeOf(group, step.start, step.end);
  if (change <= kJolt * group.fastest(step.start) || change * step.length <= kJolt * closed) {
    return std::nullopt;
  }
  const double acceleration = equations.loads().acceleration(step.start);
  const double part =
      acceleration > 0 ? std::min(kMoment, std::sqrt(0.25 * closed / acceleration) / step.length) : kMoment;
  JammedMoment moment{.step = {.length = part * step.length, .start = step.start, .slope = step.slope},
                      .law = contacts.obeying(step.length, known),
                      .part = part,
                      .change = change};
  if (!equations.advance(step.start, moment.step.length, moment.law, moment.step.end) ||
      !(changeOf(group, step.start, moment.step.end) > kStays * change)) {
    return std::nullopt;
  }
  strikeAtStart(moment, equations);
  return moment;
}

}  // namespace careen
