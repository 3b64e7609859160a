#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/pose.h"
#include "image/picture.h"
#include "render/view/camera_path.h"
#include "render/view/orbit.h"
#include "stage/camera.h"
#include "stage/time_map.h"
#include "trajectory/trajectory.h"

namespace careen {

class Overlays;
class Renderer;

/// What the film of a run shows at each of its moments: from where, and where the boxes are, both exact at
/// any time. Keeps the run by reference.
class Filming {
 public:
  /// InputError if the film begins after the run's end.
  explicit Filming(const Trajectory& run);

  double duration() const { return clock_.duration(); }  ///< [s] of the film
  /// [s] of the scene; before the film's beginning and after its end all stands still, the camera too.
  double sceneTime(double filmTime) const { return clock_.sceneTime(filmTime); }
  Camera camera(double filmTime) const;
  /// From now on the camera is turned so, against where the film has it.
  void turnCamera(const Orbit& orbit) { orbit_ = orbit; }

  /// InputError if there is a frame in which the camera's keys leave it nothing to look at or no upward.
  void checkCamera(std::span<const std::int64_t> frames, const FrameRate& rate) const;

  /// The picture at a moment. With a shutter that is open it is the average of pictures at the middles of
  /// `samples` equal parts of the time that it is open, half of it before the moment and half after.
  Picture draw(Renderer& renderer, double filmTime, const Shutter& shutter, const FrameRate& rate) const;

  /// What explains the picture of that moment, over it.
  void explain(Renderer& renderer, Picture& picture, double filmTime, const Overlays& overlays) const;

  /// One picture with the boxes as they are at every one of the moments, from where the camera is at the
  /// first.
  Picture drawStrobe(Renderer& renderer, std::span<const double> filmTimes) const;

 private:
  const Trajectory& run_;
  TimeMap clock_;
  CameraPath path_;
  Orbit orbit_;
};

}  // namespace careen
