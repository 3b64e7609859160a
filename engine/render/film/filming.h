#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/pose.h"
#include "image/picture.h"
#include "stage/camera.h"
#include "stage/time_map.h"
#include "trajectory/trajectory.h"
#include "view/camera_path.h"
#include "view/orbit.h"
#include "view/wall_reach.h"

namespace careen {

class Overlays;
class Renderer;
struct RenderOptions;

/// What the film of a run shows at each moment: camera and box poses, both exact at any time. Keeps a
/// reference to the run.
class Filming {
 public:
  /// InputError if the film begins after the end of the run.
  explicit Filming(const Trajectory& run);

  double duration() const { return clock_.duration(); }  ///< [s] of the film
  /// [s] of the scene; before the start and after the end of the film everything stands still, the camera
  /// too.
  double sceneTime(double filmTime) const { return clock_.sceneTime(filmTime); }
  Camera camera(double filmTime) const;
  /// From point `index` of so many of the lens, if the stage has one that is sharp at one distance alone.
  Camera camera(double filmTime, int index, int count) const;
  /// Sets the camera's orbit relative to the film's camera.
  void turnCamera(const Orbit& orbit) { orbit_ = orbit; }

  /// For a renderer of the film: where its light comes from, how far walls reach.
  void prepare(RenderOptions& options) const;

  /// InputError if in any of the frames the camera keys leave the view or up direction undefined.
  void checkCamera(std::span<const std::int64_t> frames, const FrameRate& rate) const;

  /// The picture at a moment. With an open shutter (motion blur) it is the average of pictures at the
  /// midpoints of `samples` equal parts of the exposure time, which is centred on the moment; and with a
  /// lens, of pictures from points that are spread evenly over it, as many as the larger of both numbers.
  /// If the stage's pictures have alpha, so has this one.
  Picture draw(Renderer& renderer, double filmTime, const Shutter& shutter, const FrameRate& rate) const;

  /// Draws the overlays of that moment over its picture.
  void explain(Renderer& renderer, Picture& picture, double filmTime, Overlays& overlays) const;
  /// The same of the last of several moments over their picture by drawStrobe.
  void explainStrobe(Renderer& renderer, Picture& picture, std::span<const double> filmTimes,
                     Overlays& overlays) const;

  /// One picture with the boxes at all of the moments, seen by the camera of the first.
  Picture drawStrobe(Renderer& renderer, std::span<const double> filmTimes) const;

 private:
  /// What to draw, and for how many of the moments of an exposure.
  struct Sample {
    std::vector<Pose> poses;
    Camera camera;
    double time = 0;  // [s] of the run
    int weight = 1;
  };
  bool isSame(const Sample& a, const Sample& b) const;
  std::vector<Sample> samplesAt(double filmTime, const Shutter& shutter, const FrameRate& rate) const;
  Picture drawn(Renderer& renderer, const std::vector<Sample>& samples) const;

  const Trajectory& run_;
  TimeMap clock_;
  CameraPath path_;
  std::vector<WallReach> reaches_;
  Orbit orbit_;
};

}  // namespace careen
