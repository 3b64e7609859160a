#include "truth/ray_cast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "support/stages.h"
#include "view/camera.h"
#include "view/scene_extent.h"

namespace careen {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 36;

struct Hit {
  double depth = 1e300;
  std::int32_t instance = 0;
  std::uint8_t face = 0;
  double margin = 1e300;  // how far the nearest edge is [m]: closer ones are in doubt
};

// The six rectangles of a box one by one, in long double: where the ray meets the plane, and whether that is
// within the rectangle.
void castSlowly(const CastBox& box, std::int32_t instance, const Vec3& eye, const Vec3& along, Hit& hit) {
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double sign = face % 2 == 0 ? -1 : 1;
    const Vec3 normal = sign * box.pose.worldFromBody.col(axis);
    const Vec3 middle = box.pose.position + box.halfExtents[axis] * normal;
    const long double towards = -static_cast<long double>(normal.dot(along));
    if (towards <= 0) {
      continue;
    }
    const auto depth = static_cast<double>(static_cast<long double>(normal.dot(eye - middle)) / towards);
    if (!(depth > 0)) {
      continue;
    }
    const Vec3 inBody = box.pose.worldFromBody.transpose() * (eye + depth * along - box.pose.position);
    double inside = 1e300;
    for (int other = 0; other < 3; ++other) {
      if (other != axis) {
        inside = std::min(inside, box.halfExtents[other] - std::abs(inBody[other]));
      }
    }
    hit.margin = std::min(hit.margin, std::abs(inside));
    if (inside >= 0 && depth < hit.depth) {
      hit = {.depth = depth,
             .instance = instance,
             .face = static_cast<std::uint8_t>(face + 1),
             .margin = hit.margin};
    }
  }
}

Vec3 randomIn(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> any(-reach, reach);
  return {any(random), any(random), any(random)};
}

TEST(RayCast, hitsWhatSixRectanglesPerBoxSay) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> size(0.02, 1.5);
  std::size_t hits = 0;
  std::size_t doubtful = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Camera camera = cameraAt(randomIn(random, 6), randomIn(random, 1), 20 + trial % 100);
    std::vector<CastBox> boxes;
    for (int i = 0; i < 6; ++i) {
      const Vec3 turn = randomIn(random, 3);
      const Vec3 halfExtents(size(random), size(random), size(random));
      // Every tenth along the world's axes: rays are then parallel to faces.
      const Mat3 worldFromBody =
          trial % 10 == 0 ? Mat3(Mat3::Identity())
                          : Mat3(Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix());
      boxes.push_back({.pose = {.position = randomIn(random, 3), .worldFromBody = worldFromBody},
                       .halfExtents = halfExtents});
    }
    const PixelRays rays(camera, kWidth, kHeight);
    const CastPicture picture = castRays(rays, boxes, {});
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        Hit hit;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
          castSlowly(boxes[i], static_cast<std::int32_t>(i + 1), rays.eye(), rays.offset(x, y), hit);
        }
        if (hit.margin < 1e-9) {
          ++doubtful;
          continue;
        }
        const auto place = static_cast<std::size_t>(y * kWidth + x);
        ASSERT_EQ(picture.instance[place], hit.instance) << trial << ' ' << x << ' ' << y;
        ASSERT_EQ(picture.face[place], hit.face);
        ASSERT_NEAR(picture.depth[place], hit.instance == 0 ? 0 : hit.depth,
                    1e-12 * (1 + hit.depth * (hit.instance != 0)));
        hits += hit.instance != 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hits, 100'000U);  // measured: 218,000 of 691,200
  EXPECT_LT(doubtful, 10U);
}

