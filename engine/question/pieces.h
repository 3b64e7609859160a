#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "question/motion_bounds.h"
#include "trajectory/trajectory.h"

namespace careen {

/// A body in a part of a run in which its motion is one closed form.
struct MovingBody {
  const Body* body = nullptr;
  Segment segment;

  BodyState at(double time) const { return stateAt(segment.motion, body->mass, time - segment.start); }
  /// [m] Middle of its box.
  Vec3 middleAt(double time) const;
  MotionBounds boundsWithin(double from, double to) const {
    return boundsOf(segment.motion, body->mass, from - segment.start, to - segment.start);
  }
  /// Of the middle: those of the centre of mass, and of what turns about it.
  RateBounds middleBounds(const MotionBounds& bounds) const;
};

/// Goes through a run, from its start to `until`, in parts in which each of some bodies is in one segment.
class Pieces {
 public:
  Pieces(const Trajectory& run, std::span<const std::size_t> bodies, double until);

  /// The next part; false after the last. None is empty but the last, where motions begin at the very end.
  bool next();
  double from() const { return from_; }  ///< [s]
  double to() const { return to_; }      ///< [s]
  const MovingBody& operator[](std::size_t index) const { return bodies_[index]; }

 private:
  struct Place {
    const Segments* segments = nullptr;
    std::size_t index = 0;
    double end = 0;  // [s] of the segment
  };
  void enter(std::size_t which, std::size_t index);
  bool beginsAtEnd();

  double until_;
  double from_ = 0;
  double to_ = 0;
  std::vector<Place> places_;
  std::vector<MovingBody> bodies_;
};

}  // namespace careen
