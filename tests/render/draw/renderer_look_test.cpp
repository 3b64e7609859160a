// How edges, bright light and gradients come out, and what looks and contact shades change.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <set>
#include <vector>

#include "image/srgb.h"
#include "render/draw/renderer.h"
#include "render/outline.h"
#include "render/rays.h"
#include "render/stage.h"
#include "support/article_equations.h"

namespace careen {
namespace {

constexpr int kWidthOfLook = 320;
constexpr int kHeightOfLook = 180;

Picture drawnLook(const Scene& scene, const RenderOptions& options = {}) {
  return Renderer(setupOf(scene, kWidthOfLook, kHeightOfLook), options).draw(posesOf(scene));
}

struct EdgeErrors {
  double rms = 0;      // [1] of a pixel's light
  int missed = 0;      // pixels off by more than 0.3 away from corners
  double corners = 0;  // [1] largest mean square of a corner's pixels
};

// A black box before white, seen from 10 m in front: what is left of the light in a pixel is the part of it
// that the box leaves free, counted by 32 x 32 points beside the engine. An edge through a pixel is taken for
// a line across it, so that at 45 degrees the corners of pixels are missed.
EdgeErrors edgeErrors(const Vec3& halfExtents, const Mat3& turned, Antialiasing antialiasing) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3::Zero(), halfExtents, Color{0, 0, 0}));
  scene.boxes[0].pose.worldFromBody = turned;
  scene.camera = cameraAt(Vec3(0, -10, 0), Vec3::Zero(), 20);
  const RenderOptions options = lit(evenLighting(Vec3::Ones()));
  scene.picture.antialiasing = antialiasing;
  const Picture picture = drawnLook(scene, options);
  const double pixels = 0.5 * kHeightOfLook / std::tan(10 * std::numbers::pi / 180);
  std::vector<Vec3> corners;
  for (int index = 0; index < 8; ++index) {
    const Vec3 signs(index % 2 == 0 ? 1 : -1, index / 2 % 2 == 0 ? 1 : -1, index / 4 == 0 ? 1 : -1);
    const Vec3 at = scene.boxes[0].pose.worldPoint(halfExtents.cwiseProduct(signs));
    const double scale = pixels / (10 + at.y());
    corners.emplace_back(0.5 * kWidthOfLook + scale * at.x(), 0.5 * kHeightOfLook - scale * at.z(), 0);
  }
  const std::vector<Vec3> outline = hull(corners);
  constexpr int kPoints = 32;
  EdgeErrors errors;
  std::vector<double> squares(outline.size());
  int count = 0;
  for (int y = 0; y < kHeightOfLook; ++y) {
    for (int x = 0; x < kWidthOfLook; ++x) {
      if (std::abs(depthInside(outline, Vec3(x + 0.5, y + 0.5, 0))) > 0.75) {
        continue;  // no edge comes near
      }
      int free = 0;
      for (int k = 0; k < kPoints * kPoints; ++k) {
        const int row = k / kPoints;
        const Vec3 point(x + (k % kPoints + 0.5) / kPoints, y + (row + 0.5) / kPoints, 0);
        free += depthInside(outline, point) < 0 ? 1 : 0;
      }
      const double share = static_cast<double>(free) / (kPoints * kPoints);
      if (share > 0 && share < 1) {
        const double found =
            SrgbTables::get().linear(static_cast<std::uint8_t>(pixelAt(picture, x, y)[0])) / 65535.0;
        errors.rms += (found - share) * (found - share);
        ++count;
        bool isByCorner = false;
        for (std::size_t k = 0; k < outline.size(); ++k) {
          if ((outline[k] - Vec3(x + 0.5, y + 0.5, 0)).norm() < 2) {
            squares[k] += (found - share) * (found - share);
            isByCorner = true;
          }
        }
        errors.missed += !isByCorner && std::abs(found - share) > 0.3 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(count, 200);
  errors.rms = std::sqrt(errors.rms / count);
  errors.corners = *std::max_element(squares.begin(), squares.end());
  return errors;
}

TEST(Renderer, edgesTakeTheirShareOfAPixel) {
  for (const double angle : {0.0, 0.05, 0.3, 0.7}) {
    const auto errorWith = [&](Antialiasing antialiasing) {
      return edgeErrors(Vec3(1.3, 1e-4, 0.9), axisAngle(Vec3::UnitY(), angle), antialiasing).rms;
    };
    const double off = errorWith(Antialiasing::kOff);
    const double edges = errorWith(Antialiasing::kEdges);
    const double multisampled = errorWith(Antialiasing::kMultisampled);
    std::cout << angle << " rad: off " << off << ", edges " << edges << ", 4x " << multisampled << '\n';
    EXPECT_LT(edges, 0.06) << angle;  // measured 0.031, 0.021, 0.034, 0.053; 4x 0.075 to 0.10
    EXPECT_LT(edges, multisampled) << angle;
    EXPECT_GT(off, 0.2) << angle;
  }
}

// No pixel is left out where an edge passes from one row or column to the next, nor where faces meet at a
// corner of the outline.
TEST(Renderer, outlinesHaveNoNotches) {
  int missed = 0;
  double corners = 0;
  for (int k = 0; k < 30; ++k) {
    const Mat3 turned = axisAngle(Vec3(1, k % 3, -k % 5).normalized(), 0.1 + 0.37 * k);
    const EdgeErrors found = edgeErrors(Vec3(1, 0.7, 0.8), turned, Antialiasing::kEdges);
    missed += found.missed;
    corners += found.corners / 30;
  }
  std::cout << missed << " pixels of edges left out, squares of the worst corners " << corners << '\n';
  EXPECT_EQ(missed, 0);
  EXPECT_LT(corners, 0.13);  // measured 0.121
}

// A white box in the light that has sunk into the floor by a part of a pixel: what is drawn of it below the
// floor was taken for shadow there, and left dark dots.
TEST(Renderer, aBoxThatHasSunkALittleHidesTheFloorThere) {
  const auto drawnSunk = [](double sunk) {
    Scene scene = onOpenFloor(cameraAt(Vec3(1, -6, 2.5), Vec3(0, 0, 0.3), 30));
    scene.boxes.push_back(boxAt(Vec3(0, 0, 0.3 - sunk), Vec3(0.5, 0.4, 0.3), Color{255, 255, 255}));
    scene.boxes[0].pose.worldFromBody = axisAngle(Vec3::UnitZ(), 0.3);
    return drawnLook(scene, sunlit(Vec3(0.3, -0.8, 1).normalized(), 0.01));
  };
  const Picture on = drawnSunk(0);
  int most = 0;  // below the darkest around
  for (const double sunk : {1e-4, 3e-4, 1e-3, 3e-3, 6e-3}) {
    const Picture in = drawnSunk(sunk);
    for (int y = 1; y + 1 < kHeightOfLook; ++y) {
      for (int x = 1; x + 1 < kWidthOfLook; ++x) {
        int low = 255;
        for (int k = 0; k < 9; ++k) {
          low = std::min(low, pixelAt(on, x + k % 3 - 1, y + k / 3 - 1)[0]);
        }
        most = std::max(most, low - pixelAt(in, x, y)[0]);
      }
    }
  }
  EXPECT_LT(most, 10);
}

TEST(Renderer, supersamplingDrawsFourPixelsForOne) {
  Scene scene = crateInRoom();
  RenderOptions options;
  scene.picture.antialiasing = Antialiasing::kSupersampled;
  options.materials = Materials{.dither = 0};
  const Picture fine = drawnLook(scene, options);
  EXPECT_EQ(fine.width, kWidthOfLook);
  EXPECT_EQ(fine.height, kHeightOfLook);
  scene.picture.antialiasing = Antialiasing::kOff;
  const Picture coarse = drawnLook(scene, options);
  int differ = 0;
  for (std::size_t k = 0; k < fine.rgb.size(); ++k) {
    differ += std::abs(fine.rgb[k] - coarse.rgb[k]) > 8 ? 1 : 0;
  }
  EXPECT_GT(differ, 500);
  EXPECT_LT(differ, static_cast<int>(fine.rgb.size()) / 20);  // edges and patterns only
}

TEST(Renderer, brightLightIsPressedBelowWhiteAndLosesColour) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3::Zero(), Vec3(1, 1, 1), Color{255, 188, 188}));
  scene.camera = cameraAt(Vec3(0, -10, 0), Vec3::Zero(), 10);
  const auto middle = [&](double brightness) {
    RenderOptions options;
    options.lighting = evenLighting();
    options.lighting->sky = options.lighting->ground = Vec3::Constant(brightness);
    options.materials = Materials{.marks = false, .dither = 0};
    return pixelAt(drawnLook(scene, options), kWidthOfLook / 2, kHeightOfLook / 2);
  };
  const std::array<int, 3> dim = middle(0.7);  // below the shoulder: as it is
  EXPECT_NEAR(dim[0], srgbFromLinear(0.7), 1);
  const std::array<int, 3> bright = middle(2);
  EXPECT_LT(bright[0], 255);
  EXPECT_GT(bright[0], dim[0]);
  EXPECT_LT(bright[0] - bright[1], dim[0] - dim[1]);
}

