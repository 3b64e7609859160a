#include "sound/block_modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

constexpr SoundMaterial kSteel = kSoundMaterials[2].material;
const double kRod = std::sqrt(kSteel.modulus / kSteel.density);

std::vector<BlockMode> allOf(const Vec3& half, BlockMode::Kind kind, int along, int across) {
  std::vector<BlockMode> modes = modesOf(half, kSteel, 1e9, 1000);
  std::erase_if(modes, [&](const BlockMode& mode) {
    return mode.kind != kind || mode.along != along || mode.across != across;
  });
  return modes;
}

// f₁ = 1.0279 h/L² √(E/ρ), and the ratios 2.7565, 5.4039 (Fletcher and Rossing, 2.16): of a thin plate.
TEST(BlockModes, ofAThinPlateAreThoseOfABeam) {
  const std::vector<BlockMode> bending =
      allOf(Vec3(0.5, 0.05, 0.0025), BlockMode::Kind::kBending, 0, 2);  // 1 m long, 5 mm thick
  ASSERT_EQ(bending.size(), 6U);
  EXPECT_NEAR(bending[0].frequency, 1.0279 * 0.005 * kRod, 2e-4 * bending[0].frequency);
  EXPECT_NEAR(bending[1].frequency / bending[0].frequency, 2.7565, 2e-3);
  EXPECT_NEAR(bending[2].frequency / bending[0].frequency, 5.4039, 5e-3);
}

// Dunkerley: never above the beam without shear, nor above shear without bending.
TEST(BlockModes, ofStubbyBlocksAreLower) {
  const Vec3 half(0.05, 0.04, 0.045);
  const std::vector<BlockMode> bending = allOf(half, BlockMode::Kind::kBending, 0, 1);
  EXPECT_LT(bending[0].frequency, 1.0279 * 0.08 / 0.01 * kRod);
  const double shear = std::sqrt(5.0 / 6 / (2 * (1 + kPoisson))) * kRod / 0.2;
  EXPECT_LT(bending[0].frequency, shear);
  EXPECT_GT(bending[0].frequency, 0.5 * shear);
  EXPECT_TRUE(allOf(half, BlockMode::Kind::kBending, 1, 0).empty())
      << "it bends in its longer direction alone";
}

// K = 0.1406 a⁴ and I = a⁴/6 of a square (S. Timoshenko, J. Goodier, Theory of Elasticity, 109).
TEST(BlockModes, ofASquareBarTwistAndStretch) {
  const Vec3 half(0.5, 0.01, 0.01);
  const std::vector<BlockMode> torsion = allOf(half, BlockMode::Kind::kTorsion, 0, 1);
  const double shear = kRod / std::sqrt(2 * (1 + kPoisson));
  EXPECT_NEAR(torsion[0].frequency, shear / 2 * std::sqrt(6 * 0.1406), 2e-3 * torsion[0].frequency);
  EXPECT_NEAR(torsion[2].frequency, 3 * torsion[0].frequency, 1e-9);
  const std::vector<BlockMode> stretch = allOf(half, BlockMode::Kind::kLongitudinal, 0, 0);
  EXPECT_NEAR(stretch[0].frequency, kRod / 2, 1e-9);
}

TEST(BlockModes, areTheLowestAndNotTooHigh) {
  const std::vector<BlockMode> modes = modesOf(Vec3(0.5, 0.25, 0.125), kSteel, 9000, 7);
  EXPECT_EQ(modes.size(), 7U);
  EXPECT_TRUE(std::is_sorted(modes.begin(), modes.end(), [](const BlockMode& a, const BlockMode& b) {
    return a.frequency < b.frequency;
  }));
  EXPECT_EQ(modes[0].kind, BlockMode::Kind::kBody);
  EXPECT_NEAR(modes[0].frequency, 171.5, 1e-9);  // half a wave of air along it
  EXPECT_LE(modesOf(Vec3(0.5, 0.25, 0.125), kSteel, 3000, 1000).back().frequency, 3000);
}

// The free-free beam is 2 at its ends, −1.2157 in the middle, and 0 at 0.2242 of its length.
TEST(BlockModes, areStruckWhereTheyMove) {
  const Vec3 half(0.5, 0.05, 0.02);
  const BlockMode bend{
      .kind = BlockMode::Kind::kBending, .along = 0, .across = 2, .order = 1, .frequency = 100};
  const auto at = [&](double x, const Vec3& impulse) {
    return excitation(bend, half, 2, Vec3(x, 0, 0.02), impulse);
  };
  EXPECT_NEAR(at(0.5, Vec3(0, 0, 3)), 3, 1e-9);
  EXPECT_NEAR(at(-0.5, Vec3(0, 0, 3)), 3, 1e-6);
  EXPECT_NEAR(at(0, Vec3(0, 0, 3)), -1.2157 * 1.5, 1e-4);
  EXPECT_NEAR(at(0.5 - 0.22416, Vec3(0, 0, 3)), 0, 1e-4);
  EXPECT_EQ(at(0.5, Vec3(4, 5, 0)), 0) << "across it does not bend that way";
}

// The mean over the body of the square of each shape is 1, so that excitation is speed over the impulse per
// mass: here by sums over a grid.
TEST(BlockModes, haveTheSameMeanMotionForTheSameStrikes) {
  const Vec3 half(0.5, 0.2, 0.1);
  for (const BlockMode& mode : modesOf(half, kSteel, 1e9, 1000)) {
    if (mode.kind == BlockMode::Kind::kBody || mode.order > 3) {
      continue;
    }
    double sum = 0;
    constexpr int kPoints = 40;
    for (int i = 0; i < kPoints * kPoints * kPoints; ++i) {
      const Vec3 part((i % kPoints + 0.5) / kPoints, (i / kPoints % kPoints + 0.5) / kPoints,
                      (i / kPoints / kPoints + 0.5) / kPoints);
      const Vec3 point = (2 * part - Vec3::Ones()).cwiseProduct(half);
      for (int axis = 0; axis < 3; ++axis) {
        sum +=
            std::pow(excitation(mode, half, 1, point, Vec3::Unit(axis)), 2) / (kPoints * kPoints * kPoints);
      }
    }
    EXPECT_NEAR(sum, 1, 0.01) << static_cast<int>(mode.kind) << ' ' << mode.order;
  }
}

}  // namespace
}  // namespace careen
