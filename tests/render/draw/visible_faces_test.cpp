#include "render/draw/visible_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace careen {
namespace {

constexpr int kSightWidth = 160;
constexpr int kSightHeight = 90;

// By rays through random points of random pixels' parts with samples: the face that a ray meets first is
// among the visible ones.
TEST(VisibleFaces, holdEveryPointThatARayMeetsFirst) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const Vec3 eye(0, -6, 0);
  const Camera camera{.eye = eye, .target = Vec3::Zero(), .up = Vec3::UnitZ(), .fovDegrees = 60};
  const View view = viewOf(camera, {.min = Vec3(-3, -3, -3), .max = Vec3(3, 3, 3)}, 16.0 / 9);
  const double slope = slopeOfView(60);
  std::size_t all = 0;
  std::size_t left = 0;
  int met = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<DrawnBox> boxes;
    for (int i = 0; i < 60; ++i) {
      DrawnBox box{.pose = {.position = 1.5 * Vec3(any(random), any(random), any(random))}};
      box.halfExtents = Vec3(0.2, 0.2, 0.2) + 0.3 * Vec3(any(random), any(random), any(random)).cwiseAbs();
      box.pose.worldFromBody =
          Quat(any(random), any(random), any(random), any(random)).normalized().toRotationMatrix();
      boxes.push_back(box);
    }
    const double within = round % 2 == 0 ? 0.02 : 0.52;
    const std::vector<DrawnFace> faces = facesTowards(boxes, eye, 1e-3);
    const std::vector<DrawnFace> visible =
        visibleFaces(faces, view, {.width = kSightWidth, .height = kSightHeight, .within = within}).faces;
    all += faces.size();
    left += visible.size();
    for (int k = 0; k < 2000; ++k) {
      const double x =
          std::floor((0.5 + 0.5 * any(random)) * kSightWidth) + 0.5 + 0.98 * within * any(random);
      const double y =
          std::floor((0.5 + 0.5 * any(random)) * kSightHeight) + 0.5 + 0.98 * within * any(random);
      const Vec3 ray = view.worldFromCamera * Vec3((2 * x / kSightWidth - 1) * slope * 16 / 9,
                                                   (2 * y / kSightHeight - 1) * slope, -1);
      const DrawnFace* first = nullptr;
      double nearest = 1e300;
      for (const DrawnFace& face : faces) {
        const Vec3 normal = face.across.cross(face.along);
        const double at = normal.dot(face.centre - eye) / normal.dot(ray);
        const Vec3 from = eye + at * ray - face.centre;
        const Vec2 on(from.dot(face.across) / face.across.squaredNorm(),
                      from.dot(face.along) / face.along.squaredNorm());
        if (at > 0 && at < nearest && on.cwiseAbs().maxCoeff() < 1) {
          nearest = at;
          first = &face;
        }
      }
      if (first != nullptr) {
        ++met;
        EXPECT_TRUE(std::any_of(visible.begin(), visible.end(), [&](const DrawnFace& face) {
          return face.box == first->box && face.side == first->side;
        })) << round;
      }
    }
  }
  EXPECT_GT(met, 5000);
  EXPECT_LT(static_cast<double>(left), 0.85 * static_cast<double>(all));
}

// Boxes hide a piece of a floor exactly if rays to its points meet them first; near silhouettes it may count
// as seen.
TEST(VisibleFaces, hidePiecesOfAFloorBehindThem) {
  const Vec3 eye(0, -6, 2);
  const Camera camera{.eye = eye, .target = Vec3::Zero(), .up = Vec3::UnitZ(), .fovDegrees = 60};
  const View view = viewOf(camera, {.min = Vec3(-3, -3, -3), .max = Vec3(3, 3, 3)}, 16.0 / 9);
  DrawnBox box;
  box.halfExtents = Vec3(1, 1, 1);
  const std::vector<DrawnBox> boxes = {box};
  const HiddenTiles hidden =
      visibleFaces(facesTowards(boxes, eye, 1e-3), view, {.width = 320, .height = 180, .within = 0.02})
          .hidden;
  const auto piece = [](double x, double y, double half) {
    return std::vector<Vec3>{Vec3(x - half, y - half, -1), Vec3(x + half, y - half, -1),
                             Vec3(x + half, y + half, -1), Vec3(x - half, y + half, -1)};
  };
  EXPECT_TRUE(hidden.hide(piece(0, 2, 0.3)));     // behind the box
  EXPECT_FALSE(hidden.hide(piece(0, 2, 1.5)));    // partly beside it
  EXPECT_FALSE(hidden.hide(piece(2.5, 2, 0.3)));  // beside it
  EXPECT_FALSE(hidden.hide(piece(0, -2, 0.3)));   // before it
  EXPECT_FALSE(hidden.hide(piece(0, -6, 8)));     // also behind the eye
  EXPECT_FALSE(HiddenTiles().hide(piece(0, 2, 0.3)));
}

}  // namespace
}  // namespace careen
