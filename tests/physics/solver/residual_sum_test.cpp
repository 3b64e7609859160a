#include "physics/solver/residual_sum.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

constexpr double kResidualSpeed = 4;
constexpr double kResidualImpulse = 8;

ContactResiduals residualsOf(const ImpulseSet& cone, const ContactProblem::Triple& impulse,
                             const ContactProblem::Triple& u) {
  ResidualSum sum(kResidualSpeed, kResidualImpulse);
  sum.add(cone, impulse, u);
  return sum.residuals();
}

void expectResiduals(const ContactResiduals& found, double primal, double dual, double complementarity) {
  EXPECT_EQ(found.problems, 1);
  EXPECT_EQ(found.primal, primal);
  EXPECT_EQ(found.dual, dual);
  EXPECT_EQ(found.complementarity, complementarity);
}

constexpr ImpulseSet kRoughCone{.friction = 0.5, .kind = ImpulseSet::Kind::kCone};
constexpr ImpulseSet kSmoothCone{};

TEST(ResidualSum, ofWhatTheLawAllowsIsNone) {
  expectResiduals(residualsOf(kRoughCone, {0, 0, 0}, {1, 3, -2}), 0, 0, 0);  // parts
  expectResiduals(residualsOf(kRoughCone, {6, 1, -2}, {0, 0, 0}), 0, 0, 0);  // sticks
  expectResiduals(residualsOf(kRoughCone, {6, 0, -3}, {0, 0, 2}), 0, 0, 0);  // slips against its friction
  expectResiduals(residualsOf(kSmoothCone, {6, 0, 0}, {0, 1, 2}), 0, 0, 0);
  expectResiduals(residualsOf({.drag = {0.5, 0}}, {6, 3, 0}, {0, 1, 0}), 0, 0, 0);
}

TEST(ResidualSum, tellsWhichPartOfTheLawIsViolated) {
  expectResiduals(residualsOf(kRoughCone, {0, 0, 0}, {-1, 0, 0}), 0.25, 0, 0);  // approaches
  expectResiduals(residualsOf(kRoughCone, {-1, 0, 0}, {0, 0, 0}), 0, 0.125,
                  0);  // pulls; |λ_t| − μ λ_n is less
  expectResiduals(residualsOf(kRoughCone, {2, 3, 0}, {0, 0, 0}), 0, 0.25, 0);      // outside its cone
  expectResiduals(residualsOf(kRoughCone, {2, 0, 0}, {1, 0, 0}), 0, 0, 2. / 32);   // pushes and parts
  expectResiduals(residualsOf(kRoughCone, {6, 0, 3}, {0, 0, 2}), 0, 0, 12. / 32);  // slips along its friction
  expectResiduals(residualsOf(kRoughCone, {6, 0, 0}, {0, 0, 2}), 0, 0, 6. / 32);   // slips without friction
  expectResiduals(residualsOf({.drag = {0.5, 0}}, {6, 2, 0}, {0, 1, 0}), 0, 0.125, 0);
  expectResiduals(residualsOf({.friction = 1e12, .kind = ImpulseSet::Kind::kCone}, {6, 0, 0}, {0, 1e-15, 0}),
                  0, 0,
                  8e-15 / 8 / 4);  // Λ in place of μ λ_n
}

TEST(ResidualSum, ofAJointIsEverySpeed) {
  constexpr ImpulseSet kJoint{.kind = ImpulseSet::Kind::kSpace};
  expectResiduals(residualsOf(kJoint, {-6, 5, 4}, {0, 0, 0}), 0, 0, 0);
  expectResiduals(residualsOf(kJoint, {-1, 0, 0}, {2, 3, 6}), 7. / 4, 0, 2. / 32);
  expectResiduals(residualsOf(kJoint, {0, 2, 0}, {0, -1, 0}), 1. / 4, 0, 2. / 32);
}

TEST(ResidualSum, keepsTheLargest) {
  ResidualSum sum(kResidualSpeed, kResidualImpulse);
  sum.add(kRoughCone, {0, 0, 0}, {-1, 0, 0});
  sum.add(kRoughCone, {2, 3, 0}, {0, 0, 0});
  sum.add(kRoughCone, {2, 0, 0}, {1, 0, 0});
  expectResiduals(sum.residuals(), 0.25, 0.25, 2. / 32);
  ContactResiduals all = sum.residuals();
  all.add({.problems = 3, .primal = 0.5, .dual = 0.1, .complementarity = 1});
  EXPECT_EQ(all.problems, 4);
  EXPECT_EQ(all.primal, 0.5);
  EXPECT_EQ(all.dual, 0.25);
  EXPECT_EQ(all.complementarity, 1);
  expectResiduals(ResidualSum(0, 0).residuals(), 0, 0, 0);  // nothing moves
}

}  // namespace
}  // namespace careen
