#include "audit/findings.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "physics/world/method.h"

namespace careen {
namespace {

const RunSettings kExactly{.method = Method::kExact, .duration = 10, .tolerance = 1e-6};

const std::vector<double> kNoCrowd(3, std::numeric_limits<double>::infinity());

Finding overlapOf(double size, double time) {
  return {.size = size, .time = time, .bodies = {0, 1}, .wall = {}};
}

TEST(Findings, keepTheLargestAndTheFirstBreach) {
  Findings findings(kExactly, kNoCrowd);
  findings.add(AuditKind::kBoxOverlap, 0, overlapOf(0.3, 5));
  findings.add(AuditKind::kBoxOverlap, 0, overlapOf(0.1, 2));
  findings.add(AuditKind::kBoxOverlap, 0, overlapOf(1e-6, 1));  // within the promise
  EXPECT_EQ(findings.largest(AuditKind::kBoxOverlap).size, 0.3);
  ASSERT_TRUE(findings.firstBreach(AuditKind::kBoxOverlap));
  EXPECT_EQ(findings.firstBreach(AuditKind::kBoxOverlap)->time, 2);
}

TEST(Findings, ofACrowdAreJudgedByWhatItPromises) {
  std::vector<double> crowdFrom = kNoCrowd;
  crowdFrom[1] = 4;
  Findings findings(kExactly, crowdFrom);
  findings.add(AuditKind::kBoxOverlap, 0, overlapOf(8e-4, 5));
  findings.add(AuditKind::kEnergyLoss, 0, overlapOf(0.3, 5));
  EXPECT_FALSE(findings.firstBreach(AuditKind::kBoxOverlap));
  EXPECT_FALSE(findings.firstBreach(AuditKind::kEnergyLoss));
  EXPECT_EQ(findings.largest(AuditKind::kBoxOverlap).size, 8e-4);
  findings.add(AuditKind::kBoxOverlap, 0, overlapOf(1e-3, 5));
  EXPECT_TRUE(findings.firstBreach(AuditKind::kBoxOverlap));
}

// A crowd lowers what is promised of its members only.
TEST(Findings, besideACrowdAreJudgedAsExact) {
  std::vector<double> crowdFrom = kNoCrowd;
  crowdFrom[2] = 0;
  Findings findings(kExactly, crowdFrom);
  findings.add(AuditKind::kBoxOverlap, 0, overlapOf(1e-5, 5));
  EXPECT_TRUE(findings.firstBreach(AuditKind::kBoxOverlap));
}

TEST(Findings, roundingIsNone) {
  Findings findings(kExactly, kNoCrowd);
  findings.add(AuditKind::kBoxOverlap, 1e-3, overlapOf(1e-3, 1));
  EXPECT_EQ(findings.largest(AuditKind::kBoxOverlap).size, 0);
}

TEST(Findings, noNumberIsTheLargest) {
  Findings findings(kExactly, kNoCrowd);
  findings.add(AuditKind::kBoxOverlap, 1, overlapOf(std::numeric_limits<double>::quiet_NaN(), 1));
  EXPECT_EQ(findings.largest(AuditKind::kBoxOverlap).size, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(findings.firstBreach(AuditKind::kBoxOverlap));
}

}  // namespace
}  // namespace careen
