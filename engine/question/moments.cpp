#include "question/moments.h"

#include <algorithm>
#include <cstddef>
#include <variant>

#include "question/quantity_spans.h"
#include "question/touching_spans.h"

namespace careen {
namespace {

// Times at which a body comes to rest, +1, and moves again, −1.
struct Change {
  double time = 0;  // [s]
  int by = 0;
};

void addChanges(const Segments& segments, double until, std::vector<Change>& changes) {
  bool rests = false;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Segment segment = segments[k];
    const bool isEmpty = k + 1 < segments.size() && segments[k + 1].start <= segment.start;
    const bool now = std::holds_alternative<Rest>(segment.motion);
    if (segment.start > until || isEmpty || now == rests) {
      continue;
    }
    changes.push_back({.time = segment.start, .by = now ? 1 : -1});
    rests = now;
  }
}

std::vector<Moment> momentsOfRest(const Trajectory& run, const Question& question, double until) {
  std::vector<Change> changes;
  int needed = 0;
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    const bool isAsked = question.of.empty() ? !isImmovable(run.world.bodies[body].mass)
                                             : question.of.front().isBody(static_cast<int>(body));
    if (isAsked) {
      ++needed;
      addChanges(run.tracks[body].segments, until, changes);
    }
  }
  // Who goes on at the moment at which another comes to rest counts first.
  std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) {
    return a.time < b.time || (a.time == b.time && a.by < b.by);
  });
  std::vector<Moment> found;
  int resting = 0;
  for (const Change& change : changes) {
    resting += change.by;
    if (change.by > 0 && resting == needed) {
      found.push_back({.time = change.time});
    }
  }
  if (needed == 0) {
    found.push_back({.time = 0});
  }
  return found;
}

std::vector<Partner> othersOf(const Question& question, const World& world) {
  if (question.of.size() > 1) {
    return {question.of[1]};
  }
  std::vector<Partner> others;
  for (std::size_t body = 0; body < world.bodies.size(); ++body) {
    if (!question.of.front().isBody(static_cast<int>(body))) {
      others.push_back(Partner::ofBody(static_cast<int>(body)));
    }
  }
  for (std::size_t wall = 0; wall < world.walls.size() && !question.of.front().isWall(); ++wall) {
    others.push_back(Partner::ofWall(wall));
  }
  return others;
}

std::vector<Moment> momentsOfContact(const Trajectory& run, const Question& question, double until) {
  std::vector<Moment> found;
  const Partner self = question.of.front();
  for (const Partner& other : othersOf(question, run.world)) {
    const bool isSwapped = self.isWall();
    const auto body = static_cast<std::size_t>((isSwapped ? other : self).body());
    for (const TrueSpan& span : touchingSpans(run, body, isSwapped ? self : other, until)) {
      if (question.kind == Question::Kind::kTouches) {
        found.push_back({.time = span.from, .with = other});
      } else if (!span.lasts) {
        found.push_back({.time = span.to, .with = other});
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Moment& a, const Moment& b) { return a.time < b.time; });
  return found;
}

}  // namespace

std::vector<Moment> moments(const Trajectory& run, const Question& question, double until) {
  switch (question.kind) {
    case Question::Kind::kTouches:
    case Question::Kind::kLeaves:
      return momentsOfContact(run, question, until);
    case Question::Kind::kRests:
      return momentsOfRest(run, question, until);
    default: {
      std::vector<Moment> found;
      for (const TrueSpan& span : quantitySpans(run, question, until)) {
        found.push_back({.time = span.from});
      }
      return found;
    }
  }
}

std::vector<Moment> moments(const Trajectory& run, const Question& question) {
  return moments(run, question, run.settings.duration);
}

}  // namespace careen
