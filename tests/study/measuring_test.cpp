#include "study/measuring.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <thread>

#include "core/error.h"
#include "study/results.h"
#include "support/exact_runs.h"

namespace careen {
namespace {

// Moves the first body along x with a velocity error of dt, and takes as long as configured.
class Drifter : public Contestant {
 public:
  Drifter(std::string name, double seconds) : name_(std::move(name)), seconds_(seconds) {}

  std::string name() const override { return name_; }
  std::string settings() const override { return "none"; }
  bool steps() const override { return true; }
  std::string refuses(const World& world) const override { return world.drag ? "no drag" : ""; }
  States run(const World& world, double dt, std::span<const double> times,
             const std::stop_token& stop) const override {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds_);
    while (std::chrono::steady_clock::now() < end) {
      if (stop.stop_requested()) {
        throw Interrupted();
      }
    }
    if (dt < 0.01) {
      throw NumericalError("steps too short");
    }
    States states;
    for (const double time : times) {
      states.emplace_back();
      for (const Body& body : world.bodies) {
        states.back().push_back(body.initial);
      }
      states.back()[0].pose.position += time * (world.bodies[0].initial.velocity + Vec3(dt, 0, 0));
    }
    return states;
  }

 private:
  std::string name_;
  double seconds_;
};

// A box of half diagonal 3 m that moves at 1 m/s along x for 4 s.
Case drift(Measure measure) {
  Case study;
  study.measure = measure;
  study.scene.settings.dt = 0.1;
  study.world.bodies = {box("crate", Vec3(1, 2, 2), 1, Vec3::Zero(), Vec3(1, 0, 0))};
  study.times = {1, 4};
  for (const double time : study.times) {
    study.poses.push_back({{.position = Vec3(time, 0, 0)}});
  }
  return study;
}

double errorOf(const Case& study, double dt) {
  return judge(study, answerOf(study, Drifter("drifter", 0), dt, {})).error;
}

// A ball that holds the box to where it starts is as far open as the box has moved.
TEST(Measuring, saysHowFarJointsAreOpen) {
  Case study = drift(Measure::kPoses);
  EXPECT_FALSE(judge(study, answerOf(study, Drifter("drifter", 0), 0.3, {})).jointGap.has_value());
  study.world.joints.resize(1);
  study.world.joints[0].from.body = 0;
  const Judgement judgement = judge(study, answerOf(study, Drifter("drifter", 0), 0.3, {}));
  EXPECT_DOUBLE_EQ(judgement.jointGap.value(), 4 * 1.3);
  EXPECT_EQ(judgement.energy.size(), 2U);
  study.world.joints[0].damping = 1;
  EXPECT_TRUE(judge(study, answerOf(study, Drifter("drifter", 0), 0.3, {})).energy.empty());
}

// A box of 3 m half diagonal that starts at rest and moves 4 · 0.3 m down without getting faster loses the
// part 1.2/3 of what a fall by 3 m gives.
TEST(Measuring, comparesEnergyFromRestToThatOfAFall) {
  Case study = drift(Measure::kPoses);
  study.world.bodies[0].initial.velocity.setZero();
  study.world.gravity = Vec3(-10, 0, 0);
  const Judgement judgement = judge(study, answerOf(study, Drifter("drifter", 0), 0.3, {}));
  EXPECT_DOUBLE_EQ(judgement.energy.at(1), 4 * 0.3 / 3);
}

TEST(Measuring, takesTheLargestErrorOfAllMoments) {
  EXPECT_DOUBLE_EQ(errorOf(drift(Measure::kPoses), 0.3), 4 * 0.3 / 3);
  Case known = drift(Measure::kPoses);
  known.uncertainty = 0.7;  // of the truth itself
  EXPECT_EQ(errorOf(known, 0.3), 0.7);
}

TEST(Measuring, takesTheDeepestOverlapOfAllMoments) {
  Case study = drift(Measure::kOverlap);
  study.world.bodies.push_back(box("still", Vec3(1, 2, 2), 1, Vec3(6, 0, 0)));
  EXPECT_DOUBLE_EQ(errorOf(study, 0.3), (4 * 1.3 - 4) / 3);  // at 4 s; at 1 s they are apart
  study.world.bodies.pop_back();
  study.world.walls = {wall("far", Vec3(-1, 0, 0), -2)};
  EXPECT_DOUBLE_EQ(errorOf(study, 0.3), (4 * 1.3 - 1) / 3);
  const Answer answer = answerOf(study, Drifter("drifter", 0), 0.3, {});
  EXPECT_EQ(judge(study, answer).displacement, std::nullopt);  // no tolerance of the scene promises it
}

TEST(Measuring, sendsAReversedRunBack) {
  // Forward at 1 + dt, back at −1 + dt.
  EXPECT_DOUBLE_EQ(errorOf(drift(Measure::kReversal), 0.3), 2 * 4 * 0.3 / 3);
  EXPECT_EQ(drift(Measure::kReversal).simulated(), 8);
}

TEST(Measuring, comparesAScaledCopyWithItsOriginal) {
  Case study = drift(Measure::kScaled);
  study.lengths = 4;
  study.durations = 2;
  study.original.bodies = {box("crate", Vec3(0.25, 0.5, 0.5), 1, Vec3::Zero(), Vec3(0.5, 0, 0))};
  study.world.bodies[0].initial.velocity = Vec3(1, 0, 0);
  // 4 s at 1 + dt, against 4 × 2 s at 0.5 + dt/2: the same.
  EXPECT_DOUBLE_EQ(errorOf(study, 0.25), 0);
  study.original.bodies[0].initial.velocity.x() = 0.75;
  EXPECT_DOUBLE_EQ(errorOf(study, 0.25), 2. / 3);
  EXPECT_EQ(study.simulated(), 6);
}

TEST(Measuring, tellsTheChangeOfEnergyOnlyWhereImpactsTakeNoneOut) {
  Case study = drift(Measure::kEnergy);
  const Judgement kept = judge(study, answerOf(study, Drifter("drifter", 0), 0.3, {}));
  ASSERT_EQ(kept.energy.size(), 2U);
  EXPECT_EQ(kept.error, 0);
  study.world.walls = {wall("far", Vec3(1, 0, 0), -10, 0.5)};
  study.world.bodies[0].material.restitution = 0.5;
  EXPECT_TRUE(judge(study, answerOf(study, Drifter("drifter", 0), 0.3, {})).energy.empty());
  study.world.bodies[0].material = {.restitution = 1, .friction = 0.5};
  EXPECT_EQ(judge(study, answerOf(study, Drifter("drifter", 0), 0.3, {})).energy.size(), 2U);
  study.world.walls[0].material.friction = 0.5;
  EXPECT_TRUE(judge(study, answerOf(study, Drifter("drifter", 0), 0.3, {})).energy.empty());
}

TEST(Measuring, saysWhyThereIsNoAnswer) {
  Contestants contestants;
  contestants.push_back(std::make_unique<Drifter>("quick", 0));
  contestants.push_back(std::make_unique<Drifter>("slow", 10));
  const Effort effort{.longestRun = 0.05,
                      .longestStep = 1,
                      .timing = 0,
                      .rounds = 3,
                      .shortest = 1e-4,
                      .steps = {2, 1, 0.01}};
  const Case study = drift(Measure::kPoses);
  const std::vector<Attempt> attempts = attemptAll(study, contestants, effort, {});
  ASSERT_EQ(attempts.size(), 4U);
  EXPECT_EQ(attempts[0].dt, 0.2);
  EXPECT_DOUBLE_EQ(attempts[0].judgement.error, 4 * 0.2 / 3);
  EXPECT_GT(attempts[0].cost, 0);
  EXPECT_EQ(attempts[0].repeats, 2);  // at least two, however little time there is
  EXPECT_EQ(attempts[1].dt, 0.1);
  EXPECT_EQ(attempts[2].failure, "steps too short");
  EXPECT_EQ(attempts[2].repeats, 0);
  // Aborted at the first time step, and reported for the usual one.
  EXPECT_EQ(attempts[3].contestant, "slow");
  EXPECT_EQ(attempts[3].dt, 0.1);
  EXPECT_EQ(attempts[3].failure, "not finished after 0.05 s");
  Case dragged = study;
  dragged.world.drag = Drag{};
  const std::vector<Attempt> refused = attemptAll(dragged, contestants, effort, {});
  ASSERT_EQ(refused.size(), 2U);
  EXPECT_EQ(refused[0].failure, "no drag");
}

// As if another program had the core meanwhile.
class Sleeper : public Drifter {
 public:
  Sleeper() : Drifter("sleeper", 0) {}
  States run(const World& world, double dt, std::span<const double> times,
             const std::stop_token& stop) const override {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return Drifter::run(world, dt, times, stop);
  }
};

// By the clock on the wall it would take 5000 µs a second of its four. Measured: 30 µs.
TEST(Measuring, costsAreTimeOfTheCoreNotOfTheWall) {
  Contestants contestants;
  contestants.push_back(std::make_unique<Sleeper>());
  const Effort effort{
      .longestRun = 5, .longestStep = 1, .timing = 0, .rounds = 2, .shortest = 1e-4, .steps = {1}};
  const std::vector<Attempt> attempts = attemptAll(drift(Measure::kPoses), contestants, effort, {});
  ASSERT_EQ(attempts.size(), 1U);
  EXPECT_GT(attempts[0].cost, 0);
  EXPECT_LT(attempts[0].cost, 1000);
}

// Its error is its tolerance, as long as the body moves.
class Chooser : public Drifter {
 public:
  Chooser() : Drifter("chooser", 0) {}
  bool steps() const override { return false; }
  States run(const World& world, double tolerance, std::span<const double> times,
             const std::stop_token& stop) const override {
    const bool still = world.bodies[0].initial.velocity.isZero();
    return Drifter::run(world, still ? 1 : tolerance, times, stop);
  }
};

TEST(Measuring, triesTolerancesWhereTheyMatter) {
  Contestants contestants;
  contestants.push_back(std::make_unique<Chooser>());
  const Effort effort{.longestRun = 1,
                      .longestStep = 1,
                      .timing = 0,
                      .rounds = 1,
                      .steps = {1},
                      .tolerances = {1, 0.5, 0.25}};
  Case study = drift(Measure::kPoses);
  study.scene.settings.tolerance = 0.4;
  const std::vector<Attempt> attempts = attemptAll(study, contestants, effort, {});
  ASSERT_EQ(attempts.size(), 3U);
  for (const Attempt& attempt : attempts) {
    EXPECT_EQ(attempt.dt, 0);
    EXPECT_DOUBLE_EQ(attempt.judgement.error, 4 * attempt.tolerance / 3);
  }
  EXPECT_EQ(attempts[2].tolerance, 0.1);
  study.world.bodies[0].initial.velocity.setZero();
  const std::vector<Attempt> same = attemptAll(study, contestants, effort, {});
  ASSERT_EQ(same.size(), 1U);
  EXPECT_EQ(same[0].tolerance, 0);
}

// Its error is its tolerance down to a floor.
class Floored : public Chooser {
 public:
  States run(const World& world, double tolerance, std::span<const double> times,
             const std::stop_token& stop) const override {
    return Chooser::run(world, std::max(tolerance, 0.15), times, stop);
  }
};

TEST(Measuring, triesCoarserTolerancesTooAndSaysWhereAnswersStayTheSame) {
  Contestants contestants;
  contestants.push_back(std::make_unique<Floored>());
  const Effort effort{.longestRun = 1,
                      .longestStep = 1,
                      .timing = 0,
                      .rounds = 1,
                      .steps = {1},
                      .tolerances = {4, 2, 1, 0.5}};
  Case study = drift(Measure::kPoses);
  study.scene.settings.tolerance = 0.1;
  const CaseResult result = resultOf(study, attemptAll(study, contestants, effort, {}), "");
  ASSERT_EQ(result.attempts.size(), 3U);
  const std::vector<double> expected = {0.4, 0.2, 0.15};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_DOUBLE_EQ(result.attempts[k].judgement.displacement.value(), 4 * expected[k]);  // in metres
    EXPECT_DOUBLE_EQ(result.attempts[k].judgement.error, 4 * expected[k] / 3);
  }
  EXPECT_EQ(result.attempts[2].tolerance, 0.1);
  EXPECT_EQ(result.attempts[2].sameTo, 0.05);
  EXPECT_EQ(usualAttempt(result, "chooser"), &result.attempts[2]);
}

TEST(Measuring, endsWhenInterrupted) {
  Contestants contestants;
  contestants.push_back(std::make_unique<Drifter>("slow", 60));
  std::stop_source source;
  std::jthread later([&source] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    source.request_stop();
  });
  EXPECT_THROW(attemptAll(drift(Measure::kPoses), contestants, fullEffort(), source.get_token()),
               Interrupted);
}

TEST(Measuring, timesOnOneCoreAndGivesTheOthersBack) {
  cpu_set_t before;
  sched_getaffinity(0, sizeof(before), &before);
  {
    const Pinned pinned;
    cpu_set_t during;
    sched_getaffinity(0, sizeof(during), &during);
    EXPECT_EQ(CPU_COUNT(&during), 1);
  }
  cpu_set_t after;
  sched_getaffinity(0, sizeof(after), &after);
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

}  // namespace
}  // namespace careen
