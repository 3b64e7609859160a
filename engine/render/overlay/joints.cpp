#include <algorithm>
#include <cmath>

#include "render/overlay/frame.h"

namespace careen {
namespace {

constexpr double kSlack = 1e-6;  // [1] of its length: a rope that is so much shorter is not taut

class JointMarks {
 public:
  JointMarks(OverlayShapes& shapes, const OverlayFrame& frame) : shapes_(shapes), frame_(frame) {}

  void add(const Joint& joint) {
    const Vec3 from = joint.from.pointAt(poseOf(joint.from));
    const Vec3 to = joint.to.pointAt(poseOf(joint.to));
    const Vec3 axis = joint.to.axesAt(poseOf(joint.to)).col(2);
    const double size = sizeOf(joint);
    switch (joint.kind) {
      case Joint::Kind::kHinge:
        line(from - 0.5 * size * axis, from + 0.5 * size * axis);
        dot(from);
        break;
      case Joint::Kind::kSlider:
        line(to + std::max(joint.lowest, -size) * axis, to + std::min(joint.highest, size) * axis);
        dot(from);
        break;
      case Joint::Kind::kRod:
        line(from, to);
        break;
      case Joint::Kind::kRope:
        (from - to).norm() < (1 - kSlack) * joint.length ? dashes(from, to) : line(from, to);
        break;
      default:
        dot(from);
    }
  }

 private:
  Pose poseOf(const JointEnd& end) const {
    return end.body ? frame_.states[static_cast<std::size_t>(*end.body)].pose : Pose{};
  }
  // [m] Half the diagonal of the smaller box.
  double sizeOf(const Joint& joint) const {
    double size = Joint::kFree;
    for (const JointEnd* const end : {&joint.from, &joint.to}) {
      if (end->body) {
        const Body& body = frame_.trajectory.world.bodies[static_cast<std::size_t>(*end->body)];
        size = std::min(size, body.halfExtents.norm());
      }
    }
    return size;
  }
  void dot(const Vec3& at) {
    if (const std::optional<Vec2> seen = frame_.screen.at(at)) {
      stroke(*seen, *seen, 3.4 * frame_.style.line);
    }
  }
  void line(const Vec3& from, const Vec3& to) {
    if (const auto seen = frame_.screen.line(from, to)) {
      stroke(seen->first, seen->second, frame_.style.line);
    }
  }
  void dashes(const Vec3& from, const Vec3& to) {
    constexpr int kDashes = 8;
    for (int k = 0; k < kDashes; ++k) {
      const Vec3 part = (to - from) / (2 * kDashes - 1);
      line(from + 2 * k * part, from + (2 * k + 1) * part);
    }
  }
  void stroke(const Vec2& from, const Vec2& to, double width) {
    shapes_.emplace_back(
        Stroke{.from = from, .to = to, .width = width, .halo = frame_.style.halo, .ink = {kIvory, 1}});
  }

  OverlayShapes& shapes_;
  const OverlayFrame& frame_;
};

void addJoints(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& /*shown*/) {
  JointMarks marks(shapes, frame);
  for (const Joint& joint : frame.trajectory.world.joints) {
    if (frame.time < joint.until) {
      marks.add(joint);
    }
  }
}

}  // namespace

constexpr OverlayKind kJointsOverlay = {
    .shows =
        "joints that have not let go: a dot, the axis of a hinge or slider, a line for a rod or rope, "
        "dashed where it is slack",
    .layer = OverlayLayer::kAxes,
    .add = addJoints};

}  // namespace careen
