#include "view/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "stage/turn.h"

namespace careen {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFilled = 0.92;  // of the picture from its middle to its edge; the rest is margin

// Finds the nearest eye position, for a given direction, from which all points are in view. In the camera
// frame a point (x, y, z) is in view if |x − x₀| <= s (z₀ − z), where s is the slope of the picture's edge:
// two half-spaces per axis, so the largest bound of each over all points is sufficient.
class Framing {
 public:
  Framing(const Camera& towards, double aspect)
      : camera_(towards), worldFromCamera_(lookAt(towards.eye, towards.target, towards.up)) {
    const double slope = kFilled * slopeOfView(towards.fovDegrees);
    slope_ = {slope * aspect, slope};
  }

  void add(const Vec3& point) {
    const Vec3 p = worldFromCamera_.transpose() * point;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double across = p[static_cast<Eigen::Index>(axis)] / slope_[axis];
      most_[axis] = std::max(most_[axis], p.z() + across);
      least_[axis] = std::max(least_[axis], p.z() - across);
    }
    nearest_ = std::max(nearest_, p.z());
    farthest_ = std::min(farthest_, p.z());
  }

  Camera camera() const {
    Vec3 eye = Vec3::Zero();
    eye.z() = nearest_ + 0.02 * (nearest_ - farthest_);  // so that a thin object seen end-on is still visible
    for (std::size_t axis = 0; axis < 2; ++axis) {
      eye[static_cast<Eigen::Index>(axis)] = 0.5 * slope_[axis] * (most_[axis] - least_[axis]);
      eye.z() = std::max(eye.z(), 0.5 * (most_[axis] + least_[axis]));
    }
    Vec3 target = eye;
    target.z() = 0.5 * (nearest_ + farthest_);
    Camera camera = camera_;
    camera.eye = worldFromCamera_ * eye;
    camera.target = worldFromCamera_ * target;
    return camera;
  }

 private:
  Camera camera_;
  Mat3 worldFromCamera_;
  std::array<double, 2> slope_{};
  std::array<double, 2> most_ = {-kInfinity, -kInfinity};
  std::array<double, 2> least_ = {-kInfinity, -kInfinity};
  double nearest_ = -kInfinity;
  double farthest_ = kInfinity;
};

constexpr std::size_t kCoordinates = 7;
using Coordinates = std::array<double, kCoordinates>;

Coordinates coordinatesOf(const CameraKey& key) {
  return {key.eye.x(),    key.eye.y(),    key.eye.z(),   key.target.x(),
          key.target.y(), key.target.z(), key.fovDegrees};
}

// Slope at a key, from the slopes of the lines to its neighbours at distances `before` and `after` [s].
double slopeAt(double slopeBefore, double slopeAfter, double before, double after) {
  if (!(slopeBefore * slopeAfter > 0)) {
    return 0;
  }
  const double weightBefore = 2 * after + before;
  const double weightAfter = after + 2 * before;
  return (weightBefore + weightAfter) / (weightBefore / slopeBefore + weightAfter / slopeAfter);
}

}  // namespace

CameraKey between(std::span<const CameraKey> keys, double time, Easing easing) {
  const auto next = std::upper_bound(keys.begin(), keys.end(), time,
                                     [](double t, const CameraKey& key) { return t < key.time; });
  if (next == keys.begin()) {
    return keys.front();
  }
  if (next == keys.end()) {
    return keys.back();
  }
  const auto to = static_cast<std::size_t>(next - keys.begin());
  const std::size_t from = to - 1;
  if (easing == Easing::kCut) {
    return keys[from];
  }
  const auto slope = [&](std::size_t key, std::size_t coordinate) {
    const auto line = [&](std::size_t a) {
      return (coordinatesOf(keys[a + 1])[coordinate] - coordinatesOf(keys[a])[coordinate]) /
             (keys[a + 1].time - keys[a].time);
    };
    return key == 0 || key + 1 == keys.size()
               ? 0
               : slopeAt(line(key - 1), line(key), keys[key].time - keys[key - 1].time,
                         keys[key + 1].time - keys[key].time);
  };
  const double step = keys[to].time - keys[from].time;
  const double u = (time - keys[from].time) / step;
  const double rise = easing == Easing::kLinear ? u : u * u * (3 - 2 * u);
  const Coordinates a = coordinatesOf(keys[from]);
  const Coordinates b = coordinatesOf(keys[to]);
  Coordinates at{};
  for (std::size_t i = 0; i < kCoordinates; ++i) {
    at[i] = a[i] + rise * (b[i] - a[i]);
    if (easing == Easing::kSmooth) {
      at[i] += step * u * (1 - u) * ((1 - u) * slope(from, i) - u * slope(to, i));
    }
  }
  return {.time = time,
          .eye = Vec3(at[0], at[1], at[2]),
          .target = Vec3(at[3], at[4], at[5]),
          .fovDegrees = at[6]};
}

