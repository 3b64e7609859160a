#include <GL/glcorearb.h>

#include "render/draw/contact_shade.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "render/gl/gl.h"
#include "render/gl/shader.h"

namespace careen {
namespace {

using Mat2 = Eigen::Matrix2d;

/// [1] of a box's size: distance at which its shade vanishes, and least width of the shade beyond the
/// outline.
constexpr double kFarthest = 1.2;
constexpr double kWidth = 0.45;
constexpr double kWidening = 0.5;  // increase of that width per distance
constexpr double kLift = 0.02;     // above the surface, to avoid z-fighting

/// [1] of a half extent squared: a rectangle's second moment is 1/3, but that would leave its rim lit.
constexpr double kMoment = 0.75;

bool holds(const Surface& surface, const Vec3& point, double margin) {
  for (std::size_t i = 0; i < surface.outline.size(); ++i) {
    const Vec3& from = surface.outline[i];
    const Vec3 along = (surface.outline[(i + 1) % surface.outline.size()] - from).normalized();
    if (surface.normal.dot(along.cross(point - from)) < -margin) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::vector<ContactShade> contactShades(std::span<const DrawnBox> boxes, std::span<const Surface> surfaces,
                                        double strength) {
  std::vector<ContactShade> shades;
  for (const DrawnBox& box : boxes) {
    const double size = std::cbrt(box.halfExtents.prod());
    for (const Surface& surface : surfaces) {
      const double height = surface.normal.dot(box.pose.position - surface.outline[0]);
      const Vec3 axes = box.pose.worldFromBody.transpose() * surface.normal;
      const double gap = height - axes.cwiseAbs().dot(box.halfExtents);
      const Vec3 centre = box.pose.position - height * surface.normal;
      if (!box.marked || height <= 0 || gap > kFarthest * size ||
          !holds(surface, centre, box.halfExtents.norm())) {
        continue;
      }
      const double near = 1 - std::max(0.0, gap) / (kFarthest * size);
      Mat2 moments = std::pow(kWidth * size + kWidening * std::max(0.0, gap), 2) * Mat2::Identity();
      for (int k = 0; k < 3; ++k) {
        const Vec3 axis = box.halfExtents[k] * box.pose.worldFromBody.col(k);
        const Vec2 seen(surface.across.dot(axis), surface.along.dot(axis));
        moments += kMoment * seen * seen.transpose();
      }
      const Eigen::SelfAdjointEigenSolver<Mat2> spot(moments);
      const auto half = [&](int k) {
        const Vec2 direction = std::sqrt(spot.eigenvalues()[k]) * spot.eigenvectors().col(k);
        return Vec3(direction.x() * surface.across + direction.y() * surface.along);
      };
      shades.push_back({.centre = centre + kLift * size * surface.normal,
                        .first = half(0),
                        .second = half(1),
                        .strength = strength * near * near});
    }
  }
  return shades;
}

ContactShadeBatch::ContactShadeBatch(const Gl& gl, const std::filesystem::path& shaders)
    : gl_(gl),
      array_(makeVertexArray(gl)),
      corners_(gl, {{0, 2}}, VertexBuffer::Step::kVertex),
      instances_(gl, {{1, 3}, {2, 3}, {3, 3}, {4, 1}}, VertexBuffer::Step::kInstance),
      program_(linkProgram(gl, shaders, {"contact_shade.vert", "contact_shade.frag"})) {
  constexpr auto kReach = static_cast<float>(kShadeReach);
  corners_.fill(std::array<float, 12>{-kReach, -kReach, kReach, -kReach, kReach, kReach, -kReach, -kReach,
                                      kReach, kReach, -kReach, kReach});
}

void ContactShadeBatch::place(std::span<const ContactShade> shades, const Vec3& eye) {
  std::vector<float> records;
  records.reserve(shades.size() * 10);
  for (const ContactShade& shade : shades) {
    append(records, shade.centre - eye);
    append(records, shade.first);
    append(records, shade.second);
    records.push_back(static_cast<float>(shade.strength));
  }
  instances_.fill(records);
}

void ContactShadeBatch::draw() const {
  if (instances_.count() == 0) {
    return;
  }
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
  gl_.DepthMask(GL_FALSE);
  gl_.Disable(GL_CULL_FACE);
  gl_.UseProgram(program_);
  gl_.BindVertexArray(array_);
  gl_.DrawArraysInstanced(GL_TRIANGLES, 0, 6, instances_.count());
  gl_.Enable(GL_CULL_FACE);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_BLEND);
}

}  // namespace careen
