#include "trajectory/given_run.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "core/math/pose_difference.h"
#include "support/exact_runs.h"
#include "support/input_error.h"
#include "trajectory/export_csv.h"
#include "trajectory/export_npz.h"
#include "trajectory/pose_table.h"

namespace careen {
namespace {

RunSetup setupOf(const World& world) {
  RunSetup setup{.sceneText = "", .settings = {.duration = 1}, .world = world, .stage = {}, .plan = {}};
  setup.stage.colors.resize(world.bodies.size());
  return setup;
}

std::string csvOf(const Trajectory& run, double every) {
  std::string text;
  writePosesCsv(run, every, [&text](std::string_view piece) { text += piece; });
  return text;
}

// Without the columns that begin with `letter`.
std::string without(char letter, const std::string& csv) {
  std::istringstream lines(csv);
  std::string text;
  std::vector<bool> kept;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string shorter;
    std::size_t k = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++k) {
      if (text.empty() && kept.size() <= k) {
        kept.push_back(cell[0] != letter);
      }
      if (kept[k]) {
        shorter += (shorter.empty() ? "" : ",") + cell;
      }
    }
    text += shorter + '\n';
  }
  return text;
}

World falling(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  const auto vector = [&](double size) -> Vec3 {
    return size * Vec3(number(random), number(random), number(random));
  };
  World world;
  world.gravity = Vec3(0, 0, -9.81);
  for (const char* const name : {"a", "b"}) {
    world.bodies.push_back(box(name, Vec3(0.2, 0.3, 0.4) + vector(0.1), 1,
                               vector(3) + Vec3(name[0] == 'a' ? 9 : 0, 0, 0), vector(2), vector(6)));
  }
  return world;
}

// Tables are of boxes: the centre of mass is found from them.
TEST(GivenRun, aTableOfLoadedBoxesIsThatRunAtItsRows) {
  std::mt19937 random(5);
  double worst = 0;
  for (int trial = 0; trial < 30; ++trial) {
    World world = falling(random);
    world.bodies[0].boxCenter = Vec3(0.05, -0.02, 0.1);
    const Trajectory run = record(world, {.duration = 0.5}, "");
    const Trajectory given = givenRun(setupOf(world), readPoseTable(csvOf(run, 0.01), "t.csv"));
    const Trajectory estimated =
        givenRun(setupOf(world), readPoseTable(without('v', csvOf(run, 0.01)), "t.csv"));
    for (int k = 0; k <= 50; ++k) {
      const double time = std::min(k * 0.01, 0.5);
      const BodyState expected = run.state(0, time);
      const BodyState found = given.state(0, time);
      worst = std::max({worst, (found.pose.position - expected.pose.position).norm(),
                        (found.velocity - expected.velocity).norm(),
                        (found.angularMomentum - expected.angularMomentum).norm()});
      EXPECT_LT((estimated.state(0, time).velocity - expected.velocity).norm(), 0.02) << trial << ' ' << k;
    }
  }
  EXPECT_LT(worst, 2e-14);
}

TEST(GivenRun, aTableOfARunIsThatRunAtItsRows) {
  std::mt19937 random(3);
  double worst = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const World world = falling(random);
    const Trajectory run = record(world, {.duration = 0.5}, "");
    for (const bool isNpz : {false, true}) {
      const PoseTable table =
          isNpz ? readPoseTable(encodeNpz(run, 0.01), "t.npz") : readPoseTable(csvOf(run, 0.01), "t.csv");
      const Trajectory given = givenRun(setupOf(world), table);
      EXPECT_EQ(given.settings.duration, 0.5);
      EXPECT_TRUE(given.given.has_value());
      for (int k = 0; k <= 50; ++k) {
        for (std::size_t body = 0; body < 2; ++body) {
          const double time = std::min(k * 0.01, 0.5);
          const BodyState expected = run.state(body, time);
          const BodyState found = given.state(body, time);
          EXPECT_EQ(found.pose.position, expected.pose.position);
          EXPECT_EQ(found.velocity, expected.velocity);
          worst = std::max(worst, angleBetween(found.pose.worldFromBody, expected.pose.worldFromBody));
          worst = std::max(worst, (found.angularMomentum - expected.angularMomentum).norm());
        }
      }
    }
  }
  EXPECT_LT(worst, 1e-14);  // measured 3.6e-15
}

