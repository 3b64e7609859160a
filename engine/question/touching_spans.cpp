#include "question/touching_spans.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "audit/audit.h"
#include "audit/overlap.h"
#include "audit/promises.h"
#include "audit/samples.h"
#include "question/pieces.h"

namespace careen {
namespace {

constexpr double kSameMoment = 1e-12;        // [1] of the run: rounding
constexpr double kUnseenGap = 1e-3;          // [1] of the gap
constexpr double kSettledWay = 1.0 / 64;     // [1] of half the smaller diagonal
constexpr double kSmallestRounding = 1e-15;  // [1] of the gap: what is at it touches

// The two, in the part of the run that Pieces are at.
class Pair {
 public:
  Pair(const Trajectory& run, std::size_t body, Partner with, double until)
      : pieces_(run, bodiesOf(body, with), until),
        wall_(with.isWall() ? &run.world.walls.at(with.wall()) : nullptr) {}

  Pieces& pieces() { return pieces_; }
  double gapAt(double time) const;
  /// The second derivative is that of a corner over a wall, infinite of two boxes.
  RateBounds bounds() const;
  double size() const;  // [m] half the smaller diagonal
  /// [m] The gap is not less all the time.
  double leastGap(const RateBounds& bounds) const;

 private:
  static std::vector<std::size_t> bodiesOf(std::size_t body, Partner with) {
    return with.isWall() ? std::vector{body} : std::vector{body, static_cast<std::size_t>(with.body())};
  }
  RateBounds boundsFromWall() const;
  RateBounds boundsFromDriven() const;

  Pieces pieces_;
  const Wall* wall_;
};

double Pair::gapAt(double time) const {
  const MovingBody& own = pieces_[0];
  const Pose pose = own.at(time).pose;
  return wall_ != nullptr ? separationOf(*own.body, pose, planeAt(*wall_, time))
                          : separationOf(*own.body, pose, *pieces_[1].body, pieces_[1].at(time).pose);
}

double Pair::size() const {
  const double own = pieces_[0].body->halfExtents.norm();
  return wall_ != nullptr ? own : std::min(own, pieces_[1].body->halfExtents.norm());
}

// Each corner's distance has these. The least of them is so fast at most.
RateBounds Pair::boundsFromWall() const {
  const MovingBody& box = pieces_[0];
  const MotionBounds bounds = box.boundsWithin(pieces_.from(), pieces_.to());
  RateBounds gap = boundsAlong(box.segment.motion, wall_->normal, pieces_.from() - box.segment.start,
                               pieces_.to() - box.segment.start);
  const double radius = radiusOf(*box.body);
  gap.rate += bounds.spin * radius;
  gap.bend += (bounds.angularVelocity.rate + bounds.spin * bounds.spin) * radius;
  return gap;
}

// Likewise: n·(Δ + r), where n turns with the wall and Δ leads from its origin. The parts of its course have
// different speeds.
RateBounds Pair::boundsFromDriven() const {
  const MovingBody& box = pieces_[0];
  const MotionBounds bounds = box.boundsWithin(pieces_.from(), pieces_.to());
  const double radius = radiusOf(*box.body);
  MotionRates wall;
  int parts = 0;
  for (std::size_t k = 0; k < wall_->course.size(); ++k) {
    const bool isOver = k + 1 < wall_->course.size() && wall_->course[k + 1].from <= pieces_.from();
    if (!isOver && wall_->course[k].from < pieces_.to()) {
      const MotionRates rates = boundsOf(wall_->course[k].motion);
      wall.speed = std::max(wall.speed, rates.speed);
      wall.acceleration = std::max(wall.acceleration, rates.acceleration);
      wall.angularSpeed = std::max(wall.angularSpeed, rates.angularSpeed);
      wall.angularAcceleration = std::max(wall.angularAcceleration, rates.angularAcceleration);
      ++parts;
    }
  }
  const double speed = bounds.place.rate + wall.speed;
  const double distance =
      (box.at(pieces_.from()).pose.position - wallMotion(*wall_, pieces_.from()).pose.position).norm() +
      (pieces_.to() - pieces_.from()) * speed;
  const double spin = bounds.spin + wall.angularSpeed;
  const double turning = wall.angularSpeed * wall.angularSpeed + wall.angularAcceleration;
  return {.rate = speed + wall.angularSpeed * distance + spin * radius,
          .bend = parts > 1 ? std::numeric_limits<double>::infinity()
                            : bounds.place.bend + wall.acceleration + 2 * wall.angularSpeed * speed +
                                  turning * distance +
                                  (spin * spin + bounds.angularVelocity.rate + turning) * radius};
}

// The gap of boxes changes no faster than their points move towards each other. That of separating axes is
// not larger, and 0 where it is.
RateBounds Pair::bounds() const {
  if (wall_ != nullptr) {
    return wall_->course.empty() ? boundsFromWall() : boundsFromDriven();
  }
  double speed = 0;
  double turning = 0;
  for (const std::size_t which : {0, 1}) {
    const MovingBody& box = pieces_[which];
    const MotionBounds bounds = box.boundsWithin(pieces_.from(), pieces_.to());
    speed += bounds.place.rate;
    turning += bounds.spin * radiusOf(*box.body);
  }
  const Flight* const a = std::get_if<Flight>(&pieces_[0].segment.motion);
  const Flight* const b = std::get_if<Flight>(&pieces_[1].segment.motion);
  if (a != nullptr && b != nullptr) {
    // What both do alike brings them no nearer.
    const auto apart = [&](double time) {
      return (a->velocityAt(time - pieces_[0].segment.start) - b->velocityAt(time - pieces_[1].segment.start))
          .norm();
    };
    const double width = pieces_.to() - pieces_.from();
    speed = (1 + kSameMoment) * (std::max(apart(pieces_.from()), apart(pieces_.to())) +
                                 0.125 * width * width * (a->jerk - b->jerk).norm());
  }
  return {.rate = speed + turning, .bend = std::numeric_limits<double>::infinity()};
}

// That of balls around them, from their distance at both ends, or in the middle.
double Pair::leastGap(const RateBounds& bounds) const {
  const double width = pieces_.to() - pieces_.from();
  const auto centerOf = [&](const MovingBody& each, double time) {
    return centerAt(each.segment.motion, time - each.segment.start);
  };
  const MovingBody& box = pieces_[0];
  if (wall_ != nullptr) {
    const auto above = [&](double time) {
      const WallPlane plane = planeAt(*wall_, time);
      return plane.normal.dot(centerOf(box, time)) - plane.offset;
    };
    const double nearer = std::min(above(pieces_.from()), above(pieces_.to()));
    return nearer - radiusOf(*box.body) - bounds.bend * width * width / 8;
  }
  const double time = pieces_.from() + 0.5 * width;
  return (centerOf(box, time) - centerOf(pieces_[1], time)).norm() - radiusOf(*box.body) -
         radiusOf(*pieces_[1].body) - 0.5 * bounds.rate * width;
}

// [s] Of impacts of the two until then.
std::vector<double> impactTimes(const Trajectory& run, std::size_t body, Partner with, double until) {
  const Partner self = Partner::ofBody(static_cast<int>(body));
  std::vector<double> times;
  for (const Impact& impact : run.impacts) {
    const Partner a = Partner::ofBody(impact.a.value);
    const bool isOurs = (a == self && impact.b == with) || (a == with && impact.b == self);
    if (isOurs && impact.time <= until && (times.empty() || times.back() < impact.time)) {
      times.push_back(impact.time);
    }
  }
  return times;
}

// A span that holds an impact begins at the first, if that ends the part of the run in which the two came
// near; an impact outside all of them is one of its own. `ends` [s] are those of all parts.
std::vector<TrueSpan> withImpacts(const std::vector<TrueSpan>& spans, const std::vector<double>& impacts,
                                  const std::vector<double>& ends) {
  std::vector<TrueSpan> all;
  std::size_t next = 0;
  for (TrueSpan span : spans) {
    for (; next < impacts.size() && impacts[next] < span.from; ++next) {
      all.push_back({.from = impacts[next], .to = impacts[next]});
    }
    const double partEnd = *std::upper_bound(ends.begin(), ends.end() - 1, span.from);
    if (next < impacts.size() && impacts[next] <= std::min(span.to, partEnd) && span.from > 0) {
      span.from = impacts[next];
    }
    while (next < impacts.size() && impacts[next] <= span.to) {
      ++next;
    }
    all.push_back(span);
  }
  for (; next < impacts.size(); ++next) {
    all.push_back({.from = impacts[next], .to = impacts[next]});
  }
  return all;
}

// [s] When one of them is first in a crowd.
double crowdFrom(const Trajectory& run, std::size_t body, Partner with) {
  const auto first = [&](std::size_t which) {
    const Segments& segments = run.tracks.at(which).segments;
    const auto found = std::find_if(segments.begin(), segments.end(), [](const Segment& segment) {
      return std::holds_alternative<CrowdStep>(segment.motion);
    });
    return found == segments.end() ? std::numeric_limits<double>::infinity() : (*found).start;
  };
  return with.isWall() ? first(body) : std::min(first(body), first(static_cast<std::size_t>(with.body())));
}

}  // namespace

TouchingGaps touchingGaps(const Trajectory& run) {
  if (run.given) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Body& body : run.world.bodies) {
      smallest = isImmovable(body.mass) ? smallest : std::min(smallest, body.halfExtents.norm());
    }
    const double gap = std::isfinite(smallest) ? AuditLimits().table * smallest : 0;
    return {.usual = gap, .crowd = gap};
  }
  RunSettings settings = run.settings;
  settings.method = Method();  // exact
  return {.usual = promisedDepth(settings, false).value(), .crowd = promisedDepth(settings, true).value()};
}

