#include "question/pieces.h"

#include <algorithm>

#include "audit/samples.h"

namespace careen {

Vec3 MovingBody::middleAt(double time) const {
  return body->boxCenter.isZero() ? centerAt(segment.motion, time - segment.start)
                                  : boxPose(*body, at(time).pose).position;
}

// |d/dt (R b)| ≤ ω |b|, and its rate at most (|dω/dt| + ω²) |b|.
RateBounds MovingBody::middleBounds(const MotionBounds& bounds) const {
  const double arm = body->boxCenter.norm();
  return {.rate = bounds.place.rate + bounds.spin * arm,
          .bend = arm == 0
                      ? bounds.place.bend
                      : bounds.place.bend + (bounds.angularVelocity.rate + bounds.spin * bounds.spin) * arm};
}

Pieces::Pieces(const Trajectory& run, std::span<const std::size_t> bodies, double until) : until_(until) {
  for (const std::size_t body : bodies) {
    places_.push_back({.segments = &run.tracks.at(body).segments});
    bodies_.push_back({.body = &run.world.bodies.at(body), .segment = {}});
    enter(places_.size() - 1, 0);
  }
}

void Pieces::enter(std::size_t which, std::size_t index) {
  Place& place = places_[which];
  place.index = index;
  const bool isLast = index + 1 >= place.segments->size();
  place.end = isLast ? until_ : std::min(until_, (*place.segments)[index + 1].start);
  bodies_[which].segment = (*place.segments)[index];
}

bool Pieces::beginsAtEnd() {
  bool any = false;
  for (std::size_t which = 0; which < places_.size(); ++which) {
    const Segments& segments = *places_[which].segments;
    const std::size_t begun = segments.countUntil(until_);
    if (begun > places_[which].index + 1) {
      enter(which, begun - 1);
      any = true;
    }
  }
  return any;
}

bool Pieces::next() {
  from_ = to_;
  if (from_ >= until_) {
    return beginsAtEnd();
  }
  to_ = until_;
  for (std::size_t which = 0; which < places_.size(); ++which) {
    Place& place = places_[which];
    while (place.end <= from_ && place.index + 1 < place.segments->size()) {
      enter(which, place.index + 1);
    }
    to_ = std::min(to_, std::max(place.end, from_));
  }
  to_ = to_ > from_ ? to_ : until_;
  return true;
}

}  // namespace careen
