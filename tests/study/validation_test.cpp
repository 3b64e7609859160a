// Measurements are made here: runs sampled at 148 Hz, with the noise that measured tosses of a cube have.
#include "study/validation.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene_reader.h"
#include "support/input_error.h"

namespace careen {
namespace {

constexpr double kRate = 148;          // [1/s]
constexpr double kUp = 20e-6;          // [m] noise of positions
constexpr double kSideways = 55e-6;    // [m]
constexpr double kAttitude = 0.44e-3;  // [rad] about each axis

const char* const kCube = R"({"careen": 1, "name": "cube", "duration": 1, "gravity": [0, 0, -9.81],
  "walls": [{"name": "floor", "point": [0, 0, 0], "normal": [0, 0, 1], "friction": FRICTION,
             "restitution": RESTITUTION}],
  "boxes": [{"name": "cube", "half_extents": [0.0524, 0.0524, 0.0524], "mass": 0.37, "position": [0, 0, 1],
             "inertia": [INERTIA, INERTIA, INERTIA], "friction": FRICTION, "restitution": RESTITUTION}]})";

// What a measured cube is, by default the published one.
struct Parameters {
  std::string friction = "0.18";
  std::string restitution = "0.125";
  std::string inertia = "0.81e-3";
};

Scene cube(const Parameters& parameters = {}) {
  std::string text = kCube;
  for (const auto& [name, value] :
       {std::pair("FRICTION", parameters.friction), std::pair("RESTITUTION", parameters.restitution),
        std::pair("INERTIA", parameters.inertia)}) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name)) {
      text.replace(at, std::string(name).size(), value);
    }
  }
  return parseScene(text, "cube.json");
}

// A toss across the floor, as someone might measure it: its clock does not begin at 0, and there are no
// velocities.
PoseTable tossOf(std::mt19937_64& random, double noise, const Parameters& parameters = {}) {
  std::uniform_real_distribution<double> number(-1, 1);
  std::normal_distribution<double> normal;
  RunSetup setup = setupOfMeasured(cube(parameters));
  BodyState& start = setup.world.bodies[0].initial;
  start.pose.position = Vec3(0.1 * number(random), 0.1 * number(random), 0.2);
  start.pose.worldFromBody =
      Quat(normal(random), normal(random), normal(random), normal(random)).normalized().toRotationMatrix();
  start.velocity = Vec3(1.2, 0.3 * number(random), 0.4 * number(random));
  start.angularMomentum = angularMomentum(setup.world.bodies[0].mass, start.pose.worldFromBody,
                                          4 * Vec3(number(random), number(random), number(random)));
  const Trajectory run = record(setup);
  PoseTable table;
  table.name = "toss.csv";
  table.placeFormat = "line";
  table.boxes = {"cube"};
  table.hasBoxes = true;
  for (int k = 0; k / kRate < 0.9; ++k) {
    const Pose pose = run.state(0, k / kRate).pose;
    PoseRow row;
    row.time = 5 + k / kRate;
    const Vec3 off(kSideways * normal(random), kSideways * normal(random), kUp * normal(random));
    const Vec3 turn = 0.5 * kAttitude * noise * Vec3(normal(random), normal(random), normal(random));
    row.position = pose.position + noise * off;
    row.worldFromBody = (Quat(1, turn.x(), turn.y(), turn.z()) * Quat(pose.worldFromBody)).normalized();
    table.rows.push_back(row);
  }
  return table;
}

TEST(Validation, ofItsOwnRunsWithoutNoiseIsExact) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 10; ++trial) {
    const Toss toss = validate(setupOfMeasured(cube()), tossOf(random, 0), {}, {});
    EXPECT_LT(toss.largestPlace, 1e-5);  // 100 and more impacts and 1e-6 m of tolerance; measured 2e-7
    EXPECT_LT(toss.largestAttitude, 1e-4);
    EXPECT_GT(toss.fitted, 4U);
    EXPECT_EQ(toss.measuredFace, toss.simulatedFace);
    EXPECT_EQ(toss.times.front(), 0);
    EXPECT_NEAR(toss.times.back(), 0.9, 1 / kRate);
    EXPECT_GT(toss.impacts, 3U);
  }
}

// With noise, the error is what the noise of the start makes.
TEST(Validation, theFloorTellsTheErrorOfRightParameters) {
  std::mt19937_64 random(2);
  std::vector<Toss> tosses;
  for (int trial = 0; trial < 16; ++trial) {
    tosses.push_back(validate(setupOfMeasured(cube()), tossOf(random, 1), {}, {}));
    EXPECT_GT(tosses.back().positionNoise, 20e-6);
    EXPECT_LT(tosses.back().positionNoise, 80e-6);
    EXPECT_NEAR(tosses.back().attitudeNoise, kAttitude, 0.5 * kAttitude);
  }
  const double error = spreadOf(tosses, &Toss::meanPlace).mean;
  const double floor = spreadOf(tosses, &Toss::floorPlace).mean;
  EXPECT_GT(floor, 1e-5);
  EXPECT_LT(error, 4 * floor + kSideways);
  EXPECT_GT(error, floor / 8);
}

