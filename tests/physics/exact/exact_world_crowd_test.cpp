#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "physics/exact/exact_world.h"
#include "physics/world/diagnostics.h"
#include "support/article_equations.h"
#include "support/crowd_scenes.h"
#include "support/exact_runs.h"

// Crowds among the other groups of the event queue.

namespace careen {
namespace {

using namespace test;

bool isCrowd(const Motion& motion) { return std::holds_alternative<CrowdStep>(motion); }

std::size_t crowdSteps(const Recorded& run, std::size_t body) {
  return static_cast<std::size_t>(std::count_if(run.motions[body].begin(), run.motions[body].end(),
                                                [](const auto& each) { return isCrowd(each.second); }));
}

TEST(ExactWorldCrowd, isLeftToItsMembers) {
  World world = layers();
  Body brick = ofMaterial(
      box("brick", Vec3(0.1, 0.2, 0.3), 1, Vec3(-6, 0, 1.5), Vec3(0, 0.2, 0), Vec3(1, 2, 3), 0), 0, 1);
  brick.name = "a-brick";
  World alone = onARoughFloor(0.5);
  world.walls[0].material.restitution = alone.walls[0].material.restitution = 1;
  alone.bodies = {brick};
  world.bodies.push_back(brick);
  const Recorded both = crowdRun(world, 3);
  const Recorded single = crowdRun(alone, 3);
  ASSERT_TRUE(both.figures.boundedFrom);
  ASSERT_EQ(both.motions.back().size(), single.motions[0].size());
  ASSERT_GT(single.motions[0].size(), 4U);
  for (std::size_t k = 0; k < single.motions[0].size(); ++k) {
    EXPECT_EQ(both.motions.back()[k].first, single.motions[0][k].first);
  }
  for (double time = 0; time < 3; time += 0.0137) {
    EXPECT_EQ(both.at(world, world.bodies.size() - 1, time).pose.position,
              single.at(alone, 0, time).pose.position);
  }
}

// Neither places nor speeds jump, but for what stops to sleep.
TEST(ExactWorldCrowd, movesContinuously) {
  const World world = layers();
  const Recorded run = crowdRun(world, 2);
  std::size_t joins = 0;
  std::size_t kinks = 0;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const auto& motions = run.motions[i];
    for (std::size_t k = 1; k < motions.size(); ++k) {
      const auto& [start, motion] = motions[k];
      const BodyState before =
          stateAt(motions[k - 1].second, world.bodies[i].mass, start - motions[k - 1].first);
      const BodyState after = stateAt(motion, world.bodies[i].mass, 0);
      EXPECT_LT((before.pose.position - after.pose.position).norm(), 1e-9) << i << " at " << start;
      EXPECT_LT((before.pose.worldFromBody - after.pose.worldFromBody).norm(), 1e-6) << i << " at " << start;
      joins += isCrowd(motion) ? 1 : 0;
      kinks += isCrowd(motion) && (before.velocity - after.velocity).norm() > 0.02 ? 1 : 0;
    }
  }
  RecordProperty("joins", std::to_string(joins));
  RecordProperty("kinks", std::to_string(kinks));
  ASSERT_GT(joins, 1000U);
  EXPECT_LT(kinks, joins / 50);
}

// Slow motion at 1/50 of a tumbling pile, 60 frames a second: a path of straight steps would show corners,
// its second differences those of speeds, while here they are those of forces. Where something strikes,
// speeds change within a step, which is several frames long.
TEST(ExactWorldCrowd, showsNoPolygonInSlowMotion) {
  const World world = layers();
  const Recorded run = crowdRun(world, 1.6);
  constexpr double kFrame = 1.0 / (60 * 50);
  std::vector<double> accelerations;  // [m/s²] of corners
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    Vec3 before = Vec3::Zero();
    Vec3 last = Vec3::Zero();
    int frame = 0;
    for (double time = 0.7; time < 1.55; time += kFrame, ++frame) {
      const Pose pose = run.at(world, i, time).pose;
      const Vec3 corner = pose.position + pose.worldFromBody * world.bodies[i].halfExtents;
      if (frame > 1) {
        accelerations.push_back((corner - 2 * last + before).norm() / (kFrame * kFrame));
      }
      before = last;
      last = corner;
    }
  }
  std::sort(accelerations.begin(), accelerations.end());
  const auto quantile = [&](double part) {
    return accelerations[static_cast<std::size_t>(part * static_cast<double>(accelerations.size() - 1))];
  };
  EXPECT_LT(quantile(0.99), 70);    // measured 51, and 89 if steps are not joined
  EXPECT_LT(quantile(0.999), 400);  // 303 and 554
}