Camera cameraThatFrames(const Trajectory& run, const TimeMap& clock, double aspect) {
  constexpr std::size_t kMostPoses = 200'000;  // evaluated in a fraction of a second
  const std::size_t moments = std::clamp<std::size_t>(kMostPoses / run.world.bodies.size(), 60, 600);
  Camera towards;
  towards.eye = kDefaultDirection;
  Framing framing(towards, aspect);
  for (std::size_t i = 0; i < moments; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(moments - 1);
    const std::vector<Pose> poses = run.poses(clock.sceneTime(part * clock.duration()));
    for (std::size_t box = 0; box < poses.size(); ++box) {
      const Vec3& half = run.world.bodies[box].halfExtents;
      for (int index = 0; index < kCorners; ++index) {
        framing.add(poses[box].worldPoint(corner(half, index)));
      }
    }
  }
  for (const Spring& spring : run.world.springs) {
    for (const SpringEnd& end : {spring.from, spring.to}) {
      if (!end.body) {
        framing.add(end.point);
      }
    }
  }
  for (const Joint& joint : run.world.joints) {
    if (!joint.to.body) {
      framing.add(joint.to.point);
    }
  }
  return framing.camera();
}

CameraPath::CameraPath(const Trajectory& run, TimeMap clock, double aspect)
    : move_(run.stage.cameraMove),
      run_(run),
      clock_(std::move(clock)),
      start_(run.stage.camera ? *run.stage.camera : cameraThatFrames(run, clock_, aspect)) {
  if (move_.followed) {
    followedStart_ = run.state(*move_.followed, 0).pose.position;
  }
}

// Beyond the ends of the film the path is point-reflected at its end points, so that its velocity is
// continuous.
Vec3 CameraPath::followedCentre(double filmTime) const {
  const double end = clock_.duration();
  const auto centre = [&](double time) {
    return run_.state(*move_.followed, clock_.sceneTime(time)).pose.position;
  };
  if (filmTime < 0) {
    return 2 * centre(0) - centre(std::min(-filmTime, end));
  }
  if (filmTime > end) {
    return 2 * centre(end) - centre(std::max(2 * end - filmTime, 0.0));
  }
  return centre(filmTime);
}

// A cubic B-spline over the positions at multiples of kFollowStep: its acceleration is continuous even at
// impacts; it is exact for uniform motion, and off by h² g / 6 in free flight (7 cm on Earth).
Vec3 CameraPath::followedSmoothly(double filmTime) const {
  const double steps = filmTime / kFollowStep;
  const double whole = std::floor(steps);
  const double u = steps - whole;
  const std::array<double, 4> weights = {(1 - u) * (1 - u) * (1 - u) / 6, (4 + u * u * (3 * u - 6)) / 6,
                                         (1 + u * (3 + u * (3 - 3 * u))) / 6, u * u * u / 6};
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < weights.size(); ++i) {
    sum += weights[i] * followedCentre((whole + static_cast<double>(i) - 1) * kFollowStep);
  }
  return sum;
}

Camera CameraPath::at(double filmTime) const {
  Camera camera = start_;
  if (!move_.keys.empty()) {
    const CameraKey key = between(move_.keys, filmTime, move_.easing);
    camera.eye = key.eye;
    camera.target = key.target;
    camera.fovDegrees = key.fovDegrees;
  }
  if (move_.orbitDegrees != 0) {
    const Mat3 turned = rotationAbout(camera.up, turnFrom(std::fmod(move_.orbitDegrees * filmTime, 360)));
    camera.eye = camera.target + turned * (camera.eye - camera.target);
  }
  if (move_.followed) {
    const Vec3 moved = followedSmoothly(filmTime) - followedStart_;
    camera.eye += moved;
    camera.target += moved;
  }
  return camera;
}

}  // namespace careen
