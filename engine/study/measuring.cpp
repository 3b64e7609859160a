#include "study/measuring.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "audit/joint_gap.h"
#include "core/error.h"
#include "core/system/clock.h"
#include "physics/start/overlap.h"
#include "physics/world/diagnostics.h"
#include "study/deadline.h"
#include "runs/difference.h"

namespace careen {
namespace {

constexpr int kLeastRounds = 2;
constexpr double kRunsWithoutSteps = 4;     // see Effort::longestRun
constexpr double kLongestStepOfRun = 0.25;  // [1] of the run: no step is longer

World startingFrom(const World& world, const std::vector<BodyState>& states) {
  World next = world;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!isImmovable(world.bodies[i].mass)) {
      next.bodies[i].initial = states[i];
    }
  }
  return next;
}

std::vector<BodyState> withReversedVelocities(std::vector<BodyState> states) {
  for (BodyState& state : states) {
    state.velocity = -state.velocity;
    state.angularMomentum = -state.angularMomentum;
  }
  return states;
}

std::vector<BodyState> initialStates(const World& world) {
  std::vector<BodyState> states;
  for (const Body& body : world.bodies) {
    states.push_back(body.initial);
  }
  return states;
}

// Springs of joints are no part of energyOf(), their friction takes energy.
bool mayLoseEnergy(const World& world) {
  const auto loses = [](const Material& one, const Material& other) {
    const Material pair = touching(one, other);
    return pair.restitution < 1 || pair.friction > 0;
  };
  const auto mayLoseIn = [&](int index) {
    const Body& body = world.bodies[static_cast<std::size_t>(index)];
    bool meets = false;
    for (int other = 0; other < static_cast<int>(world.bodies.size()); ++other) {
      meets = meets || (other != index && mayTouch(world, index, other));
    }
    return (meets && loses(body.material, body.material)) ||
           std::any_of(world.walls.begin(), world.walls.end(),
                       [&](const Wall& wall) { return loses(body.material, wall.material); });
  };
  const auto mayLoseInJoint = [](const Joint& joint) {
    const bool strikes =
        joint.kind == Joint::Kind::kRope || std::isfinite(joint.lowest) || std::isfinite(joint.highest);
    return joint.isLoaded() || (strikes && joint.restitution < 1);
  };
  bool mayLose = world.control || std::any_of(world.joints.begin(), world.joints.end(), mayLoseInJoint);
  for (int i = 0; i < static_cast<int>(world.bodies.size()) && !mayLose; ++i) {
    mayLose = mayLoseIn(i);
  }
  return mayLose;
}

double energyChange(const World& world, const std::vector<BodyState>& states) {
  const Energy start = energyOf(world, initialStates(world));
  double scale = start.kinetic;
  for (std::size_t i = 0; start.kinetic == 0 && i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    scale += isImmovable(body.mass) ? 0 : body.mass.mass * world.gravity.norm() * body.halfExtents.norm();
  }
  return (energyOf(world, states).total() - start.total()) / scale;
}

// The deepest penetration is put into the judgement, in half diagonals of the smaller of the two bodies.
void includeOverlap(const World& world, const std::vector<BodyState>& states, Judgement& judgement) {
  const auto include = [&](double depth, double size) {
    judgement.error = std::max(judgement.error, depth / size);
  };
  std::vector<PlacedBox> boxes;
  for (std::size_t i = 0; i < states.size(); ++i) {
    boxes.push_back(placedBox(world.bodies[i], states[i].pose));
  }
  for (const Overlap& each : overlaps(boxes, world.apart)) {
    include(each.depth,
            std::min(boxes[each.first].halfExtents.norm(), boxes[each.second].halfExtents.norm()));
  }
  for (const PlacedBox& box : boxes) {
    for (const Wall& wall : world.walls) {
      const double gap = box.inverseMass > 0 ? lowestGap(wall, box).gap : 0;
      include(std::isfinite(gap) ? -gap : INFINITY, box.halfExtents.norm());
    }
  }
}

void includeJoints(const World& world, const std::vector<BodyState>& states, Judgement& judgement) {
  for (const Joint& joint : world.joints) {
    const auto poseOf = [&](const JointEnd& end) {
      return end.body ? states[static_cast<std::size_t>(*end.body)].pose : Pose{};
    };
    const double open = jointGapOf(world, joint, poseOf(joint.from), poseOf(joint.to)).open;
    judgement.jointGap = std::max(judgement.jointGap.value_or(0), open);
  }
}

void includeDifference(const Case& study, const std::vector<BodyState>& states,
                       const std::vector<BodyState>& truth, Judgement& judgement) {
  judgement.error = std::max(judgement.error, differenceOf(study.world, states, truth).relative);
  judgement.displacement =
      std::max(judgement.displacement.value_or(0), displacementOf(study.world, states, truth));
}

// The index of an attempt and what is known of its run time.
struct Timed {
  std::size_t attempt = 0;
  const Contestant* contestant = nullptr;
  double seconds = 0;
  std::vector<double> samples;
};