// The background's middle lies between two codes: dithered pixels are one or the other, and right on average,
// in every row and column too, so that there are no lines.
TEST(Renderer, ditherKeepsTheAverage) {
  Scene scene;
  scene.boxes.push_back(boxAt(Vec3::Zero(), Vec3(1e-3, 1e-3, 1e-3)));
  scene.camera = cameraAt(Vec3(0, -10, 0), Vec3::Zero(), 30);
  const double between = 0.5 * (SrgbTables::get().linear(100) + SrgbTables::get().linear(101)) / 65535.0;
  RenderOptions options;
  options.lighting = evenLighting(Vec3::Constant(between));
  const Picture picture = drawnLook(scene, options);
  double sum = 0;
  std::set<int> codes;
  for (int i = 0; i < 64; ++i) {
    double row = 0;
    double column = 0;
    for (int k = 0; k < 64; ++k) {
      const int code = pixelAt(picture, k, i)[0];
      codes.insert(code);
      sum += code;
      row += code / 64.0;
      column += pixelAt(picture, i, k)[0] / 64.0;
    }
    EXPECT_NEAR(row, 100.5, 0.2) << i;
    EXPECT_NEAR(column, 100.5, 0.2) << i;
  }
  EXPECT_EQ(codes, (std::set<int>{100, 101}));
  EXPECT_NEAR(sum / 4096, 100.5, 0.05);
}

