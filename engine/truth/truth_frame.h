#pragma once

#include <string>

#include "stage/time_map.h"
#include "trajectory/trajectory.h"
#include "truth/channels.h"
#include "truth/ray_cast.h"
#include "view/camera_path.h"
#include "view/surfaces.h"

namespace careen {

/// InputError if a box is drawn as a mesh: what is labelled are boxes.
void checkLabels(const RunSetup& setup);

/// Labels of the frames of a film: for each pixel's centre the exact answer, from the run and in double
/// precision, not from a picture.
///
/// A frame is an NPZ archive. Pictures are arrays [height, width] in rows from the top, with a last index for
/// vectors, of single precision unless said otherwise:
///   depth        [m] along the line of sight; 0 where nothing is hit
///   distance     [m] from the eye; likewise
///   instance     '<i4': 0 nothing, else an id that truth.json explains: boxes from 1 on, then walls
///   face         '|u1': 0 no box, 1 … 6 its face −x, +x, −y, +y, −z, +z; of part k of a body of several
///   boxes, 6 k more
///   normal       [1] of the surface, world frame
///   coordinates  [m] the point hit in its body's own frame; of a wall, in the world
///   flow         [px] (right, down) from here to where the same point of the same thing is in the next
///   frame,
///                through impacts too, seen or not. NaN if it is behind the camera then; 0 where nothing is
///                hit
/// For each box in order of its id, with `visibility`:
///   visible_pixels, alone_pixels    '<f8': how many it has, and would have if nothing were before it
///   visibility                      '<f8': their ratio; 0 if it is not in the picture
///   box2d        [px] '<f8' [boxes, 4]: left, top, right, bottom of its visible pixels, all included; −1 if
///   none
/// And always, '<f8': time and scene_time [s], position [boxes, 3] [m], quaternion [boxes, 4] (w x y z, world
/// from body), velocity [boxes, 3] [m/s], angular_velocity [boxes, 3] [rad/s, world].
class TruthFrames {
 public:
  /// Keeps a reference to the run. InputError as Filming's constructor.
  explicit TruthFrames(const Trajectory& run);

  double duration() const { return clock_.duration(); }  ///< [s] of the film
  const TimeMap& clock() const { return clock_; }
  /// Where they are at a moment of the film [s]; of walls that move some may be outside.
  std::vector<Surface> surfaces(double filmTime) const;
  PixelRays rays(double filmTime) const;
  /// What the pixels of the moment show.
  CastPicture cast(double filmTime) const;
  /// The archive of the frame at k/fps.
  std::string encode(std::int64_t frame, const ChannelSet& channels) const;

 private:
  std::vector<CastBox> boxesAt(double filmTime) const;

  const Trajectory& run_;
  TimeMap clock_;
  CameraPath path_;
  Extent extent_;
  std::vector<WallReach> reaches_;
};

}  // namespace careen
