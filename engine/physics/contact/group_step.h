#pragma once

#include <cstddef>
#include <vector>

#include "physics/contact/touching_group.h"
#include "physics/motion/motion.h"

namespace careen {

/// A step that a group of bodies took.
struct GroupStep {
  double length = 0;  ///< [s]
  GroupState start = {};
  GroupState end = {};
  GroupState middle = {};     ///< where two steps of half the length are joined; empty if it is one
  Vec3 slope = Vec3::Zero();  ///< [m/s³] of gravity

  /// The polynomials of a body that is not held.
  ContactStep motion(const TouchingBody& body, std::size_t index) const;

 private:
  void bend(Vec3& from, Vec3& to) const;
};

/// The motions of all bodies in a step, which must outlive it.
class GroupPath {
 public:
  GroupPath(const TouchingGroup& group, const GroupStep& step);

  const GroupStep& step() const { return step_; }
  double length() const { return step_.length; }
  /// Of a body that is not held.
  const ContactStep& motion(std::size_t body) const { return motions_[body]; }
  /// On the body's polynomials.
  GroupBody at(std::size_t body, double time) const;
  /// The step's own states at its ends.
  GroupBody atOrEnd(std::size_t body, double time) const {
    return time <= 0 ? step_.start[body] : time >= length() ? step_.end[body] : at(body, time);
  }

 private:
  const TouchingGroup& group_;
  const GroupStep& step_;
  std::vector<ContactStep> motions_;
};

}  // namespace careen