// In even light, straight from above: a box that stands on the floor darkens it around, one that floats does
// not.
TEST(Renderer, boxesDarkenTheFloorTheyStandOn) {
  Scene scene = crateInRoom();
  scene.boxes[0].pose.worldFromBody = Mat3::Identity();
  scene.camera = Camera{.eye = Vec3(0, 0, 5), .target = Vec3::Zero(), .up = Vec3::UnitY(), .fovDegrees = 35};
  const auto beside = [&](double height, bool occlusion) {
    scene.boxes[0].pose.position = Vec3(0, 0, height);
    RenderOptions options = lit(evenLighting(Vec3::Constant(0.1)));
    options.materials->occlusion = occlusion;
    return pixelAt(drawnLook(scene, options), kWidthOfLook / 2 + 45,
                   kHeightOfLook / 2 + 3)[0];  // 0.6 m from the middle
  };
  const int bare = beside(0.2, false);
  // Measured 9: what the crate covers of the point's view, as Light.occlusionIsThatOfRays holds it against
  // rays.
  EXPECT_LT(beside(0.2, true), bare - 7);
  EXPECT_NEAR(beside(2.5, true), beside(2.5, false), 4);
}

// Walls of no room may hide each other, so they are drawn for their depth first.
TEST(Renderer, freeWallsLeaveTheFloorsShadeAsItIs) {
  Scene scene = crateInRoom();
  scene.camera = Camera{.eye = Vec3(0, 0, 5), .target = Vec3::Zero(), .up = Vec3::UnitY(), .fovDegrees = 35};
  const auto shade = [&] {
    RenderOptions options = lit(evenLighting(Vec3::Constant(0.1)));
    const int bare = pixelAt(drawnLook(scene, options), kWidthOfLook / 2 + 45, kHeightOfLook / 2 + 3)[0];
    options.materials->occlusion = true;
    return bare - pixelAt(drawnLook(scene, options), kWidthOfLook / 2 + 45, kHeightOfLook / 2 + 3)[0];
  };
  const int alone = shade();
  EXPECT_GT(alone, 2);
  scene.walls.push_back({.name = "far", .normal = -Vec3::UnitX(), .offset = -20, .material = {}});
  EXPECT_NEAR(shade(), alone, 1);
}