std::string timeoutText(double seconds) {
  std::ostringstream text;
  text << "not finished after " << seconds << " s";
  return text.str();
}

double finenessOf(const Attempt& attempt, const Case& study) {
  return attempt.dt > 0          ? attempt.dt
         : attempt.tolerance > 0 ? attempt.tolerance
                                 : study.scene.settings.tolerance;
}

bool isSame(const std::vector<BodyState>& x, const std::vector<BodyState>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), [](const BodyState& a, const BodyState& b) {
    return a.pose.position == b.pose.position && a.pose.worldFromBody == b.pose.worldFromBody;
  });
}

bool isSame(const Answer& x, const Answer& y) {
  const auto same = [](const States& a, const States& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& p, const auto& q) { return isSame(p, q); });
  };
  return same(x.states, y.states) && same(x.second, y.second);
}

// Repeats the run, untimed, with its motions kept. One that takes too long has no audit.
std::string auditOf(const Case& study, const Contestant& contestant, double fineness, double allowed,
                    const std::stop_token& stop) {
  const Deadline deadline(allowed, stop);
  try {
    const std::optional<Audit> found =
        contestant.audited(study.world, fineness, study.duration(), deadline.token());
    return found ? inWords(*found) : "";
  } catch (const Interrupted&) {
    if (stop.stop_requested()) {
      throw;
    }
    return "";
  }
}

// Measures the error and a first estimate of the run time.
double attempt(const Case& study, const Contestant& contestant, const Effort& effort,
               const std::stop_token& stop, Attempt& result, Answer& answer) {
  const double allowed = (contestant.steps() ? 1 : kRunsWithoutSteps) * effort.longestRun;
  const auto clock = [&contestant] { return contestant.secondsTaken(); };
  const Deadline deadline(allowed, stop, clock);
  const double start = clock();
  try {
    answer = answerOf(study, contestant, finenessOf(result, study), deadline.token());
    result.judgement = judge(study, answer);
    if (!std::isfinite(result.judgement.error)) {
      result.failure = "its states are not finite";
    }
  } catch (const Interrupted&) {
    if (stop.stop_requested()) {
      throw;
    }
    result.failure = timeoutText(allowed);
  } catch (const Error& error) {
    result.failure = error.what();
  }
  const double seconds = clock() - start;
  if (result.failure.empty()) {
    result.audit = auditOf(study, contestant, finenessOf(result, study), allowed, stop);
  }
  return seconds;
}

double timeOnce(const Case& study, const Timed& timed, double fineness, double shortest,
                const std::stop_token& stop) {
  const int count = static_cast<int>(std::ceil(shortest / std::max(timed.seconds, shortest / 1e4)));
  const double start = timed.contestant->secondsTaken();
  for (int i = 0; i < count; ++i) {
    answerOf(study, *timed.contestant, fineness, stop);
  }
  return (timed.contestant->secondsTaken() - start) / count;
}

void timeAll(const Case& study, const Effort& effort, std::vector<Timed>& all, std::vector<Attempt>& attempts,
             const std::stop_token& stop) {
  const Pinned pinned;
  const Clock::time_point start = Clock::now();
  for (int round = 0; round < effort.rounds; ++round) {
    if (round >= kLeastRounds && secondsSince(start) > effort.timing) {
      break;
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      Timed& timed = all[(i + static_cast<std::size_t>(round)) % all.size()];
      timed.samples.push_back(
          timeOnce(study, timed, finenessOf(attempts[timed.attempt], study), effort.shortest, stop));
      timed.seconds = *std::min_element(timed.samples.begin(), timed.samples.end());
    }
  }
  for (Timed& timed : all) {
    const auto middle = timed.samples.begin() + static_cast<std::ptrdiff_t>(timed.samples.size() / 2);
    std::nth_element(timed.samples.begin(), middle, timed.samples.end());
    Attempt& result = attempts[timed.attempt];
    result.cost = 1e6 * timed.seconds / study.simulated();
    result.spread = *middle / timed.seconds - 1;
    result.repeats = static_cast<int>(timed.samples.size());
  }
}

}  // namespace

Effort fullEffort() {
  return {.longestRun = 5,
          .longestStep = 0.5,
          .timing = 6,
          .steps = {8, 4, 2, 1, 1. / 2, 1. / 4, 1. / 8, 1. / 16, 1. / 32, 1. / 64},
          .tolerances = {1e2, 1, 1e-2, 1e-4}};
}

Effort quickEffort() {
  return {.longestRun = 1.5,
          .longestStep = 0.02,
          .timing = 0.5,
          .rounds = 3,
          .shortest = 5e-4,
          .steps = {4, 1, 1. / 4},
          .tolerances = {1, 1e-2}};
}

double usualFineness(const Case& study, const Contestant& contestant) {
  return contestant.steps() ? study.scene.settings.dt : study.scene.settings.tolerance;
}

