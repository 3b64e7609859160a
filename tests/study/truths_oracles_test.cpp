// Truths that can be computed in two independent ways must agree to far more digits than a double has.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <sstream>

#include "study/truths.h"
#include "support/closed_forms.h"
#include "support/quad_scene_file.h"

namespace careen::study {
namespace {

using oracle::QuadPoses;
using oracle::QuadScene;

std::string measured(double value) {
  std::ostringstream text;
  text.precision(2);
  text << value;
  return text.str();
}

struct Tumble {
  const char* name;
  double bound;
  double part = 1;  // of the duration
  bool wide = false;
};

class TruthsOfTumbling : public testing::TestWithParam<Tumble> {};

TEST_P(TruthsOfTumbling, agreeWithExtrapolation) {
  const auto& [name, bound, part, wide] = GetParam();
  const QuadScene scene = oracle::sceneIn(scenePath(name));
  std::vector<double> times = timesOf(name, scene);
  for (double& time : times) {
    time *= part;
  }
  const QuadPoses flight = wide ? oracle::flown<Bits192, 48>(scene, times) : oracle::flown(scene, times);
  const double worst = oracle::furthestApart(flight, flownByExtrapolation(scene, times));
  std::cout << name << ": two oracles apart by " << measured(worst) << '\n';
  RecordProperty("apart", measured(worst));
  EXPECT_LT(worst, bound);
}

std::string tumbleName(const testing::TestParamInfo<Tumble>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// Rotation about the middle axis amplifies rounding errors, so its truths use more bits: Quads on both sides
// agree only to 3e-12 beside the separatrix.
INSTANTIATE_TEST_SUITE_P(All, TruthsOfTumbling,
                         testing::Values(Tumble{"tumble-generic", 1e-25},               // measured 3.3e-33
                                         Tumble{"tumble-middle-axis", 1e-25, 1, true},  // measured 4.5e-35
                                         Tumble{"separatrix-1e-3", 1e-25, 1, true},     // measured 2.4e-35
                                         Tumble{"separatrix-1e-6", 1e-25, 1, true},     // measured 4.8e-35
                                         Tumble{"separatrix-1e-9", 1e-25, 1, true},     // measured 2.2e-34
                                         Tumble{"free-fall", 1e-25},                    // measured 4e-33
                                         Tumble{"fast-spin", 1e-25, 0.02}),             // measured 1.5e-31
                         tumbleName);

// Equal half extents give a symmetric top; extrapolation cannot follow a needle.
TEST(TruthsOfTumblingTops, agreeWithTheClosedFormOfTheSymmetricTop) {
  for (const char* name : {"needle", "plate"}) {
    const QuadScene scene = oracle::sceneIn(scenePath(name));
    const std::vector<double> times = timesOf(name, scene);
    const double worst = oracle::furthestApart(oracle::flown(scene, times), precessed(scene, times));
    std::cout << name << ": two oracles apart by " << measured(worst) << '\n';
    EXPECT_LT(worst, 1e-25);
  }
}

double roomAgainst(const char* name, double step, int impacts, const QuadPoses& others) {
  const QuadScene scene = oracle::sceneIn(scenePath(name));
  const double worst =
      oracle::furthestApart(struck(oracle::QuadRoom(scene, step), timesOf(name, scene), impacts), others);
  std::cout << name << ": two oracles apart by " << measured(worst) << '\n';
  return worst;
}

QuadPoses onFloor(const char* name, double step, int impacts) {
  const QuadScene scene = oracle::sceneIn(scenePath(name));
  return struck(oracle::PlanarBox(scene, step), timesOf(name, scene), impacts);
}

// The room oracle integrates the rotation by its Taylor series and does not assume planar motion.
TEST(TruthsOfImpacts, onEdgesInARoomAndInAPlaneAgree) {
  EXPECT_LT(roomAgainst("landing-edge", 1.0 / 512, 2, onFloor("landing-edge", 1.0 / 512, 2)), 1e-25);
  EXPECT_LT(
      roomAgainst("near-simultaneous-1e-3", 1.0 / 16384, 2, onFloor("near-simultaneous-1e-3", 1.0 / 512, 2)),
      1e-25);
}

TEST(TruthsOfImpacts, thatGrazeInARoomAndInAPlaneAgree) {
  EXPECT_LT(roomAgainst("grazing-hit", 1.0 / 8192, 1, onFloor("grazing-hit", 1.0 / 8192, 1)), 1e-25);
  EXPECT_LT(roomAgainst("grazing-miss", 1.0 / 8192, 0, onFloor("grazing-miss", 1.0 / 8192, 0)), 1e-25);
}

TEST(TruthsOfImpacts, onAFaceInARoomAndInClosedFormAgree) {
  const QuadScene scene = oracle::sceneIn(scenePath("landing-flat"));
  EXPECT_LT(roomAgainst("landing-flat", 1.0 / 512, 2, dropped(scene, timesOf("landing-flat", scene))), 1e-25);
}

// Except for the attitude, which 17 digits give to 1e-16 rad, the way there equals the way back.
TEST(TruthsOfImpacts, onThePlateIsHeadOnButForTheRoundingOfTheStart) {
  const Truth truth = computeTruth("thin-wall");
  const QuadScene scene = oracle::sceneIn(scenePath("thin-wall"));
  const oracle::QuadBox& cube = scene.boxes.at(0);
  const Quad front = cube.halfExtents.norm();
  for (std::size_t k = 0; k < truth.times.size(); ++k) {
    const Quad left = -cube.position[0] - front - cube.velocity[0] * truth.times[k];
    const auto x = static_cast<double>(-front - (left > 0 ? left : -left));
    EXPECT_NEAR(truth.boxes[0].positions[k][0], x, 1e-13);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(truth.boxes[0].orientations[k][i], static_cast<double>(cube.attitude[i]), 1e-12);
    }
  }
}

TEST(TruthsOfImpacts, inTheBilliardUnfoldedAndOneByOneAgree) {
  const QuadScene scene = oracle::sceneIn(scenePath("galperin"));
  const std::vector<double> times = timesOf("galperin", scene);
  int impacts = 0;
  const oracle::QuadPair unfolded = galperinUnfolded(scene, times);
  const oracle::QuadPair oneByOne = galperinStruck(scene, times, impacts);
  EXPECT_EQ(impacts, 314);
  for (std::size_t box = 0; box < 2; ++box) {
    const double worst = oracle::furthestApart(unfolded[box], oneByOne[box]);
    std::cout << "galperin: two oracles apart by " << measured(worst) << '\n';
    EXPECT_LT(worst, 1e-25);
  }
}

// There are two impacts however small the tilt: their limit differs from the impact of the whole face, which
// does not rotate the cube.
TEST(TruthsOfImpacts, onTwoEdgesHaveALimitThatTurnsTheCube) {
  const QuadPoses one = onFloor("near-simultaneous-1e-9", 1.0 / 512, 2);
  const QuadPoses other = onFloor("near-simultaneous-1e-12", 1.0 / 512, 2);
  EXPECT_LT(oracle::furthestApart(one, other), 1e-7);
  EXPECT_LT(one.back().attitude[0], Quad(0.1));
}

}  // namespace
}  // namespace careen::study