std::vector<TrueSpan> touchingSpans(const Trajectory& run, std::size_t body, Partner with, double until) {
  if (!with.isWall() && !mayTouch(run.world, static_cast<int>(body), with.body())) {
    return {};
  }
  const TouchingGaps gaps = touchingGaps(run);
  const double inCrowd = crowdFrom(run, body, with);
  Pair pair(run, body, with, until);
  TrueSpans spans;
  std::vector<double> ends;
  while (pair.pieces().next()) {
    const double near = pair.pieces().from() >= inCrowd ? gaps.crowd : gaps.usual;
    const RateBounds bounds = pair.bounds();
    SmoothPart part{.from = pair.pieces().from(),
                    .to = pair.pieces().to(),
                    .bounds = {.rate = bounds.rate, .bend = std::numeric_limits<double>::infinity()}};
    part.lift = bounds.bend;
    part.rounding = kSmallestRounding * near;
    part.unseen = kUnseenGap * near;
    part.size = pair.size();
    part.settled = kSettledWay * pair.size() / part.bounds.rate;
    if (const double gap = pair.leastGap(bounds); gap > near + kSameMoment * std::fabs(gap)) {
      part.bounds = {};
      spans.look(part, [&](double) { return near - gap; });
    } else {
      spans.look(part, [&](double time) { return near - pair.gapAt(time); });
    }
    ends.push_back(part.to);
  }
  return ends.empty() ? std::vector<TrueSpan>()
                      : withImpacts(spans.finish(until, kSameMoment * until),
                                    impactTimes(run, body, with, until), ends);
}

}  // namespace careen
