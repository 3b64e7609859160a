// Method exact on the hard cases, against their truths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "study/own_methods.h"
#include "study/truths.h"
#include "support/quad_scene_file.h"

namespace careen::study {
namespace {

using nlohmann::json;
using States = std::vector<std::vector<BodyState>>;

World worldOf(const std::string& name) {
  const Scene scene = readScene(scenePath(name));
  return assemble(scene, plan(scene));
}

States exactOn(const World& world, const std::vector<double>& times) {
  const Contestants all = ownMethods();
  const auto exact =
      std::find_if(all.begin(), all.end(), [](const auto& each) { return each->name() == "exact"; });
  EXPECT_EQ((*exact)->refuses(world), "");
  return (*exact)->run(world, 1, times, {});
}

std::string brief(double value) {
  std::ostringstream text;
  text.precision(2);
  text << value;
  return text.str();
}

Mat3 matrixOf(const std::vector<double>& q) {
  return Quat(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

// The larger of the distance, in half diagonals, and the angle [rad].
double apart(const Body& body, const Pose& pose, const std::vector<double>& position, const Mat3& turn) {
  const double distance = (pose.position - Vec3(position[0], position[1], position[2])).norm();
  const double chord = (pose.worldFromBody - turn).norm() / std::sqrt(8.0);
  return std::max(distance / body.halfExtents.norm(), 2 * std::asin(std::min(1.0, chord)));
}

double errorOn(const std::string& name) {
  const json truth = oracle::jsonIn(truthPath(name));
  const World world = worldOf(name);
  const States states = exactOn(world, truth.at("times").get<std::vector<double>>());
  double worst = 0;
  std::size_t entry = 0;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    if (isImmovable(world.bodies[i].mass)) {
      continue;
    }
    const json& box = truth.at("boxes").at(entry++);
    for (std::size_t k = 0; k < states.size(); ++k) {
      worst = std::max(worst, apart(world.bodies[i], states[k][i].pose,
                                    box.at("positions").at(k).get<std::vector<double>>(),
                                    matrixOf(box.at("orientations").at(k).get<std::vector<double>>())));
    }
  }
  return worst;
}

struct Bound {
  const char* name;
  double bound;  // on the error
};

// Three times what was measured.
const std::vector<Bound> kBounds = {
    {"bounce-1000", 3e-12},          // measured 8e-13; 894 s, rounded to 1.1e-13 s
    {"corner-impact", 2e-14},        // measured 3.9e-15
    {"far-away", 5e-10},             // measured 1.5e-10; positions are rounded to 1.2e-10 m there
    {"fast-spin", 3e-12},            // measured 6.9e-13; ten thousand radians
    {"free-fall", 3e-13},            // measured 8.5e-14
    {"galperin", 7e-12},             // measured 2.1e-12; the light box is struck 314 times, at up to 100 m/s
    {"grazing-hit", 2e-12},          // measured 5.6e-13
    {"grazing-miss", 2e-15},         // measured 6.3e-16
    {"kilometre", 9e-15},            // measured 2.9e-15
    {"landing-edge", 9e-14},         // measured 2.7e-14
    {"landing-flat", 6e-15},         // measured 1.7e-15
    {"landing-room-corner", 2e-15},  // measured 4.4e-16
    {"millimetre", 9e-15},           // measured 2.8e-15
    {"near-simultaneous-1e-12", 3.2},   // measured 3.1; taken as one impact, see below
    {"near-simultaneous-1e-3", 6e-14},  // measured 2e-14
    {"near-simultaneous-1e-6", 6e-15},  // measured 1.9e-15
    {"near-simultaneous-1e-9", 2e-14},  // measured 4.7e-15
    {"needle", 1e-13},                  // measured 3.2e-14
    {"plate", 4e-15},                   // measured 1.2e-15
    {"separatrix-1e-3", 2e-14},         // measured 3.9e-15
    {"separatrix-1e-6", 3e-14},         // measured 7.7e-15
    {"separatrix-1e-9", 3e-14},         // measured 8.9e-15
    {"thin-wall", 3e-13},               // measured 9.5e-14
    {"tumble-generic", 3e-15},          // measured 1e-15
    {"tumble-middle-axis", 4e-14},      // measured 1.2e-14
    {"zeno-half", 3e-15},               // measured 7.7e-16
    {"zeno-nine", 4e-14},               // measured 1.1e-14
};

class ExactOnHardCases : public testing::TestWithParam<Bound> {};

TEST_P(ExactOnHardCases, isWhereTheTruthIs) {
  const auto& [name, bound] = GetParam();
  const double error = errorOn(name);
  std::cout << name << ": " << brief(error) << '\n';
  RecordProperty("error", brief(error));
  EXPECT_LE(error, bound);
}

std::string caseName(const testing::TestParamInfo<Bound>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, ExactOnHardCases, testing::ValuesIn(kBounds), caseName);

TEST(ExactOnHardCasesAll, coversEveryTruthOfPoses) {
  for (const std::string& name : truthNames()) {
    const bool covered =
        std::any_of(kBounds.begin(), kBounds.end(), [&name](const Bound& each) { return each.name == name; });
    EXPECT_EQ(covered, oracle::jsonIn(truthPath(name)).at("measure") == "poses") << name;
  }
}

// Edges within 2⁻³⁰ half diagonals of the floor count as landing at one moment, and an impact on the whole
// face sends the cube straight back: the one hard case whose truth is out of reach, because one impact after
// the other has another limit.
TEST(ExactOnHardCasesAll, takesImpactsWithinItsToleranceOfSimultaneousAsOne) {
  const std::string name = "near-simultaneous-1e-12";
  const World world = worldOf(name);
  const Pose end = exactOn(world, {1.2}).back()[0].pose;
  EXPECT_LT((end.worldFromBody - Mat3::Identity()).norm(), 1e-11);
  EXPECT_GT(errorOn(name), 1);
  EXPECT_LT(errorOn("near-simultaneous-1e-9"), 1e-13);
}

double energyOf(const World& world, const BodyState& state) {
  const MassProperties& mass = world.bodies[0].mass;
  return 0.5 * mass.mass * state.velocity.squaredNorm() +
         0.5 * angularVelocity(mass, state).dot(state.angularMomentum) -
         mass.mass * world.gravity.dot(state.pose.position);
}

double energyChangeOn(const std::string& name) {
  const World world = worldOf(name);
  const json truth = oracle::jsonIn(truthPath(name));
  const double before = energyOf(world, world.bodies[0].initial);
  double worst = 0;
  for (const auto& state : exactOn(world, truth.at("times").get<std::vector<double>>())) {
    worst = std::max(worst, std::fabs(energyOf(world, state[0]) / before - 1));
  }
  std::cout << name << ": energy changed by " << brief(worst) << '\n';
  return worst;
}

TEST(ExactOnHardCasesAll, keepsEnergyInRooms) {
  EXPECT_LT(energyChangeOn("room-minute"), 1e-14);   // measured 2.9e-15
  EXPECT_LT(energyChangeOn("room-million"), 1e-11);  // measured 1.7e-12
}

TEST(ExactOnHardCasesAll, comesBackWhereItBegan) {
  World world = worldOf("reversal");
  const BodyState start = world.bodies[0].initial;
  const double duration = oracle::jsonIn(scenePath("reversal")).at("duration").get<double>();
  BodyState& state = world.bodies[0].initial;
  for (int way = 0; way < 2; ++way) {
    state = exactOn(world, {duration}).back()[0];
    state.velocity = -state.velocity;
    state.angularMomentum = -state.angularMomentum;
  }
  const Vec3& x = start.pose.position;
  const double error = apart(world.bodies[0], state.pose, {x[0], x[1], x[2]}, start.pose.worldFromBody);
  std::cout << "reversal: " << brief(error) << '\n';
  EXPECT_LT(error, 1e-10);  // measured 8.9e-12
}

TEST(ExactOnHardCasesAll, scalesToTheBit) {
  const json truth = oracle::jsonIn(truthPath("scaled"));
  const double lengths = truth.at("lengths").get<double>();
  const double times = truth.at("times").get<double>();
  auto moments = oracle::jsonIn(truthPath("corner-impact")).at("times").get<std::vector<double>>();
  const States one = exactOn(worldOf("corner-impact"), moments);
  for (double& moment : moments) {
    moment *= times;
  }
  const States other = exactOn(worldOf("scaled"), moments);
  for (std::size_t k = 0; k < moments.size(); ++k) {
    EXPECT_EQ(Vec3(lengths * one[k][0].pose.position), other[k][0].pose.position);
    EXPECT_EQ(one[k][0].pose.worldFromBody, other[k][0].pose.worldFromBody);
    EXPECT_EQ(Vec3(lengths / times * one[k][0].velocity), other[k][0].velocity);
  }
}

}  // namespace
}  // namespace careen::study
