#include "render/draw/light_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace careen {
namespace {

class Boxes {
 public:
  double any() { return uniform_(random_); }
  DrawnBox box() {
    DrawnBox box;
    box.halfExtents = Vec3(0.1 + std::abs(any()), 0.1 + std::abs(any()), 0.1 + std::abs(any()));
    box.pose.worldFromBody = Quat(any(), any(), any(), any()).normalized().toRotationMatrix();
    box.pose.position = 10 * Vec3(any(), any(), any());
    return box;
  }
  Vec3 direction() { return Vec3(any(), any(), any()).normalized(); }

 private:
  std::mt19937 random_{3};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

TEST(LightPlane, gathersTheBoxesOverAPart) {
  Boxes random;
  for (int round = 0; round < 20; ++round) {
    std::vector<DrawnBox> boxes;
    for (int i = 0; i < 80; ++i) {
      boxes.push_back(random.box());
    }
    LightPlane plane(random.direction(), boxes);
    for (int query = 0; query < 50; ++query) {
      const Vec3 least = 12 * Vec3(random.any(), random.any(), random.any());
      const Vec3 most = least + 3 * Vec3(random.any(), random.any(), random.any()).cwiseAbs();
      std::vector<std::size_t> expected;
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const LightPlane::Bounds& bounds = plane.bounds(i);
        if (bounds.min.x() < most.x() && bounds.max.x() > least.x() && bounds.min.y() < most.y() &&
            bounds.max.y() > least.y() && bounds.max.z() > least.z()) {
          expected.push_back(i);
        }
      }
      std::vector<std::size_t> found;
      plane.gather(least, most, found);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected);
    }
  }
}

// A point of space is seen within the zonogon exactly if the line along the light through it meets the box.
TEST(LightPlane, boxesSeenAlongTheLightAreZonogons) {
  Boxes random;
  int inside = 0;
  for (int i = 0; i < 5000; ++i) {
    const DrawnBox box = random.box();
    const Vec3 light = random.direction();
    const Zonogon zonogon = zonogonOf(box, light);
    const Vec3 point = box.pose.position + 2 * Vec3(random.any(), random.any(), random.any());
    const Vec3 from = point - zonogon.centre;
    const Vec3 middle = zonogon.passing * from;
    const bool meets = (middle - zonogon.halfPassing).maxCoeff() < (middle + zonogon.halfPassing).minCoeff();
    const bool isSeen = ((zonogon.slabs * from).cwiseAbs() - zonogon.half).maxCoeff() < 0;
    EXPECT_EQ(meets, isSeen);
    // Where it is met it is: half way between entering and leaving the point is inside.
    if (meets) {
      ++inside;
      const double half =
          0.5 * ((middle - zonogon.halfPassing).maxCoeff() + (middle + zonogon.halfPassing).minCoeff());
      const Vec3 at = box.pose.worldFromBody.transpose() * (from + half * light);
      EXPECT_LT((at.cwiseAbs() - box.halfExtents).maxCoeff(), 1e-9);
    }
  }
  EXPECT_GT(inside, 500);  // measured 768
}

TEST(LightPlane, lightAlongAnAxisLeavesTwoSlabs) {
  DrawnBox box;
  box.halfExtents = Vec3(0.5, 0.3, 0.2);
  const Zonogon zonogon = zonogonOf(box, Vec3::UnitZ());
  const auto isSeen = [&](const Vec3& point) {
    return ((zonogon.slabs * point).cwiseAbs() - zonogon.half).maxCoeff() < 0;
  };
  EXPECT_TRUE(isSeen(Vec3(0.49, 0.29, -7)));
  EXPECT_FALSE(isSeen(Vec3(0.51, 0, 0)));
  EXPECT_FALSE(isSeen(Vec3(0, 0.31, 0)));
}

}  // namespace
}  // namespace careen
