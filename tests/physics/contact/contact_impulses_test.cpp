#include "physics/contact/contact_impulses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "physics/geometry/contact_frame.h"
#include "support/touching_bodies.h"

namespace careen {
namespace {

// A cube on the floor, its four corners in contact.
struct CubeProblem {
  explicit CubeProblem(const Vec3& velocity, double friction = 0)
      : of(cubeAbove(0.1, velocity)),
        features(lowerCorners(of.world, 0, friction)),
        loads(of.group),
        impulses(of.group) {
    of.group.contactsAt(features, of.state, geometry);
    impulses.begin(features, of.state);
    impulses.setFree(of.state, loads, 0);
    for (std::size_t c = 0; c < features.size(); ++c) {
      impulses.add(features[c], geometry[c]);
    }
  }
  GroupOf of;
  std::vector<ContactFeature> features;
  std::vector<ContactState> geometry;
  GroupLoads loads;
  ContactImpulses impulses;
};

// At r = (0.1, −0.1, −0.1) the normal speed is v_z + (r × z)·ω = v_z − 0.1 ω_x − 0.1 ω_y; a cube's principal
// axes are its own.
TEST(ContactImpulses, rowsOfACornerOnAPlaneAreItsArm) {
  CubeProblem cube(Vec3::Zero());
  const auto at = std::find_if(cube.features.begin(), cube.features.end(), [](const ContactFeature& feature) {
    return feature.onA.x() > 0 && feature.onA.y() < 0;
  });
  const auto c = static_cast<std::size_t>(at - cube.features.begin());
  const ContactProblem::Contact contact = cube.impulses.add(*at, cube.geometry[c]);
  EXPECT_EQ(contact.a, 0);
  EXPECT_EQ(contact.b, ContactProblem::kNobody);
  const std::array<double, 6> normal{0, 0, 1, -0.1, -0.1, 0};
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(contact.rows[0][k], normal[k], 1e-16) << k;
  }
  const ContactFrame frame = frameOf(Vec3::UnitZ());
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(contact.rows[1][k], frame.tangent1[static_cast<int>(k)], 1e-16);
  }
}

// 2 m/s down: four equal impulses, 2 N s in all.
TEST(ContactImpulses, ofACubeThatLandsFlatAreEqual) {
  CubeProblem cube(Vec3(0, 0, -2));
  ASSERT_TRUE(cube.impulses.solve(0));
  ASSERT_EQ(cube.impulses.impulses().size(), 4U);
  for (const ContactProblem::Triple& impulse : cube.impulses.impulses()) {
    EXPECT_NEAR(impulse[0], 0.5, 1e-14);
  }
  EXPECT_LT(cube.impulses.velocity(0).norm(), 1e-14);
  EXPECT_LT(cube.impulses.spinBody(0).norm(), 1e-13);
  std::vector<BodyImpulse> sums;
  cube.impulses.sum(cube.features, cube.geometry, cube.impulses.impulses(), sums);
  EXPECT_LT((sums[0].push - Vec3(0, 0, 2)).norm(), 1e-14);
  EXPECT_LT(sums[0].twist.norm(), 1e-15);
  EXPECT_GE(cube.impulses.work(), 0);
}

// One impulse of 3 N s along the normal: what it turns is r × 3 z.
TEST(ContactImpulses, turnByTheirArms) {
  CubeProblem cube(Vec3::Zero());
  std::vector<ContactProblem::Triple> impulses(4, ContactProblem::Triple{});
  impulses[1][0] = 3;
  std::vector<BodyImpulse> sums;
  cube.impulses.sum(cube.features, cube.geometry, impulses, sums);
  EXPECT_LT((sums[0].twist - cube.features[1].onA.cross(Vec3(0, 0, 3))).norm(), 1e-15);
}

// The rows say −2 m/s; if gaps at the end close at 1.7 m/s only, it is enough to get to −0.3.
TEST(ContactImpulses, aimAtTheSpeedsAtTheEnd) {
  CubeProblem cube(Vec3(0, 0, -2));
  for (std::size_t c = 0; c < 4; ++c) {
    ContactState end = cube.geometry[c];
    end.rate = -1.7;
    cube.impulses.aimAtEnd(c, cube.features[c], cube.geometry[c], end, cube.of.state);
  }
  ASSERT_TRUE(cube.impulses.solve(0));
  EXPECT_NEAR(cube.impulses.velocity(0).z(), -0.3, 1e-14);
}

TEST(ContactImpulses, stopWhereTheyCostTooMuch) {
  CubeProblem cube(Vec3(1, 0, -2), 0.3);
  cube.impulses.limitWork(0.5);
  EXPECT_THROW(cube.impulses.solve(0), NumericalError);
}

}  // namespace
}  // namespace careen
