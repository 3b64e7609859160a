#include <GL/glcorearb.h>

#include "render/draw/box_batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/gl/gl.h"
#include "render/gl/shader.h"
#include "render/look/lighting.h"
#include "view/materials.h"

namespace careen {
namespace {

constexpr int kVertices = 36;
const Vec3 kSteel(0.30, 0.32, 0.35);

// Two triangles for each face of the cube from −1 to 1: corner, then normal.
std::vector<float> cube() {
  std::vector<float> records;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const float side = face % 2 == 0 ? 1.0F : -1.0F;
    for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}}) {
      std::array<float, 3> corner{};
      std::array<float, 3> normal{};
      corner[static_cast<std::size_t>(axis)] = side;
      normal[static_cast<std::size_t>(axis)] = side;
      // Triangles are counterclockwise seen from outside, on both sides of the cube.
      corner[static_cast<std::size_t>((axis + 1) % 3)] = static_cast<float>(u) * side;
      corner[static_cast<std::size_t>((axis + 2) % 3)] = static_cast<float>(v);
      records.insert(records.end(), corner.begin(), corner.end());
      records.insert(records.end(), normal.begin(), normal.end());
    }
  }
  return records;
}

Vec3 endOf(const SpringEnd& end, std::span<const Pose> poses) {
  return end.body ? poses[static_cast<std::size_t>(*end.body)].worldPoint(end.point) : end.point;
}

DrawnBox rod(const Vec3& from, const Vec3& to, double thickness) {
  const Vec3 line = to - from;
  DrawnBox box;
  box.pose.position = 0.5 * (from + to);
  box.pose.worldFromBody = Quat::FromTwoVectors(Vec3::UnitX(), line).toRotationMatrix();
  box.halfExtents = Vec3(0.5 * line.norm(), 0.5 * thickness, 0.5 * thickness);
  box.color = kSteel;
  box.marked = false;
  return box;
}

bool isSame(const Pose& a, const Pose& b) {
  return a.position == b.position && a.worldFromBody == b.worldFromBody;
}

// `before`: poses of the previous moment, if any; boxes that have not moved since are already there.
void appendBoxes(std::vector<DrawnBox>& boxes, const World& world, const Stage& stage,
                 std::span<const Pose> poses, std::span<const Pose> before, double springThickness) {
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    if (!before.empty() && isSame(poses[i], before[i])) {
      continue;
    }
    boxes.push_back({.pose = poses[i],
                     .halfExtents = world.bodies[i].halfExtents,
                     .color = linearFromSrgb(stage.colors[i])});
  }
  for (const Spring& spring : world.springs) {
    const Vec3 from = endOf(spring.from, poses);
    const Vec3 to = endOf(spring.to, poses);
    if ((to - from).norm() > 0.1 * springThickness) {
      boxes.push_back(rod(from, to, springThickness));
    }
  }
}

}  // namespace

std::vector<DrawnBox> drawnBoxes(const World& world, const Stage& stage, std::span<const Pose> poses,
                                 double springThickness) {
  const std::size_t count = world.bodies.size();
  std::vector<DrawnBox> boxes;
  boxes.reserve(poses.size() + world.springs.size());
  for (std::size_t first = 0; first < poses.size() || first == 0; first += std::max<std::size_t>(count, 1)) {
    const std::span<const Pose> before =
        first == 0 ? std::span<const Pose>() : poses.subspan(first - count, count);
    appendBoxes(boxes, world, stage, poses.subspan(first, count), before, springThickness);
  }
  return boxes;
}

BoxBatch::BoxBatch(const Gl& gl, const std::filesystem::path& shaders, const std::vector<std::string>& light)
    : gl_(gl),
      array_(makeVertexArray(gl)),
      corners_(gl, {{0, 3}, {1, 3}}, VertexBuffer::Step::kVertex),
      instances_(gl, {{2, 3}, {3, 3}, {4, 3}, {5, 3}, {6, 3}, {7, 4}}, VertexBuffer::Step::kInstance),
      program_(linkProgram(gl, shaders, with({"box.vert", "box.frag"}, light))) {
  corners_.fill(cube());
}

void BoxBatch::place(std::vector<DrawnBox> boxes, const Vec3& eye) {
  const auto distance = [&](const DrawnBox& box) { return (box.pose.position - eye).squaredNorm(); };
  std::stable_sort(boxes.begin(), boxes.end(),
                   [&](const DrawnBox& a, const DrawnBox& b) { return distance(a) < distance(b); });
  std::vector<float> records;
  records.reserve(boxes.size() * 19);
  for (const DrawnBox& box : boxes) {
    append(records, box.pose.position - eye);
    for (int axis = 0; axis < 3; ++axis) {
      append(records, box.pose.worldFromBody.col(axis));
    }
    append(records, box.halfExtents);
    append(records, box.color);
    records.push_back(box.marked ? 1.0F : 0.0F);
  }
  instances_.fill(records);
}

void BoxBatch::draw() const {
  gl_.UseProgram(program_);
  gl_.BindVertexArray(array_);
  gl_.DrawArraysInstanced(GL_TRIANGLES, 0, kVertices, instances_.count());
}

void BoxBatch::drawDepth() const {
  gl_.BindVertexArray(array_);
  gl_.DrawArraysInstanced(GL_TRIANGLES, 0, kVertices, instances_.count());
}

}  // namespace careen