// Bodies of boxes that go through each other: of the first of them that a ray meets, and of each body as if
// it were alone.
TEST(RayCast, boxesOfSeveralPartsAreOneThing) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> size(0.1, 1);
  std::size_t hits = 0;
  std::size_t counted = 0;
  std::array<std::size_t, 4> hitsOfPart{};
  for (int trial = 0; trial < 200; ++trial) {
    const PixelRays rays(cameraAt(randomIn(random, 6), randomIn(random, 1), 20 + trial % 100), kWidth,
                         kHeight);
    std::vector<CastBox> bodies;
    for (int i = 0; i < 3; ++i) {
      CastBox& body = bodies.emplace_back(
          CastBox{.pose = {.position = randomIn(random, 3)}, .halfExtents = Vec3(3, 3, 3)});
      for (int part = 0; part < 2 + trial % 3; ++part) {
        const Vec3 turn = randomIn(random, 3);
        body.parts.push_back(
            {.pose = {.position = body.pose.position + randomIn(random, 0.8),
                      .worldFromBody = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()},
             .halfExtents = Vec3(size(random), size(random), size(random))});
      }
    }
    const CastPicture picture = castRays(rays, bodies, {});
    std::array<std::int64_t, 3> alone{};
    std::array<bool, 3> isDoubtful{};
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        Hit first;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
          Hit own;
          for (std::size_t part = 0; part < bodies[i].parts.size(); ++part) {
            const double before = own.depth;
            castSlowly(bodies[i].parts[part], static_cast<std::int32_t>(i + 1), rays.eye(), rays.offset(x, y),
                       own);
            own.face = static_cast<std::uint8_t>(own.face + (own.depth < before ? 6 * part : 0));
          }
          alone[i] += own.instance != 0 ? 1 : 0;
          isDoubtful[i] = isDoubtful[i] || own.margin < 1e-9;
          const double margin = std::min(first.margin, own.margin);
          first = own.depth < first.depth ? own : first;
          first.margin = margin;
        }
        if (first.margin < 1e-9) {
          continue;
        }
        const auto place = static_cast<std::size_t>(y * kWidth + x);
        ASSERT_EQ(picture.instance[place], first.instance) << trial << ' ' << x << ' ' << y;
        ASSERT_EQ(picture.face[place], first.face) << trial << ' ' << x << ' ' << y;
        if (first.instance != 0) {
          ASSERT_NEAR(picture.depth[place], first.depth, 1e-12 * (1 + first.depth));
          ++hits;
          ++hitsOfPart.at((first.face - 1U) / 6);
        }
      }
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      counted += isDoubtful[i] ? 0 : 1;
      ASSERT_TRUE(isDoubtful[i] || picture.alone[i] == alone[i]) << trial << ' ' << i;
      ASSERT_LE(picture.visible[i], picture.alone[i]);
    }
  }
  EXPECT_GT(hits, 50'000U);
  EXPECT_GT(*std::min_element(hitsOfPart.begin(), hitsOfPart.end()), 3'000U);
  EXPECT_GT(counted, 590U);  // of 600
}

TEST(RayCast, raysGoThroughTheMiddlesOfThePixelsOfPictures) {
  const Camera camera = cameraAt(Vec3(2, -5, 3), Vec3(0.3, 0, 1), 47);
  const PixelRays rays(camera, kWidth, kHeight);
  const View view =
      viewOf(camera, {.min = Vec3(-5, -5, -5), .max = Vec3(5, 5, 5)}, static_cast<double>(kWidth) / kHeight);
  for (int i = 0; i < 100; ++i) {
    const Vec3 point = rays.eye() + (1 + i) * rays.offset(i % kWidth, i % kHeight);
    const Vec3 pixel = view.pixelFromWorld(point, kWidth, kHeight);
    EXPECT_NEAR(pixel.x(), i % kWidth + 0.5, 1e-10);
    EXPECT_NEAR(pixel.y(), i % kHeight + 0.5, 1e-10);
    const Vec3 again = rays.pixelOf(point);
    EXPECT_NEAR(again.x(), pixel.x(), 1e-10);
    EXPECT_NEAR(again.y(), pixel.y(), 1e-10);
    EXPECT_NEAR(again.z(), 1 + i, 1e-12 * (1 + i));
  }
  EXPECT_LT(rays.pixelOf(rays.eye() - rays.offset(3, 3)).z(), 0);
}

TEST(RayCast, wallsOfARoomLeaveNoGapBetweenThem) {
  Scene scene = crateInRoom();
  scene.room->open = {};
  const std::vector<Surface> surfaces = surfacesOf(stageOf(scene), extentOf(setupOf(scene)));
  ASSERT_EQ(surfaces.size(), 6U);
  std::mt19937 random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Camera camera =
        cameraAt(Vec3(0, 0, 1.5) + randomIn(random, 1.2), Vec3(0, 0, 1.5) + randomIn(random, 1), 90);
    const CastPicture picture = castRays(PixelRays(camera, kWidth, kHeight), {}, surfaces);
    EXPECT_EQ(std::count(picture.instance.begin(), picture.instance.end(), 0), 0);
  }
  // From outside the walls are transparent: the far ones are seen.
  const CastPicture outside =
      castRays(PixelRays(cameraAt(Vec3(0, -9, 1.5), Vec3(0, 0, 1.5), 10), 9, 9), {}, surfaces);
  EXPECT_EQ(outside.instance[40], 4) << "the wall at +y";
  EXPECT_NEAR(outside.depth[40], 11, 1e-12);
}

TEST(RayCast, countsWhatHidesWhat) {
  const CastBox near{.pose = {.position = Vec3(0.5, 0, 0), .worldFromBody = Mat3::Identity()},
                     .halfExtents = Vec3(0.5, 0.1, 5)};
  const CastBox far{.pose = {.position = Vec3(0, 3, 0), .worldFromBody = Mat3::Identity()},
                    .halfExtents = Vec3(1, 0.1, 0.5)};
  const CastBox behind{.pose = {.position = Vec3(0, -20, 0), .worldFromBody = Mat3::Identity()},
                       .halfExtents = Vec3::Ones()};
  const CastBox around{.pose = {.position = Vec3(0, -8, 0), .worldFromBody = Mat3::Identity()},
                       .halfExtents = Vec3::Ones()};
  const PixelRays rays(cameraAt(Vec3(0, -8, 0), Vec3(0, 0, 0), 40), 200, 100);
  const CastPicture picture = castRays(rays, std::vector<CastBox>{near, far, behind, around}, {});
  EXPECT_EQ(picture.visible[0], picture.alone[0]);
  EXPECT_EQ(picture.visible[2], 0);
  EXPECT_EQ(picture.alone[2], 0);
  EXPECT_EQ(picture.alone[3], 0) << "the eye is in it";
  // The middle line x = 0 is the near one's left edge: half of the far one is hidden.
  EXPECT_EQ(2 * picture.visible[1], picture.alone[1]);
  EXPECT_EQ(picture.bounds[1].right, 99);
  EXPECT_EQ(picture.bounds[1].bottom + picture.bounds[1].top, 99);
  EXPECT_EQ(picture.bounds[2], PixelBox{});
}

}  // namespace
}  // namespace careen