Answer answerOf(const Case& study, const Contestant& contestant, double fineness,
                const std::stop_token& stop) {
  Answer answer;
  answer.states = contestant.run(study.world, fineness, study.times, stop);
  if (study.measure == Measure::kReversal) {
    const double end = study.duration();
    answer.second = contestant.run(startingFrom(study.world, withReversedVelocities(answer.states.back())),
                                   fineness, {&end, 1}, stop);
  } else if (study.measure == Measure::kScaled) {
    const double end = study.duration() / study.durations;
    const double unit = contestant.steps() ? study.durations : study.lengths;
    answer.second = contestant.run(study.original, fineness / unit, {&end, 1}, stop);
  }
  return answer;
}

Judgement judge(const Case& study, const Answer& answer) {
  Judgement judgement;
  if (!mayLoseEnergy(study.world)) {
    for (const std::vector<BodyState>& states : answer.states) {
      judgement.energy.push_back(energyChange(study.world, states));
    }
  }
  for (const std::vector<BodyState>& states : answer.states) {
    includeJoints(study.world, states, judgement);
  }
  switch (study.measure) {
    case Measure::kPoses:
      judgement.error = study.uncertainty;
      for (std::size_t k = 0; k < study.times.size(); ++k) {
        includeDifference(study, answer.states[k], withPoses(study.world, study.poses[k]), judgement);
      }
      break;
    case Measure::kEnergy:
      for (const double change : judgement.energy) {
        judgement.error = std::max(judgement.error, std::isfinite(change) ? std::fabs(change) : INFINITY);
      }
      break;
    case Measure::kOverlap:
      for (const std::vector<BodyState>& states : answer.states) {
        includeOverlap(study.world, states, judgement);
      }
      break;
    case Measure::kReversal:
      includeDifference(study, answer.second.back(), initialStates(study.world), judgement);
      break;
    case Measure::kScaled: {
      std::vector<BodyState> scaled = answer.second.back();
      for (BodyState& state : scaled) {
        state.pose.position *= study.lengths;
      }
      includeDifference(study, answer.states.back(), scaled, judgement);
      break;
    }
  }
  return judgement;
}

std::vector<Attempt> attemptAll(const Case& study, const Contestants& contestants, const Effort& effort,
                                const std::stop_token& stop) {
  std::vector<Attempt> attempts;
  std::vector<Timed> timed;
  for (const auto& contestant : contestants) {
    Attempt blank;
    blank.contestant = contestant->name();
    blank.settings = contestant->settings();
    if (const std::string refusal = contestant->refuses(study.world); !refusal.empty()) {
      attempts.push_back(blank);
      attempts.back().failure = refusal;
      continue;
    }
    if (contestant->isGiven()) {
      attempts.push_back(blank);
      Answer answer;
      attempt(study, *contestant, effort, stop, attempts.back(), answer);
      attempts.back().cost = 1e6 * contestant->secondsGiven().value_or(0) / study.simulated();
      continue;
    }
    const bool steps = contestant->steps();
    const double usual = usualFineness(study, *contestant);
    Answer coarser;
    for (const double factor : steps ? effort.steps : effort.tolerances) {
      const double dt = steps ? factor * usual : 0;
      const double tolerance = steps ? 0 : factor * usual;
      if (dt > kLongestStepOfRun * study.duration() && factor > 1) {
        continue;
      }
      attempts.push_back(blank);
      attempts.back().dt = dt;
      attempts.back().tolerance = tolerance;
      attempts.back().sameTo = tolerance;
      Answer answer;
      const double seconds = attempt(study, *contestant, effort, stop, attempts.back(), answer);
      if (!steps && attempts.back().failure.empty() && isSame(answer, coarser)) {
        attempts.pop_back();
        attempts.back().sameTo = tolerance;
        if (factor == effort.tolerances.back() &&
            attempts.back().tolerance == effort.tolerances.front() * usual) {
          attempts.back().tolerance = 0;
        }
        continue;
      }
      coarser = std::move(answer);
      if (attempts.back().failure.empty()) {
        timed.push_back({.attempt = attempts.size() - 1,
                         .contestant = contestant.get(),
                         .seconds = seconds,
                         .samples = {}});
      }
      // A table needs the usual time step of everything, the others only while they are fast.
      if (seconds > effort.longestRun && !attempts.back().failure.empty()) {
        attempts.back().dt = std::min(dt, usual);
        attempts.back().tolerance = std::min(tolerance, usual);
        break;
      }
      if (factor <= 1 && seconds > effort.longestStep) {
        break;
      }
    }
  }
  timeAll(study, effort, timed, attempts, stop);
  return attempts;
}

Pinned::Pinned() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0) {
    return;
  }
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(core, &allowed)) {
      before_.push_back(core);
    }
  }
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(before_.back(), &one);
  sched_setaffinity(0, sizeof(one), &one);
}

Pinned::~Pinned() {
  if (before_.empty()) {
    return;
  }
  cpu_set_t all;
  CPU_ZERO(&all);
  for (const int core : before_) {
    CPU_SET(core, &all);
  }
  sched_setaffinity(0, sizeof(all), &all);
}

}  // namespace careen
