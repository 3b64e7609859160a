#pragma once

#include <span>

#include "physics/exact/event_queue.h"
#include "physics/impact/impact_law.h"
#include "physics/world/body.h"

namespace careen {

/// How far two motions of a body have parted that began a rounding apart: so much its place may be off.
/// Between impacts they part at constant speed. An impact turns the change of the body's velocity as the body
/// is turned, by place / radius: so each impact makes them part faster by a factor, as in Sinai's billiards.
/// What impacts damp is left out. Of 36 random scenes whose differences were measured the estimate grew .92
/// times as many e-folds in the median, between half and twice as many in 26. `exact` is worth its cost only
/// while this is small.
struct Doubt {
  double place = 0;  ///< [m]
  double speed = 0;  ///< [m/s] at which they part
  Instant since{};

  double at(const Instant& time) const { return place + speed * secondsBetween(since, time); }
  void goOn(const Instant& time);
  void atLeast(double length);
};

/// A body in an impact, and its doubt; none if it is held.
struct DoubtfulBody {
  const Body* body = nullptr;
  Doubt* doubt = nullptr;
  double speed = 0;   ///< [m/s] of it and its corners after the impact: two motions do not part faster
  double change = 0;  ///< [m/s] of its velocity, in the impact
  Doubt worst = {};   ///< of those that it touches
};

/// A contact of the impact, its bodies as indices of these: both have the larger doubt in it.
void touch(std::span<DoubtfulBody> bodies, const ImpactContact& contact, const ImpactShare& share);
/// After all contacts.
void doubtMore(std::span<DoubtfulBody> bodies);

}  // namespace careen
