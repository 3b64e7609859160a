// Edges of shadows in pictures, against the exact ones: corners projected along the light.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <vector>

#include "render/draw/renderer.h"
#include "render/rays.h"

namespace careen {
namespace {

constexpr int kWidthOfEdges = 320;
constexpr int kHeightOfEdges = 180;
const Vec3 kTowards = Vec3(-0.5, -0.4, 1).normalized();

// A box whose shadow falls on the floor, or on a slab that lies there, `height` above it.
struct Case {
  const char* name;
  double turn;
  Vec3 half;
  Vec3 position;
  double height;
  double spread;
};

Scene sceneOf(const Case& each) {
  Scene scene = onOpenFloor(cameraAt(Vec3(1.5, -5, 5), Vec3(0.3, 0.3, 0.2), 40));
  scene.boxes.push_back(boxAt(each.position, each.half, Color{255, 255, 255}));
  scene.boxes[0].name = "caster";
  scene.boxes[0].pose.worldFromBody =
      (Eigen::AngleAxisd(each.turn, Vec3::UnitZ()) * Eigen::AngleAxisd(0.7 * each.turn, Vec3(0.6, 0.8, 0)))
          .toRotationMatrix();
  if (each.height > 0) {
    scene.boxes.push_back(
        boxAt(Vec3(0.3, 0.3, 0.5 * each.height), Vec3(3, 3, 0.5 * each.height), Color{255, 255, 255}));
    scene.boxes[1].name = "slab";
  }
  return scene;
}

// Corners of a box where they fall along the light on a plane z = height, as a convex outline.
std::vector<Vec3> shadowOf(const SceneBox& box, double height) {
  std::vector<Vec3> points;
  for (int index = 0; index < 8; ++index) {
    Vec3 corner = box.halfExtents;
    for (int k = 0; k < 3; ++k) {
      corner[k] *= (index >> k) % 2 == 0 ? 1 : -1;
    }
    const Vec3 at = box.pose.worldPoint(corner);
    points.emplace_back(at - (at.z() - height) / kTowards.z() * kTowards);
  }
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
  std::vector<Vec3> outline;
  const auto wrap = [&outline](auto begin, auto end) {
    const std::size_t first = outline.size();
    for (auto point = begin; point != end; ++point) {
      const auto turnsRight = [&] {
        const Vec3& a = outline[outline.size() - 2];
        const Vec3& b = outline.back();
        return (b - a).cross(*point - b).z() <= 0;
      };
      while (outline.size() >= first + 2 && turnsRight()) {
        outline.pop_back();
      }
      outline.push_back(*point);
    }
    outline.pop_back();
  };
  wrap(points.begin(), points.end());
  wrap(points.rbegin(), points.rend());
  return outline;
}

struct Edges {
  double farthest = 0;  // [px] from the exact edge
  double step = 0;      // [px] between places a pixel apart
  int places = 0;
};

// Light at a point of the picture, between the middles of its pixels.
class LightBetween {
 public:
  LightBetween(const Picture& with, const Picture& without) : with_(with), without_(without) {}
  double at(const Vec2& point) const {
    const double x = point.x() - 0.5;
    const double y = point.y() - 0.5;
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(std::floor(y));
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const double across = i % 2 == 0 ? 1 - (x - left) : x - left;
      const double down = i / 2 == 0 ? 1 - (y - top) : y - top;
      const int column = left + i % 2;
      const int row = top + i / 2;
      sum += across * down * lightAt(with_, column, row) / lightAt(without_, column, row);
    }
    return sum;
  }