// Mean errors of place of eight tosses of a cube with these parameters, simulated with values of one of them.
std::vector<SweepPoint> swept(const Parameters& parameters, Parameter parameter,
                              const std::vector<double>& values) {
  std::mt19937_64 random(3);
  std::vector<PoseTable> tables;
  for (int trial = 0; trial < 8; ++trial) {
    tables.push_back(tossOf(random, 1, parameters));
  }
  ValidationSettings settings{.floorRuns = 0};
  std::vector<SweepPoint> points;
  for (const double value : values) {
    settings.setting = Setting{.parameter = parameter, .value = value};
    std::vector<Toss> tosses;
    for (const PoseTable& table : tables) {
      tosses.push_back(validate(setupOfMeasured(cube()), table, settings, {}));
    }
    points.push_back({.value = value, .place = spreadOf(tosses, &Toss::meanPlace).mean});
  }
  return points;
}

TEST(Validation, aSweepFindsTheFrictionAgain) {
  const std::vector<SweepPoint> points =
      swept({.friction = "0.22"}, Parameter::kFriction, {0.1, 0.14, 0.18, 0.22, 0.26, 0.3});
  // Measured: 1.1e-4 m there, 0.021 m and more beside.
  EXPECT_NEAR(minimumOf(points), 0.22, 0.02);
  EXPECT_LT(points[3].place, 0.2 * points[0].place);
}

TEST(Validation, aSweepFindsTheRestitutionAgain) {
  const std::vector<SweepPoint> points =
      swept({.restitution = "0.3"}, Parameter::kRestitution, {0.1, 0.2, 0.3, 0.4, 0.5});
  // Measured: 1.1e-4 m there, 0.011 m and more beside.
  EXPECT_NEAR(minimumOf(points), 0.3, 0.05);
  EXPECT_LT(points[2].place, 0.2 * points[0].place);
}

// 1.2 times the scene's. Measured: 3.6e-4 m there, 6.2e-3 m and more beside.
TEST(Validation, aSweepFindsTheInertiaAgain) {
  const std::vector<SweepPoint> points =
      swept({.inertia = "0.972e-3"}, Parameter::kInertia, {0.8, 1, 1.2, 1.4, 1.6});
  EXPECT_NEAR(minimumOf(points), 1.2, 0.1);
  EXPECT_LT(points[2].place, 0.2 * points[0].place);
}

TEST(Validation, theFirstRowIsAStartToo) {
  std::mt19937_64 random(4);
  const PoseTable table = tossOf(random, 1);
  Trajectory run;
  const Toss toss = validate(setupOfMeasured(cube()), table, {.start = MeasuredStart::kFirst}, {}, &run);
  EXPECT_EQ(toss.fitted, 0U);
  EXPECT_EQ(toss.place.front(), 0);
  EXPECT_EQ(run.state(0, 0).pose.position, table.rows[0].position);
}

TEST(Validation, minimaLieBetweenPoints) {
  // (x − 0.17)²
  std::vector<SweepPoint> points;
  for (const double value : {0.1, 0.15, 0.2, 0.25}) {
    points.push_back({.value = value, .place = (value - 0.17) * (value - 0.17)});
  }
  EXPECT_NEAR(minimumOf(points), 0.17, 1e-15);
  EXPECT_EQ(minimumOf({{.value = 1, .place = 1}, {.value = 2, .place = 2}}), 1);
  EXPECT_EQ(minimumOf({{.value = 1, .place = 1}}), 1);
}

TEST(Validation, valuesAreThoseOfEveryPair) {
  World world = setupOfMeasured(cube()).world;
  EXPECT_DOUBLE_EQ(*valueOf(world, Parameter::kFriction), 0.18);
  EXPECT_EQ(valueOf(world, Parameter::kRestitution), 0.125);
  EXPECT_NEAR(sizeOf(world), 0.1048, 1e-15);
  world.walls.push_back(world.walls[0]);
  world.walls[1].material.friction = 0.5;
  EXPECT_FALSE(valueOf(world, Parameter::kFriction));
}

TEST(Validation, tablesAreWrittenInFull) {
  std::mt19937_64 random(5);
  const std::vector<Toss> tosses = {validate(setupOfMeasured(cube()), tossOf(random, 1), {}, {})};
  const std::string results = tossesCsv(tosses, 0.1048);
  EXPECT_EQ(std::count(results.begin(), results.end(), '\n'), 2);
  EXPECT_EQ(std::count(results.begin(), results.end(), ','), 2 * 15);
  const std::string errors = errorsCsv(tosses);
  EXPECT_EQ(static_cast<std::size_t>(std::count(errors.begin(), errors.end(), '\n')),
            1 + tosses[0].times.size());
  EXPECT_TRUE(sweepCsv({{.value = 0.5, .place = 1, .attitude = 2}}, Parameter::kFriction)
                  .starts_with("friction,mean_place,mean_attitude\n0.5,1,2\n"));
}

TEST(Validation, boxesThatTheSceneDoesNotHaveAreRefused) {
  std::mt19937_64 random(6);
  PoseTable table = tossOf(random, 0);
  table.boxes = {"die"};
  EXPECT_NE(inputErrorOf([&] { validate(setupOfMeasured(cube()), table, {}, {}); }).find("unknown box 'die'"),
            std::string::npos);
}

}  // namespace
}  // namespace careen
