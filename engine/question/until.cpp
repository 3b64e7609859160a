#include "question/until.h"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "question/moments.h"

namespace careen {
namespace {

constexpr double kFirstLook = 1.0 / 1024;  // [1] of the duration
constexpr double kNextLook = 1.5;          // [1] of the time of the look before

// [s] Until then all is recorded of a run that has come to `time`: steps are recorded late. All but perhaps
// that a body has become a member of a crowd.
double recordedUntil(const Trajectory& soFar, double time) {
  for (const Track& track : soFar.tracks) {
    const Segment last = track.segments.empty() ? Segment() : track.segments.back();
    if (const ContactStep* const step = std::get_if<ContactStep>(&last.motion)) {
      time = std::min(time, last.start + step->duration);
    } else if (const CrowdStep* const crowd = std::get_if<CrowdStep>(&last.motion)) {
      time = std::min(time, last.start + crowd->duration);
    }
  }
  return time;
}

// Whether the run tells all of a touch: where one comes near in a motion that goes on, an impact may follow,
// which is the moment then.
bool isCertain(const Trajectory& run, const Question& question, const Moment& moment, double until) {
  if (question.kind != Question::Kind::kTouches) {
    return true;
  }
  const auto goesOn = [&](const Partner& partner) {
    if (partner.isWall()) {
      return false;
    }
    const Segments& segments = run.tracks[static_cast<std::size_t>(partner.body())].segments;
    const std::size_t begun = segments.countUntil(moment.time);
    return segments.countUntil(until) == begun && !std::holds_alternative<Rest>(segments[begun - 1].motion);
  };
  const bool isImpact = std::any_of(run.impacts.begin(), run.impacts.end(),
                                    [&](const Impact& impact) { return impact.time == moment.time; });
  return isImpact || (!goesOn(question.of.front()) && !goesOn(*moment.with));
}

std::optional<Moment> firstAfterStart(const Trajectory& run, const Question& question, double until) {
  const std::vector<Moment> found = moments(run, question, until);
  const auto first =
      std::find_if(found.begin(), found.end(), [](const Moment& moment) { return moment.time > 0; });
  return first == found.end() ? std::nullopt : std::optional(*first);
}

template <class Event>
void dropAfter(std::vector<Event>& events, double time) {
  events.erase(
      std::remove_if(events.begin(), events.end(), [time](const Event& event) { return event.time > time; }),
      events.end());
}

}  // namespace

RunUntil recordUntil(const RunSetup& setup, const Question& question, const std::stop_token& stop,
                     std::uint64_t most, const RunCallback& progress) {
  double next = kFirstLook * setup.settings.duration;
  const auto isEnough = [&](const Trajectory& soFar, double time) {
    if (time < next) {
      return false;
    }
    next = kNextLook * time;
    // What happens now may not have happened to all.
    const std::optional<Moment> first = firstAfterStart(soFar, question, recordedUntil(soFar, time));
    return first && first->time < time && isCertain(soFar, question, *first, time);
  };
  for (;;) {
    RunUntil until{.run = record(setup, stop, most, progress, isEnough), .time = {}};
    const double end = until.run.settings.duration;
    const std::optional<Moment> first = firstAfterStart(until.run, question, end);
    const bool isCut = end < setup.settings.duration;
    if (isCut && !(first && isCertain(until.run, question, *first, end))) {
      next = kNextLook * end;  // once the last steps were recorded it was not true: again, for longer
      continue;
    }
    if (first) {
      until.time = first->time;
      endAt(until.run, first->time);
    }
    return until;
  }
}

void endAt(Trajectory& run, double time) {
  run.settings.duration = time;
  for (Track& track : run.tracks) {
    const std::size_t count = std::max<std::size_t>(track.segments.countUntil(time), 1);
    if (count < track.segments.size()) {
      Segments kept;
      for (std::size_t k = 0; k < count; ++k) {
        kept.addPacked(track.segments[k]);
      }
      track.segments = std::move(kept);
    }
  }
  dropAfter(run.impacts, time);
  dropAfter(run.jointImpulses, time);
  dropAfter(run.jointEfforts, time);
  for (std::optional<double>* const since : {&run.figures.boundedFrom, &run.figures.horizon}) {
    if (*since && **since > time) {
      since->reset();
    }
  }
}

}  // namespace careen