// A floor seen from above, along which boxes go to x = 10. The scene's radius, which is the margin, is that
// of a cube of twice the box's radius √¾: 1.5 m. Half of it is seen half way.
TEST(Renderer, aFloorOnWhichBoxesGoFarFadesIntoTheBackgroundAtItsEnd) {
  Scene scene;
  scene.gravity = Vec3::Zero();
  scene.boxes.push_back(boxAt(Vec3(0, 0, 0.5), Vec3(0.5, 0.5, 0.5)));
  scene.walls.push_back(wallAt(Vec3::UnitZ(), 0));
  scene.camera =
      Camera{.eye = Vec3(6, 0, 20), .target = Vec3(6, 0, 0), .up = Vec3::UnitY(), .fovDegrees = 35};
  const Vec3 background(0.02, 0.1, 0.3);
  RenderOptions options = lit(evenLighting(background));
  options.materials->tileContrast = 0;
  options.materials->joints = 0;
  const Vec3 floor = options.materials->floor;
  const double pixels = 0.5 * kHeightOfLook / std::tan(17.5 * std::numbers::pi / 180) / 20;
  const auto expectSeen = [&](const Picture& picture, double x, const Vec3& color) {
    const int column = static_cast<int>(0.5 * kWidthOfLook + pixels * (x - 6));
    const std::array<int, 3> seen = pixelAt(picture, column, kHeightOfLook / 2 + 3);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(seen.at(static_cast<std::size_t>(channel)), srgbFromLinear(color[channel]), 8)
          << channel << " at " << x;
    }
  };
  const Picture before = drawnLook(scene, options);
  expectSeen(before, 2, floor);
  expectSeen(before, 5, background);
  options.reaches = {{.min = Vec2(-1, -1), .max = Vec2(10, 1)}};
  const Picture after = drawnLook(scene, options);
  expectSeen(after, 2, floor);
  expectSeen(after, 9.8, floor);
  expectSeen(after, 10.75, 0.5 * (floor + background));
  expectSeen(after, 11.6, background);
  options.reaches = {{.min = Vec2(-1, -1), .max = Vec2(1, 1)}};
  EXPECT_EQ(drawnLook(scene, options).rgb, before.rgb);  // not one byte
}

TEST(Renderer, looksDiffer) {
  Scene scene = crateInRoom();
  const auto as = [&](Look look) {
    scene.picture.look = look;
    return drawnLook(scene).rgb;
  };
  const std::vector<std::uint8_t> studio = as(Look::kStudio);
  const std::vector<std::uint8_t> blueprint = as(Look::kBlueprint);
  EXPECT_NE(studio, blueprint);
  EXPECT_NE(studio, as(Look::kClay));
  EXPECT_NE(blueprint, as(Look::kClay));
}

}  // namespace
}  // namespace careen
