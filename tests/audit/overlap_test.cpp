#include "audit/overlap.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace careen {
namespace {

constexpr int kPairs = 400;
constexpr int kPoints = 2000;

class RandomBoxes {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Vec3 point(double most) { return {between(-most, most), between(-most, most), between(-most, most)}; }
  AuditBox box() {
    const Quat turn = Quat(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1)).normalized();
    return {Vec3(between(0.1, 0.5), between(0.1, 0.5), between(0.1, 0.5)),
            {point(0.6), turn.toRotationMatrix()}};
  }
  Vec3 pointIn(const AuditBox& box) { return box.pose.worldPoint(box.halfExtents.cwiseProduct(point(1))); }

 private:
  std::mt19937 engine_{1};
};

bool holds(const AuditBox& box, const Vec3& point) {
  const Vec3 inside = box.pose.worldFromBody.transpose() * (point - box.pose.position);
  return (inside.cwiseAbs() - box.halfExtents).maxCoeff() <= 0;
}

// Of points thrown into one box some lie in the other, or none, whatever axes say.
TEST(Overlap, agreesWithPointsThrownIntoBoxes) {
  RandomBoxes random;
  int overlapping = 0;
  int apart = 0;
  for (int pair = 0; pair < kPairs; ++pair) {
    const AuditBox a = random.box();
    const AuditBox b = random.box();
    const double gap = separationOf(a, b);
    int common = 0;
    for (int k = 0; k < kPoints; ++k) {
      common += holds(b, random.pointIn(a)) || holds(a, random.pointIn(b)) ? 1 : 0;
    }
    if (gap > 0) {
      EXPECT_EQ(common, 0) << pair;
      ++apart;
    } else if (gap < -0.1) {  // deep enough for some of 4000 points
      EXPECT_GT(common, 0) << pair;
      ++overlapping;
    }
  }
  EXPECT_GT(overlapping, 30);
  EXPECT_GT(apart, 30);
}

TEST(Overlap, partingByTheDepthEndsTheOverlap) {
  const AuditBox a{Vec3(1, 1, 1), {}};
  AuditBox b{Vec3(0.5, 0.5, 0.5), {.position = Vec3(1.4, 0.2, 0.1), .worldFromBody = Mat3::Identity()}};
  EXPECT_NEAR(separationOf(a, b), -0.1, 1e-15);  // 1 + 0.5 − 1.4
  b.pose.position.x() += 0.1;
  EXPECT_NEAR(separationOf(a, b), 0, 1e-15);
}

// Two edges cross at right angles, each at 45° to the floor: only the product of the edges tells how deep.
TEST(Overlap, crossingEdgesAreMeasuredAlongTheirCommonNormal) {
  const double diagonal = std::sqrt(2.0);
  const AuditBox lower{Vec3(1, 1, 3),
                       {.position = Vec3::Zero(),
                        .worldFromBody = (Eigen::AngleAxisd(M_PI / 2, Vec3::UnitX()) *
                                          Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ()))
                                             .toRotationMatrix()}};
  const AuditBox upper{Vec3(1, 1, 3),
                       {.position = Vec3(0, 0, 2 * diagonal - 0.01),
                        .worldFromBody = (Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()) *
                                          Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ()))
                                             .toRotationMatrix()}};
  EXPECT_NEAR(separationOf(lower, upper), -0.01, 1e-14);
}

TEST(Overlap, parallelEdgesGiveNoAxisOfRounding) {
  AuditBox a{Vec3(1, 2, 3), {.position = Vec3(1e3, 0, 0), .worldFromBody = Mat3::Identity()}};
  AuditBox b = a;
  b.pose.position.y() += 4.5;
  b.pose.worldFromBody = Eigen::AngleAxisd(1e-12, Vec3::UnitX()).toRotationMatrix();
  EXPECT_NEAR(separationOf(a, b), 0.5, 1e-9);
}

TEST(Overlap, noNumberIsNoGap) {
  AuditBox a{Vec3::Ones(), {}};
  AuditBox b = a;
  b.pose.worldFromBody(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(separationOf(a, b) <= 0);
  EXPECT_FALSE(separationOf(a, b) > 0);
}

TEST(Overlap, aWallIsMeasuredFromTheLowestCorner) {
  RandomBoxes random;
  for (int i = 0; i < kPairs; ++i) {
    const AuditBox box = random.box();
    const Wall wall{
        .name = "w", .normal = random.point(1).normalized(), .offset = random.between(-1, 1), .material = {}};
    double lowest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kCorners; ++k) {
      lowest =
          std::min(lowest, wall.normal.dot(box.pose.worldPoint(corner(box.halfExtents, k))) - wall.offset);
    }
    EXPECT_NEAR(separationOf(box, planeAt(wall, 0)), lowest, 1e-14);
  }
}

// Of bodies of several boxes, against points thrown into their boxes: bars across each other.
TEST(Overlap, ofBodiesOfSeveralBoxesIsThatOfTheNearest) {
  RandomBoxes random;
  Body cross;
  setParts(cross, {{.halfExtents = Vec3(1, 0.1, 0.1)},
                   {.halfExtents = Vec3(0.1, 0.1, 1), .center = Vec3(0, 0, 0.5)}});
  Body bar;
  bar.halfExtents = Vec3(0.1, 2, 0.1);
  // Between the two arms, whatever the box around them.
  EXPECT_NEAR(separationOf(cross, Pose{}, bar, {.position = Vec3(0.5, 0, 0.5)}), 0.3, 1e-15);
  EXPECT_NEAR(separationOf(cross, Pose{}, bar, {.position = Vec3(0.15, 0, 0.5)}), -0.05, 1e-15);
  EXPECT_NEAR(separationOf(bar, {.position = Vec3(0.5, 0, 0.15)}, cross, Pose{}), -0.05, 1e-15);
  const Wall floor{.name = "floor", .normal = Vec3::UnitZ(), .offset = -0.7, .material = {}};
  EXPECT_NEAR(separationOf(cross, Pose{}, planeAt(floor, 0)), 0.2, 1e-15);
  int inside = 0;
  for (int k = 0; k < 200; ++k) {
    const AuditBox place = random.box();
    Body slanted;
    setParts(slanted, {{.halfExtents = place.halfExtents,
                        .center = place.pose.worldFromBody.transpose() * place.pose.position,
                        .turned = true,
                        .bodyFromPart = place.pose.worldFromBody},
                       {.halfExtents = Vec3::Constant(0.05), .center = Vec3(0, 0, 5)}});
    const AuditBox moved = random.box();  // only its pose
    const std::vector<AuditBox> boxes = auditBoxes(slanted, moved.pose);
    ASSERT_EQ(boxes.size(), 2U);
    const Vec3 point = random.pointIn(place);
    EXPECT_TRUE(
        holds(boxes[0], moved.pose.worldPoint(0.999 * (point - place.pose.position) + place.pose.position)));
    const Vec3 other = random.point(1);
    inside += holds(place, other) ? 1 : 0;
    EXPECT_EQ(holds(place, other), holds(boxes[0], moved.pose.worldPoint(other))) << k;
  }
  EXPECT_GT(inside, 3);  // measured 4
}

}  // namespace
}  // namespace careen
