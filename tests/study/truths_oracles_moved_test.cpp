// Truths of what lies on, or before, fixed boxes that move: computed in another way, and by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

#include "study/truths.h"
#include "support/moved_oracles.h"
#include "support/quad_scene_file.h"

namespace careen::study {
namespace {

using oracle::QuadBox;
using oracle::QuadNewmark;
using oracle::QuadPoses;
using oracle::QuadPushed;
using oracle::QuadScene;

QuadScene movedScene(const std::string& name) { return oracle::sceneIn(scenePath(name)); }

// [m] By steps of 1e-6 s; where the slip is less than a step may change, it rides.
double steppedBlock(const QuadBox& box, const QuadBox& table, double pull, int steps) {
  constexpr double kStep = 1e-6;
  const auto most = static_cast<double>(frictionOf(box, table)) * pull;
  const auto amplitude = static_cast<double>(table.amplitude[0]);
  const auto rate = static_cast<double>(table.rate);
  auto x = static_cast<double>(box.position[0]);
  auto v = static_cast<double>(box.velocity[0]);
  for (int k = 0; k < steps; ++k) {
    const double middle = (k + 0.5) * kStep;
    const double slip = v - amplitude * rate * std::cos(rate * middle);
    const double follows = -amplitude * rate * rate * std::sin(rate * middle);
    const bool rides = std::fabs(slip) < 2 * most * kStep && std::fabs(follows) <= most;
    const double a = rides ? follows : slip > 0 ? -most : most;
    x += kStep * (v + 0.5 * kStep * a);
    v += kStep * a;
  }
  return x;
}

// Measured 8e-6 m, which is that of the steps. In 8.8 half periods what is not carried slips in each, one way
// and the other; what slips all the time has one change in each, what rides in between has two.
TEST(TruthsOfMoved, ofAShakingTableAreThoseOfSmallSteps) {
  const QuadScene scene = movedScene("shaking-table");
  const QuadBox& table = scene.boxes.at(0);
  const std::vector<double> end{scene.duration};
  double worst = 0;
  std::vector<int> changes;
  for (std::size_t i = 1; i < scene.boxes.size(); ++i) {
    QuadNewmark block(scene.boxes[i], table, scene.gravity);
    const auto x = static_cast<double>(block.poses(end).back().position[0]);
    worst = std::max(worst, std::fabs(x - steppedBlock(scene.boxes[i], table, 9.81, 4'000'000)));
    changes.push_back(block.changes());
  }
  std::cout << "shaking-table: two oracles apart by " << worst << '\n';
  EXPECT_LT(worst, 2e-5);
  EXPECT_LE(changes[0], 1);  // by the rounding of its speed at the start
  for (const std::size_t rides : {1U, 2U, 3U}) {
    EXPECT_NEAR(changes[rides], 18, 1) << rides;
  }
  for (const std::size_t slips : {4U, 5U}) {
    EXPECT_EQ(changes[slips], 9) << slips;
  }
}

// A ω² = 9.554 m/s² is less than .98 g, and more than .965 g.
TEST(TruthsOfMoved, ofAShakingTableRideUpToFriction) {
  const QuadScene scene = movedScene("shaking-table");
  const std::vector<double> times = timesOf("shaking-table", scene);
  const QuadBox& table = scene.boxes.at(0);
  const auto furthest = [&](const QuadBox& box) {
    double away = 0;
    const QuadPoses poses = QuadNewmark(box, table, scene.gravity).poses(times);
    for (std::size_t k = 0; k < times.size(); ++k) {
      const Quad rides = table.amplitude[0] * sin(table.rate * times[k]);
      away = std::max(away, static_cast<double>(abs(Quad(poses[k].position[0] - rides))));
    }
    return away;
  };
  EXPECT_LT(furthest(scene.boxes.at(1)), 1e-15);
  EXPECT_GT(furthest(scene.boxes.at(2)), 5e-5);
  EXPECT_LT(furthest(scene.boxes.at(2)), 1e-4);
}

// By hand: with e = 0 it stands on the lift, goes on at 1.2 m/s where that stops, and falls where it goes
// down at 1 m/s, for 2/g. With e = .8 the start throws it at .96 m/s, which takes it .96²/2g up, and it hops
// for .96 · 2/g / .2 = .979 s.
TEST(TruthsOfMoved, ofALiftAreThoseWorkedOutByHand) {
  const QuadScene scene = movedScene("lift-stops");
  constexpr double kPull = 9.81;
  const auto height = [&](std::size_t box, double time) {
    return static_cast<double>(
        onLift(scene.boxes.at(box), scene.boxes.at(0), scene.gravity, std::vector<double>{time})
            .back()
            .position[2]);
  };
  EXPECT_EQ(height(1, 0.5), 0.1);
  EXPECT_NEAR(height(1, 1), 0.1 + 0.6, 1e-15);
  EXPECT_NEAR(height(1, 1.85), 1.6 + 0.12 - 0.5 * kPull * 0.01, 1e-15);
  EXPECT_NEAR(height(1, 2.3), 1.6, 1e-15);
  EXPECT_NEAR(height(1, 2.6), 1.6 - 0.5 * kPull * 0.01, 1e-15);
  EXPECT_NEAR(height(1, 2.5 + 2.1 / kPull), 1.6 - 2.1 / kPull, 1e-15);
  EXPECT_NEAR(height(1, 4), 0.85, 1e-15);
  const double up = 0.96 / kPull;
  EXPECT_NEAR(height(4, 0.5 + up), 0.1 + 1.2 * up + 0.5 * kPull * up * up, 1e-15);
  EXPECT_GT(height(4, 0.5 + 0.978), 0.1 + 1.2 * 0.978 + 1e-9);
  EXPECT_NEAR(height(4, 0.5 + 0.979), 0.1 + 1.2 * 0.979, 1e-15);
}

// By hand: at rest in front of it they are met after gap / .5 s, and all end before it. What it gave is their
// energy, what friction took on their way, and what the impacts took, which is once the energy with which
// they meet, whatever restitution is.
TEST(TruthsOfMoved, ofAPusherKeepTheBalanceOfEnergy) {
  const QuadScene scene = movedScene("pusher");
  const QuadBox& plate = scene.boxes.at(0);
  const std::vector<double> start{0};
  const std::vector<double> end{scene.duration};
  for (std::size_t i = 1; i < scene.boxes.size(); ++i) {
    const QuadBox& box = scene.boxes[i];
    const QuadPushed pushed(box, plate, scene.gravity, scene.walls.at(0));
    const Quad way = pushed.poses(end).back().position[0] - box.position[0];
    EXPECT_EQ(pushed.poses(start).back().position[0], box.position[0]);
    EXPECT_LT(abs(Quad(way + box.position[0] - 2)), Quad(1e-30)) << box.name;
    const Quad rubs = box.mass * frictionOf(box, scene.walls.at(0)) * Quad(9.81);
    // [m/s] Against the plate where they meet: by the way that friction had until then.
    const Quad slid =
        pushed.poses(std::vector<double>{static_cast<double>(pushed.meets())}).back().position[0] -
        box.position[0];
    const Quad left = box.velocity[0] * box.velocity[0] - 2 * rubs / box.mass * slid;
    const Quad against = plate.velocity[0] - (left > Quad(1e-12) ? Quad(sqrt(left)) : Quad(0));
    const Quad given =
        box.mass / 2 *
            (plate.velocity[0] * plate.velocity[0] - box.velocity[0] * box.velocity[0] + against * against) +
        rubs * way;
    EXPECT_LT(abs(Quad(pushed.work(scene.duration) - given)), Quad(1e-12)) << box.name;
  }
  // 2 kg, μ = .4, from .5 s on: 2 · .5 (.5 + .4 g 3.5) J.
  const QuadPushed first(scene.boxes.at(1), plate, scene.gravity, scene.walls.at(0));
  EXPECT_NEAR(static_cast<double>(first.work(scene.duration)), 14.234, 1e-12);
  EXPECT_NEAR(static_cast<double>(first.meets()), 0.5, 1e-15);
}

}  // namespace
}  // namespace careen::study