 private:
  const Picture& with_;
  const Picture& without_;
};

// How far along `outward` [px] from a point half of the light is reached, within `reach`.
std::optional<double> crossing(const LightBetween& light, const Vec2& point, const Vec2& outward,
                               double reach) {
  constexpr double kStep = 0.05;
  for (double at = -reach; at < reach; at += kStep) {
    const double here = light.at(point + at * outward);
    const double next = light.at(point + (at + kStep) * outward);
    if (here < 0.5 && next >= 0.5) {
      return at + kStep * (0.5 - here) / (next - here);
    }
  }
  return std::nullopt;
}

Edges edgesOf(const Case& each) {
  const Scene scene = sceneOf(each);
  const RunSetup setup = setupOf(scene, kWidthOfEdges, kHeightOfEdges);
  const RenderOptions options = sunlit(kTowards, each.spread);
  const Picture with = Renderer(setup, options).draw(posesOf(scene));
  const Picture without = Renderer(setup, unhindered(options)).draw(posesOf(scene));
  const LightBetween light(with, without);
  const Rays rays(setup, posesOf(scene), *scene.camera);
  const View view =
      viewOf(*scene.camera, extentOf(setup), static_cast<double>(kWidthOfEdges) / kHeightOfEdges);
  const auto pixelOf = [&](const Vec3& point) {
    return Vec2(view.pixelFromWorld(point, kWidthOfEdges, kHeightOfEdges).head<2>());
  };
  const std::vector<Vec3> outline = shadowOf(scene.boxes[0], each.height);
  Edges edges;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3& from = outline[i];
    const Vec3& to = outline[(i + 1) % outline.size()];
    const Vec2 along = (pixelOf(to) - pixelOf(from)).normalized();
    const Vec2 outward(-along.y(), along.x());  // y is down, the outline counterclockwise seen from above
    const double length = (pixelOf(to) - pixelOf(from)).norm();
    // Corners are rounded by the penumbra.
    const double soft = each.spread * 2.5 * (each.position.z() - each.height) / (to - from).norm() * length;
    const double reach = 2 + soft;
    std::optional<double> before;
    for (double at = 3 + 2 * soft; at < length - 3 - 2 * soft; at += 1) {
      const Vec2 point = pixelOf(from + at / length * (to - from));
      bool isClear = point.x() > reach + 3 && point.x() < kWidthOfEdges - reach - 3 &&
                     point.y() > reach + 3 && point.y() < kHeightOfEdges - reach - 3;
      for (double aside = -reach - 2; isClear && aside <= reach + 2; aside += 0.5) {
        const Vec2 there = point + aside * outward;
        isClear = rays.seenAt(there.x(), there.y()).thing == (each.height > 0 ? 1 : Rays::kSurfaces);
      }
      const std::optional<double> found = isClear ? crossing(light, point, outward, reach) : std::nullopt;
      EXPECT_EQ(found.has_value(), isClear) << each.name << ' ' << point.transpose();
      if (found) {
        edges.farthest = std::max(edges.farthest, std::abs(*found));
        edges.step = before ? std::max(edges.step, std::abs(*found - *before)) : edges.step;
        ++edges.places;
      }
      before = found;
    }
  }
  return edges;
}

// The largest deviation is half a pixel, and at four times the size an edge has no steps: they would be as
// high as a pixel there. Measured: 0.18 px off, steps of 0.14 px.
TEST(ShadowEdge, isWhereTheExactOneIsAndHasNoSteps) {
  const Vec3 flat(0.6, 0.5, 0.02);
  const Vec3 cube(0.4, 0.4, 0.4);
  for (const Case& each :
       std::initializer_list<Case>{{"hard, cube in the air", 0.3, cube, Vec3(-0.3, -0.3, 1.2), 0, 1e-4},
                                   {"hard, turned", 1.1, cube, Vec3(-0.3, -0.3, 1.2), 0, 1e-4},
                                   {"hard, standing", 0, cube, Vec3(0, 0, 0.4), 0, 1e-4},
                                   {"hard, card", 0.2, flat, Vec3(-0.2, 0, 0.8), 0, 1e-4},
                                   {"soft, cube in the air", 0.3, cube, Vec3(-0.3, -0.3, 1.2), 0, 0.03},
                                   {"soft, standing", 0, cube, Vec3(0, 0, 0.4), 0, 0.03},
                                   {"hard, on a slab", 0.3, cube, Vec3(-0.3, -0.3, 1.4), 0.2, 1e-4},
                                   {"soft, on a slab", 0.9, flat, Vec3(-0.2, -0.2, 1.0), 0.2, 0.03}}) {
    const Edges edges = edgesOf(each);
    std::cout << each.name << ": edge off by " << edges.farthest << " px, steps " << edges.step << " px in "
              << edges.places << " places\n";
    EXPECT_GT(edges.places, 20) << each.name;
    EXPECT_LT(edges.farthest, 0.5) << each.name;
    EXPECT_LT(edges.step, 0.25) << each.name;
  }
}

}  // namespace
}  // namespace careen