// Twelve dominoes: the energy of what is recorded, each millisecond. What is left of rises, 2.4e-4, comes and
// goes within a step: a contact's force acts all the while that one velocity goes over into the next.
TEST(ExactWorldCrowd, recordsNoEnergyThatThereIsNot) {
  World world = onARoughFloor(0.4);
  for (int k = 0; k < 12; ++k) {
    world.bodies.push_back(
        ofMaterial(box("d" + std::to_string(10 + k), Vec3(0.05, 0.2, 0.4), 16, Vec3(0.42 * k, 0, 0.4)), 0.4));
  }
  const double tilt = 0.2;
  world.bodies[0].initial.pose = {.position = Vec3(0.05 - 0.05 * std::cos(tilt) + 0.4 * std::sin(tilt), 0,
                                                   0.05 * std::sin(tilt) + 0.4 * std::cos(tilt)),
                                  .worldFromBody = axisAngle(Vec3::UnitY(), tilt)};
  const Recorded run = crowdRun(world, 4);
  double least = std::numeric_limits<double>::infinity();
  double rise = 0;
  double first = 0;
  double last = 0;
  for (double time = 0; time < 4; time += 1e-3) {
    std::vector<BodyState> states;
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      states.push_back(run.at(world, i, time));
    }
    last = energyOf(world, states).total();
    first = time == 0 ? last : first;
    least = std::min(least, last);
    rise = std::max(rise, last - least);
  }
  RecordProperty("rise", std::to_string(rise));
  RecordProperty("first", std::to_string(first));
  RecordProperty("last", std::to_string(last));
  EXPECT_LT(last, 0.9 * first);
  EXPECT_LT(rise, 3e-4 * first);
}

TEST(ExactWorldCrowd, releasesWhatNothingTouches) {
  World world = onARoughFloor(0.3, 0.8);
  world.bodies = {ofMaterial(box("a", Vec3(0.2, 0.2, 0.2), 1, Vec3(0, 0, 0.2)), 0.3, 0.8),
                  ofMaterial(box("b", Vec3(0.2, 0.2, 0.2), 1, Vec3(0.05, 0, 1.2)), 0.3, 0.8)};
  const Recorded run = crowdRun(world, 1);
  ASSERT_GT(crowdSteps(run, 1), 0U);
  const auto& motions = run.motions[1];
  const auto first =
      std::find_if(motions.begin(), motions.end(), [](const auto& each) { return isCrowd(each.second); });
  EXPECT_TRUE(std::any_of(first, motions.end(),
                          [](const auto& each) { return std::holds_alternative<Flight>(each.second); }));
  EXPECT_GT(run.at(world, 1, 0.8).pose.position.z(), 0.7);  // it bounced
}

// Without gravity, springs, walls: what strikes in a crowd exchanges momentum to rounding.
TEST(ExactWorldCrowd, exchangesMomentum) {
  World world;
  for (int k = 0; k < 12; ++k) {
    const Vec3 at(1.1 * (k % 3), 1.1 * (k / 3 % 2), 1.1 * (k / 6));
    const Vec3 center(1.1, 0.55, 0.55);
    world.bodies.push_back(ofMaterial(box("box-" + std::to_string(10 + k), Vec3(0.3, 0.4, 0.5), 1 + k, at,
                                          2 * (center - at), Vec3(k % 3, 1, k % 2), 0),
                                      0.4, 0.5));
  }
  const Recorded run = crowdRun(world, 1);
  ASSERT_TRUE(run.figures.boundedFrom);
  const auto momentum = [&](double time) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      sum += world.bodies[i].mass.mass * run.at(world, i, time).velocity;
    }
    return sum;
  };
  EXPECT_LT((momentum(1) - momentum(0)).norm(), 1e-10 * 100);
}

// A spring pulls a crowd's members as it pulls an island's.
TEST(ExactWorldCrowd, feelsSpringsAndDrag) {
  World world = onARoughFloor(0);
  world.bodies = {ofMaterial(box("a", Vec3(0.2, 0.2, 0.2), 1, Vec3(0, 0, 0.2)), 0),
                  ofMaterial(box("b", Vec3(0.2, 0.2, 0.2), 1, Vec3(1.5, 0, 0.2)), 0)};
  world.springs = {{.from = {.body = 0}, .to = {.body = 1}, .stiffness = 20, .restLength = 1}};
  world.drag = Drag{.linear = 0.3, .angular = 0};
  world.bodies[0].initial.velocity = Vec3(0.3, 0, 0);
  Recorded exact;
  exact.motions.resize(2);
  Notes notes(exact);
  exact.figures = ExactWorld(world, {.duration = 2}, notes).run({});
  for (const double tolerance : {3e-4, 3e-6}) {
    const Recorded crowd = crowdRun(world, 2, tolerance);
    ASSERT_GT(crowdSteps(crowd, 0), 10U);
    const double error =
        (crowd.at(world, 0, 1.9).pose.position - exact.at(world, 0, 1.9).pose.position).norm();
    EXPECT_LT(error, 30 * std::sqrt(tolerance * 1e-4)) << tolerance;  // first order in the step
  }
}

