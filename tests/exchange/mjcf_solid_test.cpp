#include "exchange/mjcf_solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/input_error.h"

namespace careen {
namespace {

MjcfSolid solidFrom(const std::string& attributes) {
  MjcfDocument document("<mujoco>\n<geom " + attributes + "/></mujoco>", "m.xml");
  const MjcfDefaults defaults(document);
  return solidOf(document, defaults.geom(*document.sections("geom")[0], "main"));
}

// The volume, and ∫ (y² + z²) dV and so on, by the middles of cubes of 1/`parts` of the size.
MjcfSolid summed(const Vec3& size, bool (*isInside)(const Vec3&)) {
  constexpr int kParts = 160;
  MjcfSolid sum;
  for (int i = 0; i < kParts * kParts * kParts; ++i) {
    const Vec3 unit((i % kParts + 0.5) / kParts, (i / kParts % kParts + 0.5) / kParts,
                    (i / kParts / kParts + 0.5) / kParts);
    const Vec3 at = size.cwiseProduct(Vec3(2 * unit - Vec3::Ones()));
    if (isInside(at)) {
      sum.mass += 1;
      const Vec3 squares = at.cwiseAbs2();
      sum.moments += Vec3::Constant(squares.sum()) - squares;
    }
  }
  const double cell = 8 * size.prod() / std::pow(kParts, 3);
  return {.mass = cell * sum.mass, .moments = cell * sum.moments};
}

void expectNear(const MjcfSolid& found, const MjcfSolid& expected) {
  EXPECT_NEAR(found.mass / expected.mass, 1, 2e-3);
  EXPECT_LT((found.moments - expected.moments).norm() / expected.moments.norm(), 3e-3);
}

TEST(MjcfSolid, ofEveryShapeIsTheIntegral) {
  expectNear(solidFrom("type='box' size='1 2 3' density='1'"),
             summed({1, 2, 3}, [](const Vec3&) { return true; }));
  expectNear(solidFrom("type='sphere' size='2' density='1'"),
             summed({2, 2, 2}, [](const Vec3& p) { return p.norm() < 2; }));
  expectNear(solidFrom("type='ellipsoid' size='1 2 3' density='1'"),
             summed({1, 2, 3}, [](const Vec3& p) { return Vec3(p.x(), p.y() / 2, p.z() / 3).norm() < 1; }));
  expectNear(solidFrom("type='cylinder' size='1 2' density='1'"),
             summed({1, 1, 2}, [](const Vec3& p) { return p.head<2>().norm() < 1; }));
  expectNear(solidFrom("type='capsule' size='1 2' density='1'"), summed({1, 1, 3}, [](const Vec3& p) {
               return Vec3(p.x(), p.y(), std::max(0.0, std::fabs(p.z()) - 2)).norm() < 1;
             }));
}

TEST(MjcfSolid, massGoesBeforeDensity) {
  const MjcfSolid box = solidFrom("type='box' size='1 2 3' density='9' mass='6'");
  EXPECT_EQ(box.mass, 6);
  EXPECT_EQ(box.moments, Vec3(26, 20, 10));
}

TEST(MjcfSolid, whatHasNoMassNeedsNoShape) {
  EXPECT_EQ(solidFrom("type='mesh' mesh='m' mass='0'").mass, 0);
  EXPECT_EQ(solidFrom("type='mesh' mesh='m' density='0'").mass, 0);
  EXPECT_EQ(solidFrom("type='plane' size='1 1 1' density='5'").mass, 0);
}

TEST(MjcfSolid, refusesOtherShapesAndSizes) {
  const auto refusal = [](const std::string& attributes) {
    return inputErrorOf([&] { solidFrom(attributes); });
  };
  EXPECT_EQ(refusal("type='mesh' mesh='m'").substr(0, 60),
            "m.xml:2:2: found a <geom> of type \"mesh\" whose mass counts, ");
  EXPECT_NE(refusal("type='box' size='1 1 1' shellinertia='true'").find("a shell"), std::string::npos);
  EXPECT_EQ(refusal("type='box' mesh='m'"),
            "m.xml:2:2: found a box that takes its size from a mesh, expected one with a size");
  EXPECT_EQ(refusal("type='box' size='1 1'"),
            "m.xml:2:18: found 2 numbers for the size of a box, expected 3 half extents above 0 [m]");
  EXPECT_EQ(refusal("type='box' size='1 -2 1'"),
            "m.xml:2:18: found -2 in the size of a box, expected 3 half extents above 0 [m]");
  EXPECT_EQ(
      refusal("type='capsule' size='1'"),
      "m.xml:2:22: found 1 numbers for the size of a capsule, expected 2 radii or half lengths above 0 [m]");
  EXPECT_EQ(refusal("type='sphere' size='0'"),
            "m.xml:2:21: found 0 in the size of a sphere, expected 1 radii or half lengths above 0 [m]");
}

}  // namespace
}  // namespace careen