// Hermite polynomials of degree 3: the error of a place in free fall is rounding, of attitudes of fourth
// order.
TEST(GivenRun, betweenRowsItMovesSmoothly) {
  std::mt19937 random(4);
  std::array<double, 2> worst{};
  for (int trial = 0; trial < 100; ++trial) {
    const World world = falling(random);
    const Trajectory run = record(world, {.duration = 0.4}, "");
    for (std::size_t halved = 0; halved < 2; ++halved) {
      const double every = halved == 0 ? 0.02 : 0.01;
      const Trajectory given = givenRun(setupOf(world), readPoseTable(csvOf(run, every), "t"));
      for (int k = 0; k < 39; ++k) {
        const double time = 0.005 + 0.01 * k;
        EXPECT_LT((given.state(0, time).pose.position - run.state(0, time).pose.position).norm(), 1e-14);
        worst[halved] = std::max(worst[halved], angleBetween(given.state(0, time).pose.worldFromBody,
                                                             run.state(0, time).pose.worldFromBody));
      }
    }
  }
  EXPECT_LT(worst[0], 5e-6);            // measured 9.6e-7
  EXPECT_GT(worst[0] / worst[1], 8.0);  // measured 9: 2⁴, at ¼ and ½ of the way from row to row, (3/4)²
}

TEST(GivenRun, velocitiesThatAreMissingAreEstimated) {
  std::mt19937 random(5);
  std::array<double, 2> worst{};
  for (int trial = 0; trial < 100; ++trial) {
    const World world = falling(random);
    const Trajectory run = record(world, {.duration = 0.4}, "");
    for (std::size_t halved = 0; halved < 2; ++halved) {
      const double every = halved == 0 ? 0.02 : 0.01;
      const Trajectory given =
          givenRun(setupOf(world), readPoseTable(without('w', without('v', csvOf(run, every))), "t"));
      EXPECT_FALSE(given.given->velocities);
      EXPECT_FALSE(given.given->angularVelocities);
      for (int k = 0; k <= 20; ++k) {
        const BodyState found = given.state(1, std::min(0.02 * k, 0.4));
        const BodyState expected = run.state(1, std::min(0.02 * k, 0.4));
        EXPECT_LT((found.velocity - expected.velocity).norm(), 1e-12);  // measured 2.4e-13: a parabola
        const MassProperties& mass = world.bodies[1].mass;
        worst[halved] =
            std::max(worst[halved], (angularVelocity(mass, found) - angularVelocity(mass, expected)).norm());
      }
    }
  }
  EXPECT_LT(worst[0], 0.1);             // rad/s of up to 10; measured 0.05
  EXPECT_GT(worst[0] / worst[1], 3.0);  // second order
}

// A ball's path with a bounce between two rows: the parabolas do not cross it.
TEST(GivenRun, estimatesDoNotCrossAnImpact) {
  std::vector<double> times;
  std::vector<Vec3> places;
  for (int k = 0; k < 20; ++k) {
    const double time = 0.05 * k;
    const double after = time - 0.53;
    times.push_back(time);
    places.emplace_back(0, 0, after < 0 ? -5 * time * time + 5 * 0.53 * 0.53 : 4 * after - 5 * after * after);
  }
  const std::vector<Vec3> rates = estimatedRates(times, places);
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double after = times[k] - 0.53;
    EXPECT_NEAR(rates[k].z(), after < 0 ? -10 * times[k] : 4 - 10 * after, 1e-12) << k;
  }
  EXPECT_EQ(estimatedRates(std::vector<double>{1}, std::vector<Vec3>{Vec3::Ones()})[0], Vec3::Zero());
  EXPECT_EQ(estimatedRates(std::vector<double>{1, 3}, std::vector<Vec3>{Vec3::Zero(), Vec3::Ones()})[1],
            Vec3::Constant(0.5));
}