// A spring pulls the last of three boxes that touch, and one that flies, without gravity: what is pushed and
// what is not receive the same.
TEST(ExactWorldCrowd, springsWithinItMoveNoCentreOfMass) {
  World world;
  for (int k = 0; k < 3; ++k) {
    world.bodies.push_back(ofMaterial(
        box("box-" + std::to_string(k), Vec3(0.2, 0.2, 0.2), 1 + 2 * k, Vec3(0.4 * k, 0.01 * k, 0)), 0.5,
        0.9));
  }
  world.bodies.push_back(
      ofMaterial(box("flying", Vec3(0.2, 0.2, 0.2), 2, Vec3(-1, 0.5, 0), Vec3(-0.5, 0.3, 0.1)), 0.5, 0.9));
  world.springs = {{.from = {.body = 2}, .to = {.body = 3}, .stiffness = 4}};
  const Recorded run = crowdRun(world, 1.5);
  ASSERT_GT(crowdSteps(run, 0), 10U);
  const auto center = [&](double time) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      sum += world.bodies[i].mass.mass * run.at(world, i, time).pose.position;
    }
    return Vec3(sum / 11);
  };
  const Vec3 velocity = 2.0 / 11 * Vec3(-0.5, 0.3, 0.1);
  for (const double time : {0.31, 0.77, 1.5}) {
    // Measured 2.6e-6; .025 if bounces forget half a step of forces, 1e-3 if one step's act for another.
    EXPECT_LT((center(time) - center(0) - time * velocity).norm(), 5e-6) << time;
  }
}

TEST(ExactWorldCrowd, neverMeansNever) {
  const World world = layers();
  Recorded run;
  run.motions.resize(world.bodies.size());
  Notes notes(run);
  const RunSettings settings{.duration = 0.45, .crowds = {.when = CrowdSettings::When::kNever}};
  run.figures = ExactWorld(world, settings, notes).run({});
  EXPECT_FALSE(run.figures.boundedFrom);
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    EXPECT_EQ(crowdSteps(run, i), 0U);
  }
}

TEST(ExactWorldCrowd, listingChangesNoBit) {
  const World world = layers();
  World shuffled = world;
  for (std::size_t k = 0; k < world.bodies.size(); ++k) {
    shuffled.bodies[k] = world.bodies[(7 * k + 3) % world.bodies.size()];
  }
  const Recorded run = crowdRun(world, 1.2);
  const Recorded other = crowdRun(shuffled, 1.2);
  for (std::size_t k = 0; k < world.bodies.size(); ++k) {
    EXPECT_EQ(run.at(world, (7 * k + 3) % world.bodies.size(), 1.2).pose.position,
              other.at(shuffled, k, 1.2).pose.position);
  }
}

// The arrivals of a crowd's dominoes converge to those of exact contact, at first order in the step.
TEST(ExactWorldCrowd, convergesToExactContact) {
  World world = onARoughFloor(0.4);
  for (int k = 0; k < 6; ++k) {
    world.bodies.push_back(
        ofMaterial(box("d" + std::to_string(k), Vec3(0.05, 0.2, 0.4), 1, Vec3(0.42 * k, 0, 0.4)), 0.4));
  }
  const double tilt = 0.2;
  world.bodies[0].initial.pose = {.position = Vec3(0.05 - 0.05 * std::cos(tilt) + 0.4 * std::sin(tilt), 0,
                                                   0.05 * std::sin(tilt) + 0.4 * std::cos(tilt)),
                                  .worldFromBody = axisAngle(Vec3::UnitY(), tilt)};
  const auto arrival = [&](const Recorded& run, std::size_t body) {
    double low = 0;
    double high = 2;
    const auto isTilted = [&](double time) {
      return run.at(world, body, time).pose.worldFromBody(2, 2) < std::cos(0.1);
    };
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (isTilted(middle) ? high : low) = middle;
    }
    return high;
  };
  Recorded exact;
  exact.motions.resize(world.bodies.size());
  Notes notes(exact);
  exact.figures =
      ExactWorld(world, {.duration = 2, .crowds = {.when = CrowdSettings::When::kNever}}, notes).run({});
  double before = 1;
  for (const double tolerance : {3e-4, 3e-6}) {
    const Recorded crowd = crowdRun(world, 2, tolerance);
    double worst = 0;
    for (std::size_t body = 1; body < 5; ++body) {
      worst = std::max(worst, std::fabs(arrival(crowd, body) - arrival(exact, body)));
    }
    EXPECT_LT(worst, tolerance > 1e-4 ? 4e-3 : 4e-4) << tolerance;
    EXPECT_LT(worst, 0.5 * before);
    before = worst;
  }
}

}  // namespace
}  // namespace careen
