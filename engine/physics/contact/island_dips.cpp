#include <algorithm>
#include <array>
#include <cmath>

#include "physics/contact/island.h"
#include "physics/geometry/separation.h"

// Event functions that fall below zero within a step and are above it at the step's end.

namespace careen {
namespace {

/// [1] of the tolerance: bodies that are deeper than it in each other may go so much deeper in a step.
constexpr double kDeeper = 0x1p-4;
/// [1] of the tolerance: sampled gaps that differ by less are not searched between.
constexpr double kLower = 0x1p-6;
constexpr int kMostSearches = 12;

/// Where a function with one minimum between two times is lowest, to 1/300 of the way: golden sections.
template <class Value>
double lowestBetween(double from, double to, const Value& valueAt) {
  constexpr double kGolden = 0.6180339887498949;
  double left = to - kGolden * (to - from);
  double right = from + kGolden * (to - from);
  double ofLeft = valueAt(left);
  double ofRight = valueAt(right);
  for (int k = 0; k < kMostSearches; ++k) {
    if (ofLeft < ofRight) {
      to = right;
      right = left;
      ofRight = ofLeft;
      left = to - kGolden * (to - from);
      ofLeft = valueAt(left);
    } else {
      from = left;
      left = right;
      ofLeft = ofRight;
      right = from + kGolden * (to - from);
      ofRight = valueAt(right);
    }
  }
  return ofLeft < ofRight ? left : right;
}

}  // namespace

// [m/s] Rate of a corner's gap.
double Island::rateOf(const EventFunction& corner) const {
  const Kinematics& at = system_.kinematics(corner.contact);
  const Vec3 arm = at.pose.worldFromBody * careen::corner(*bodies()[corner.contact].body, corner.corner);
  return dot(world_.walls[static_cast<std::size_t>(corner.wall)].normal,
             at.velocity + at.angularVelocity.cross(arm));
}

// Time within the step of a possible penetration that is gone at its end; else 0.
double Island::lowestWithin(double h, std::size_t event, double atEnd) {
  if (!(atEnd >= 0)) {
    return 0;
  }
  switch (eventFunctions_[event].kind) {
    case EventFunction::Kind::kCorner:
      return atStart_[event] >= 0 ? lowestOfCorner(h, event, atEnd) : 0;
    case EventFunction::Kind::kOverlap:
      return dipOf(h, event);
    default:
      return 0;
  }
}

// Time of the minimum of the cubic through the corner's gap and rate at both ends, if the minimum is below
// zero.
double Island::lowestOfCorner(double h, std::size_t event, double atEnd) const {
  const double from = h * eventFunctions_[event].rate;
  const double to = h * rateOf(eventFunctions_[event]);
  const double rise = atEnd - atStart_[event];
  const double b = 3 * rise - 2 * from - to;  // gap = start + from s + b s² + c s³
  const double c = from + to - 2 * rise;
  const double squared = b * b - 3 * from * c;
  if (!(squared > 0)) {
    return 0;
  }
  const double root = std::sqrt(squared);
  const double above = b > 0 ? -from : root - b;
  const double below = b > 0 ? b + root : 3 * c;
  if (!(above > 0 && above < below)) {
    return 0;
  }
  const double s = above / below;
  return atStart_[event] + s * (from + s * (b + s * c)) < 0 ? s * h : 0;
}

// The first of a few sampled times at which the penetration exceeds the tolerance, or what there was of it at
// the start: no step, however short, would be without that. Around a lowest sample it is searched more
// closely: an edge that passes below an edge may do so between two of them.
double Island::deepWithin(double h, const EventFunction& event) const {
  constexpr int kMoments = 16;
  const ContactFeature& feature = system_.features()[event.contact];
  const auto a = static_cast<std::size_t>(feature.a);
  const auto b = static_cast<std::size_t>(feature.b.body());
  const Motion ofA = bodies()[a].isHeld() ? Motion(Rest{system_.kinematics(a).pose}) : motion(a, h);
  const Motion ofB = bodies()[b].isHeld() ? Motion(Rest{system_.kinematics(b).pose}) : motion(b, h);
  const auto gapAt = [&](double time) {
    const Pose poseA = stateAt(ofA, bodies()[a].body->mass, time).pose;
    const Pose poseB = stateAt(ofB, bodies()[b].body->mass, time).pose;
    return BoxAxes(boxAt(poseA, *bodies()[a].body), boxAt(poseB, *bodies()[b].body)).gap();
  };
  std::array<double, kMoments + 1> gaps{};
  const auto deep = [&] { return std::min(-tolerance_, gaps[0] - kDeeper * tolerance_); };
  for (std::size_t k = 0; k <= kMoments; ++k) {
    const double time = h * static_cast<double>(k) / kMoments;
    gaps[k] = gapAt(time);
    if (k > 0 && k < kMoments && gaps[k] < deep()) {
      return time;
    }
  }
  for (std::size_t k = 0; k <= kMoments; ++k) {
    const std::size_t before = k > 0 ? k - 1 : k;
    const std::size_t after = k < kMoments ? k + 1 : k;
    const bool isLowest = gaps[k] <= gaps[before] && gaps[k] <= gaps[after] && gaps[k] < tolerance_ &&
                          gaps[k] < std::max(gaps[before], gaps[after]) - kLower * tolerance_;
    if (isLowest) {
      const double lowest = lowestBetween(h * static_cast<double>(before) / kMoments,
                                          h * static_cast<double>(after) / kMoments, gapAt);
      if (gapAt(lowest) < deep()) {
        return lowest;
      }
    }
  }
  return 0;
}

// deepWithin() of the last motion, looked for once.
double Island::dipOf(double h, std::size_t event) {
  dips_.resize(eventFunctions_.size());
  auto& [moves, dip] = dips_[event];
  if (moves != moves_) {
    moves = moves_;
    dip = deepWithin(h, eventFunctions_[event]);
  }
  return dip;
}

bool Island::dips(double h) {
  for (std::size_t event = 0; event < eventFunctions_.size(); ++event) {
    if (eventFunctions_[event].kind == EventFunction::Kind::kOverlap && dipOf(h, event) > 0) {
      return true;
    }
  }
  return false;
}

}  // namespace careen