TEST(GivenRun, signsOfQuaternionsDoNotMatter) {
  std::mt19937 random(6);
  const World world = falling(random);
  PoseTable table = readPoseTable(csvOf(record(world, {.duration = 0.4}, ""), 0.01), "t");
  const Trajectory same = givenRun(setupOf(world), table);
  for (PoseRow& row : table.rows) {
    if (random() % 2 == 0) {
      row.worldFromBody.coeffs() = -row.worldFromBody.coeffs();
    }
  }
  table.hasAngularVelocities = false;
  const Trajectory flipped = givenRun(setupOf(world), table);
  for (int k = 0; k < 80; ++k) {
    EXPECT_LT(angleBetween(flipped.state(0, 0.005 * k).pose.worldFromBody,
                           same.state(0, 0.005 * k).pose.worldFromBody),
              1e-5);
  }
}

TEST(GivenRun, aTableThatBeginsLaterBeginsAsTheSceneDoes) {
  World world;
  world.bodies = {box("a", Vec3::Ones(), 1, Vec3(0, 0, 0), Vec3(1, 0, 0))};
  const Trajectory run = givenRun(setupOf(world), readPoseTable("time,x,y,z,qw,qx,qy,qz\n"
                                                                "0.5,0.5,0,0,1,0,0,0\n"
                                                                "1,1,0,0,1,0,0,0\n",
                                                                "t"));
  EXPECT_EQ(run.settings.duration, 1);
  EXPECT_EQ(run.state(0, 0).pose.position, Vec3::Zero());
  EXPECT_NEAR((run.state(0, 0.25).pose.position - Vec3(0.25, 0, 0)).norm(), 0, 1e-15);
}

TEST(GivenRun, theFirstToEndEndsTheRun) {
  World world;
  world.bodies = {box("a", Vec3::Ones(), 1, Vec3(0, 0, 0)), box("b", Vec3::Ones(), 1, Vec3(9, 0, 0))};
  const Trajectory run = givenRun(setupOf(world), readPoseTable("time,box,x,y,z,qw,qx,qy,qz\n"
                                                                "0,a,0,0,0,1,0,0,0\n"
                                                                "0,b,9,0,0,1,0,0,0\n"
                                                                "1,a,1,0,0,1,0,0,0\n"
                                                                "0.75,b,9,0,0,1,0,0,0\n",
                                                                "t"));
  EXPECT_EQ(run.settings.duration, 0.75);
  EXPECT_NEAR(run.state(0, 0.75).pose.position.x(), 0.75, 1e-15);
}

TEST(GivenRun, otherScenesAreRefused) {
  World world;
  world.bodies = {box("a", Vec3::Ones(), 1, Vec3::Zero()), box("b", Vec3::Ones(), 1, Vec3(9, 0, 0)),
                  box("table", Vec3::Ones(), 1, Vec3(0, 9, 0))};
  world.bodies[2].mass = immovable();
  const auto refusalOf = [&](const std::string& rows,
                             const std::string& header = "time,box,x,y,z,qw,qx,qy,qz\n") {
    return inputErrorOf([&] { givenRun(setupOf(world), readPoseTable(header + rows, "t.csv")); });
  };
  const std::string a = "0,a,0,0,0,1,0,0,0\n1,a,0,0,0,1,0,0,0\n";
  const std::string b = "0,b,9,0,0,1,0,0,0\n1,b,9,0,0,1,0,0,0\n";
  EXPECT_EQ(refusalOf(a + b), "no error");
  EXPECT_EQ(refusalOf(a + b + "0,table,0,9,0,-1,0,0,0\n"), "no error");
  EXPECT_EQ(
      refusalOf(a + b + "0,table,0,9.1,0,1,0,0,0\n"),
      "t.csv:6: found the fixed box 'table' 0.1 m and 0 rad away from where the scene has it, expected it "
      "there");
  EXPECT_EQ(refusalOf(a), "t.csv: found no rows of box 'b', expected all boxes of the scene that can move");
  EXPECT_EQ(refusalOf(a + b + "0,c,0,0,0,1,0,0,0\n"),
            "t.csv:6: found the unknown box 'c', expected a box of the scene: a, b, table");
  EXPECT_EQ(refusalOf(a + "0,b,9,0,0,1,0,0,0\n"),
            "t.csv:4: found no row of box 'b' after 0 s, expected a run that lasts");
  EXPECT_EQ(
      refusalOf("0,0,0,0,1,0,0,0\n", "time,x,y,z,qw,qx,qy,qz\n"),
      "t.csv:2: found no column of boxes, expected it, as the scene has other than one box that can move");
}

}  // namespace
}  // namespace careen
