// Another run, as outlines of its boxes.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

#include "core/brief.h"
#include "core/math/pose_difference.h"
#include "render/overlay/panels.h"

namespace careen {
namespace {

constexpr double kHiddenEdge = 0.3;  // opacity of edges that their own box would hide
constexpr double kShortestWay = 2;   // [px] a shorter line between the centres is not drawn

/// A box of the run and where the other run has it.
struct Pair {
  std::size_t body = 0;
  const Body* ghost = nullptr;
  Pose pose;
};

std::vector<Pair> pairsOf(const OverlayFrame& frame) {
  std::vector<Pair> pairs;
  const std::vector<Body>& bodies = frame.trajectory.world.bodies;
  for (std::size_t other = 0; other < frame.ghost->tracks.size(); ++other) {
    const Body& ghost = frame.ghost->world.bodies[other];
    const auto named =
        std::find_if(bodies.begin(), bodies.end(), [&](const Body& body) { return body.name == ghost.name; });
    if (named != bodies.end() && !isImmovable(ghost.mass)) {
      pairs.push_back({.body = static_cast<std::size_t>(named - bodies.begin()),
                       .ghost = &ghost,
                       .pose = frame.ghost->boxPoseAt(other, frame.time)});
    }
  }
  return pairs;
}

// Of the box in the run itself.
Pose ownPose(const OverlayFrame& frame, std::size_t body) {
  return boxPose(frame.trajectory.world.bodies[body], frame.states[body].pose);
}

// Whether the face with this outward normal, through this point, is turned to the eye.
bool isSeen(const OverlayFrame& frame, const Vec3& normal, const Vec3& point) {
  return normal.dot(frame.screen.eye() - point) > 0;
}

void addOutline(OverlayShapes& shapes, const OverlayFrame& frame, const Pair& pair) {
  const Vec3& half = pair.ghost->halfExtents;
  for (const bool hidden : {true, false}) {
    for (int from = 0; from < kCorners; ++from) {
      for (int axis = 0; axis < 3; ++axis) {
        const int bit = 4 >> axis;  // see corner()
        if ((from & bit) != 0) {
          continue;
        }
        const Vec3 start = corner(half, from);
        const Vec3 world = pair.pose.worldPoint(start);
        bool seen = false;
        for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
          const Vec3 normal = pair.pose.worldFromBody.col(other) * (start[other] > 0 ? 1 : -1);
          seen = seen || isSeen(frame, normal, world);
        }
        const auto line = frame.screen.line(world, pair.pose.worldPoint(corner(half, from | bit)));
        if (seen != hidden && line) {
          shapes.emplace_back(Stroke{.from = line->first,
                                     .to = line->second,
                                     .width = 0.6 * frame.style.line,
                                     .halo = hidden ? 0 : frame.style.halo,
                                     .ink = {kIvory, hidden ? kHiddenEdge : 1}});
        }
      }
    }
  }
}

void addWay(OverlayShapes& shapes, const OverlayFrame& frame, const Pair& pair) {
  const auto line = frame.screen.line(ownPose(frame, pair.body).position, pair.pose.position);
  if (line && (line->second - line->first).norm() >= kShortestWay) {
    shapes.emplace_back(Stroke{.from = line->first,
                               .to = line->second,
                               .width = 0.6 * frame.style.line,
                               .halo = frame.style.halo,
                               .ink = {kAmber, 1}});
  }
}

std::string textOf(const OverlayFrame& frame, const std::vector<Pair>& pairs) {
  PoseDifference worst;
  std::string name;
  for (const Pair& pair : pairs) {
    const PoseDifference apart =
        differenceOf(ownPose(frame, pair.body), pair.pose, pair.ghost->halfExtents.norm());
    if (apart.relative > worst.relative) {
      worst = apart;
      name = pairs.size() > 1 ? pair.ghost->name + "  " : "";
    }
  }
  // What is below is rounding.
  constexpr double kNoWay = 1e-9;   // [m]
  constexpr double kNoTurn = 1e-6;  // [°]
  const double degrees = worst.angle * 180 / std::numbers::pi;
  return name + "apart " + brief(worst.position > kNoWay ? worst.position : 0, 3) + " m, " +
         brief(degrees > kNoTurn ? degrees : 0, 3) + "°";
}

bool hasEnded(const OverlayFrame& frame) { return frame.time > frame.ghost->settings.duration; }

}  // namespace

void addGhost(OverlayShapes& shapes, const OverlayFrame& frame) {
  if (hasEnded(frame)) {
    return;
  }
  const std::vector<Pair> pairs = pairsOf(frame);
  std::vector<Vec3> centres;
  std::transform(pairs.begin(), pairs.end(), std::back_inserter(centres),
                 [](const Pair& pair) { return pair.pose.position; });
  for (const std::size_t i : farthestFirst(frame.screen, centres)) {
    addOutline(shapes, frame, pairs[i]);
    addWay(shapes, frame, pairs[i]);
  }
}

void addGhostPanel(OverlayShapes& shapes, const OverlayFrame& frame) {
  addNote(shapes, frame, hasEnded(frame) ? "the other run has ended" : textOf(frame, pairsOf(frame)),
          PanelCorner::kLowerRight, Typeface::kPlain);
}

}  // namespace careen
