#include "render/draw/drawn_box.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace careen {
namespace {

constexpr double kThinnest = 1.5;  // [px] of springs
const Vec3 kSteel(0.30, 0.32, 0.35);

// The end's point is from the centre of mass, a pose of the box's middle.
Vec3 endOf(const SpringEnd& end, const World& world, std::span<const Pose> poses) {
  if (!end.body) {
    return end.point;
  }
  const auto body = static_cast<std::size_t>(*end.body);
  return poses[body].worldPoint(end.point - world.bodies[body].boxCenter);
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

const TriangleMesh* meshOf(const Stage& stage, std::size_t body) {
  const auto part =
      std::lower_bound(stage.parts.begin(), stage.parts.end(), body,
                       [](const DrawnPart& each, std::size_t index) { return each.body < index; });
  return part != stage.parts.end() && part->body == body ? &part->mesh : nullptr;
}

bool isSame(const Pose& a, const Pose& b) {
  return a.position == b.position && a.worldFromBody == b.worldFromBody;
}

// `before`: poses of the previous moment, if any; boxes that have not moved since are already there.
void appendBoxes(std::vector<DrawnBox>& boxes, const World& world, const Stage& stage,
                 std::span<const Pose> poses, std::span<const Pose> before, double springThickness) {
  const std::size_t begun = boxes.size();
  const std::size_t moment = boxes.empty() ? 0 : boxes.back().moment + 1;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    const bool isThere = !before.empty() && isSame(poses[i], before[i]);
    const TriangleMesh* const mesh = meshOf(stage, i);
    const int count = mesh != nullptr ? 1 : body.partCount();
    for (int part = 0; part < count; ++part, ++shown) {
      if (!isThere) {
        boxes.push_back({.pose = mesh != nullptr ? poses[i] : partPose(body, part, poses[i]),
                         .halfExtents = mesh != nullptr ? body.halfExtents : partHalfExtents(body, part),
                         .color = linearFromSrgb(stage.colors[i]),
                         .marked = body.parts.empty(),
                         .shown = shown,
                         .mesh = mesh});
      }
    }
  }
  for (std::size_t i = 0; i < world.springs.size(); ++i) {
    const Vec3 from = endOf(world.springs[i].from, world, poses);
    const Vec3 to = endOf(world.springs[i].to, world, poses);
    if ((to - from).norm() > 0.1 * springThickness) {
      boxes.push_back(rod(from, to, springThickness));
      boxes.back().shown = shown + i;
    }
  }
  std::for_each(boxes.begin() + static_cast<std::ptrdiff_t>(begun), boxes.end(),
                [moment](DrawnBox& box) { box.moment = moment; });
}

// [px] The smaller height of a face's parallelogram in the picture.
double widthOf(const DrawnFace& face, const Vec3& toEye, double distance, double pixelAngle) {
  const auto flat = [&](const Vec3& v) { return Vec3(v - v.dot(toEye) * toEye); };
  const Vec3 across = 2 * flat(face.across);
  const Vec3 along = 2 * flat(face.along);
  const double longer = std::max(across.norm(), along.norm());
  return longer > 0 ? across.cross(along).norm() / longer / (pixelAngle * distance) : 0;
}

// Of one box.
void lightThinFaces(std::span<DrawnFace> faces) {
  const auto widest = std::max_element(
      faces.begin(), faces.end(), [](const DrawnFace& a, const DrawnFace& b) { return a.width < b.width; });
  for (DrawnFace& face : faces) {
    const double own = std::clamp(face.width / kThinFace - 0.5, 0.0, 1.0);
    if (own < 1 && widest->width > face.width) {
      face.normal = (own * face.normal + (1 - own) * widest->normal).normalized();
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

void widenSprings(std::vector<DrawnBox>& boxes, const Vec3& eye, double pixelAngle) {
  for (DrawnBox& box : boxes) {
    if (!box.marked) {
      const double least = 0.5 * kThinnest * pixelAngle * (box.pose.position - eye).norm();
      box.halfExtents.y() = std::max(box.halfExtents.y(), least);
      box.halfExtents.z() = std::max(box.halfExtents.z(), least);
    }
  }
}

double returnLight(std::vector<DrawnBox>& boxes, const Materials& materials) {
  double returned = 0;
  for (DrawnBox& box : boxes) {
    const Vec3 albedo = (1 - materials.ownColor) * materials.boxColor + materials.ownColor * box.color;
    box.returned = materials.bounce * albedo;
    returned += kReturnedToBoxes * box.returned.mean() / static_cast<double>(boxes.size());
  }
  return returned;
}

bool haveCopies(std::span<const DrawnBox> boxes) {
  std::vector<std::size_t> all;
  std::transform(boxes.begin(), boxes.end(), std::back_inserter(all),
                 [](const DrawnBox& box) { return box.shown; });
  std::sort(all.begin(), all.end());
  return std::adjacent_find(all.begin(), all.end()) != all.end();
}

void sortFromEye(std::vector<DrawnBox>& boxes, const Vec3& eye) {
  const auto distance = [&](const DrawnBox& box) { return (box.pose.position - eye).squaredNorm(); };
  std::stable_sort(boxes.begin(), boxes.end(), [&](const DrawnBox& a, const DrawnBox& b) {
    return a.moment == b.moment ? distance(a) < distance(b) : a.moment > b.moment;
  });
}

std::vector<DrawnFace> facesTowards(std::span<const DrawnBox> boxes, const Vec3& eye, double pixelAngle) {
  std::vector<DrawnFace> faces;
  faces.reserve(3 * boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const DrawnBox& box = boxes[i];
    const std::size_t first = faces.size();
    const Vec3 toEye = eye - box.pose.position;
    const double distance = toEye.norm();
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 direction = box.pose.worldFromBody.col(axis);
      const double height = direction.dot(toEye);
      if (!(std::abs(height) > box.halfExtents[axis])) {
        continue;
      }
      const double sign = height > 0 ? 1 : -1;
      const int u = (axis + 1) % 3;
      const int v = (axis + 2) % 3;
      DrawnFace face{.box = i,
                     .side = 2 * axis + (height > 0 ? 0 : 1),
                     .normal = sign * direction,
                     .centre = box.pose.position + sign * box.halfExtents[axis] * direction,
                     .across = box.halfExtents[u] * box.pose.worldFromBody.col(u),
                     .along = box.halfExtents[v] * box.pose.worldFromBody.col(v)};
      const Vec3 sight = eye - face.centre;
      face.width = widthOf(face, sight.normalized(), distance, pixelAngle);
      faces.push_back(face);
    }
    lightThinFaces(std::span(faces).subspan(first));
  }
  return faces;
}

}  // namespace careen
