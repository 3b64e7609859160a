#include "physics/compared/stepped_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/math/falling_bracket.h"
#include "physics/attitude/free_methods.h"
#include "physics/geometry/separation.h"
#include "physics/impact/wall_contacts.h"
#include "physics/world/diagnostics.h"
#include "physics/world/flight_account.h"
#include "physics/world/gap.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"

namespace careen {
namespace {

constexpr std::int64_t kStepsAtOnce = 64;  // steps per call of a method and per recorded segment
constexpr double kSliverStep = 1e-6;       // [1] of dt: a shorter last step is merged with the one before
constexpr double kShortestHop = 0x1p-40;   // [1] of a step
constexpr int kMostRefinements = 200;

/// State of a body between two steps.
struct Flying {
  Vec3 position = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  FreeState<double> rotation;  // of the principal axes

  BodyState state(const MassProperties& mass) const {
    return {.pose = {.position = position,
                     .worldFromBody = mass.worldFromBody(rotation.worldFromBody).toRotationMatrix()},
            .velocity = velocity,
            .angularMomentum = rotation.angularMomentumWorld()};
  }
};

/// Simulation of one body; bodies are independent of each other.
class SteppedBody {
 public:
  SteppedBody(const World& world, int index, const RunSettings& settings, Recorder& recorder,
              FlightAccount& account, std::vector<Impact>& impacts)
      : world_(world),
        body_(world.bodies[static_cast<std::size_t>(index)]),
        index_(index),
        settings_(settings),
        method_(freeMethod(settings.method)),
        recorder_(recorder),
        account_(account),
        impacts_(impacts) {}

  void run(const std::stop_token& stop);

 private:
  void depart();
  void step(double end);
  void takeSteps(std::int64_t count);
  void moveTo(const Flying& next, double time);
  Flying after(double h, std::int64_t count = 1) const;
  double gapOf(const Flying& flying) const;
  double gapRounding() const;
  double contactWithin(double h, double gapAtEnd) const;
  void strike();

  double stepEnd(std::int64_t step) const;
  std::int64_t stepsOutOfReach() const;
  std::string where() const;

  const World& world_;
  const Body& body_;
  int index_;
  const RunSettings& settings_;
  const FreeMethod& method_;
  Recorder& recorder_;
  FlightAccount& account_;
  std::vector<Impact>& impacts_;

  double time_ = 0;
  std::int64_t step_ = 0;  // whole steps completed
  Flying now_;
  double departure_ = 0;  // [s] when the flight began
  std::vector<ImpactContact> contacts_;
  std::vector<ImpactShare> shares_;
};

// The whole method, up to strike().

void SteppedBody::run(const std::stop_token& stop) {
  const BodyState& start = body_.initial;
  const Quat attitude = body_.mass.worldFromPrincipal(Quat(start.pose.worldFromBody).normalized());
  now_ = {start.pose.position, start.velocity, {attitude, attitude.conjugate() * start.angularMomentum}};
  depart();
  account_.parted();
  while (time_ < settings_.duration) {
    if (stop.stop_requested()) {
      throw Interrupted();
    }
    recorder_.reaches((index_ * settings_.duration + time_) / static_cast<double>(world_.bodies.size()));
    if (const std::int64_t count = stepsOutOfReach(); count > 0) {
      takeSteps(count);
    } else {
      step(stepEnd(step_ + 1));
      ++step_;
    }
  }
  account_.arrives(static_cast<std::size_t>(index_), now_.state(body_.mass), time_ - departure_);
}

void SteppedBody::takeSteps(std::int64_t count) {
  const Flying next = after(settings_.dt, count);
  step_ += count;
  moveTo(next, stepEnd(step_));
}

void SteppedBody::step(double end) {
  while (time_ < end) {
    const double h = end - time_;
    const Flying next = after(h);
    const double gap = gapOf(next);
    if (gap >= -gapRounding()) {
      moveTo(next, end);
    } else {
      const double contact = contactWithin(h, gap);
      moveTo(after(contact), time_ + contact);
    }
    if (gap <= gapRounding()) {
      strike();
    }
  }
}

void SteppedBody::strike() {
  const BodyState before = now_.state(body_.mass);
  BodyState after = before;
  contacts_.clear();
  account_.penetrates(addWallContacts(world_, body_, before.pose, 0, 1, contacts_));
  account_.arrives(static_cast<std::size_t>(index_), before, time_ - departure_);
  if (std::any_of(contacts_.begin(), contacts_.end(), [](const ImpactContact& contact) {
        return contact.material.restitution < 1 || contact.material.friction > 0;
      })) {
    account_.mayLose();
  }
  shares_.assign(contacts_.size(), {});
  BodyState still;
  std::vector<ImpactBody> bodies(1 + world_.walls.size(), {.mass = &bodyOfWalls().mass, .state = &still});
  bodies[0] = {.mass = &body_.mass, .state = &after};
  resolveImpact(bodies, contacts_, shares_);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (shares_[k].impulse > 0) {
      impacts_.push_back({.time = time_,
                          .a = {index_},
                          .b = Partner::ofWall(static_cast<std::size_t>(contacts_[k].b) - 1),
                          .point = before.pose.position + contacts_[k].armA,
                          .normal = contacts_[k].normal,
                          .approach = shares_[k].approach,
                          .impulse = shares_[k].impulse,
                          .tangential = shares_[k].tangential});
    }
  }
  now_.velocity = after.velocity;
  now_.rotation.bodyMomentum = now_.rotation.worldFromBody.conjugate() * after.angularMomentum;
  depart();
  account_.parted();
}

void SteppedBody::depart() {
  departure_ = time_;
  account_.departs(static_cast<std::size_t>(index_), now_.state(body_.mass));
}

void SteppedBody::moveTo(const Flying& next, double time) {
  recorder_.moves(
      {index_}, time_,
      SteppedFlight{.method = method_.method,
                    .dt = settings_.dt,
                    .start = {.position = now_.position,
                              .velocity = now_.velocity,
                              .acceleration = world_.gravity,
                              .worldFromBody = body_.mass.worldFromBody(now_.rotation.worldFromBody),
                              .angularMomentum = now_.rotation.angularMomentumWorld()}});
  now_ = next;
  time_ = time;
  const BodyState state = now_.state(body_.mass);
  if (!isFinite(state)) {
    throw NumericalError(where() + "has a state that is not finite; take a smaller dt");
  }
  account_.passes(static_cast<std::size_t>(index_), state);
}

Flying SteppedBody::after(double h, std::int64_t count) const {
  Flying next = now_;
  const double elapsed = h * static_cast<double>(count);
  next.position += (now_.velocity + 0.5 * elapsed * world_.gravity) * elapsed;
  next.velocity += elapsed * world_.gravity;
  method_.steps(body_.mass.inertiaBody, next.rotation, h, count);
  return next;
}

// Adds in another order than gapToPlane: results of the study keep their bits.
double SteppedBody::gapOf(const Flying& flying) const {
  double lowest = std::numeric_limits<double>::infinity();
  const Mat3 columns = body_.mass.worldFromBody(flying.rotation.worldFromBody).toRotationMatrix();
  const Vec3 middle = boxAt({flying.position, columns}, body_).middle();
  for (const Wall& wall : world_.walls) {
    for (const Vec3& corner : body_.partCorners) {
      lowest = std::min(lowest, dot(wall.normal, flying.position + columns * corner) - wall.offset);
    }
    if (!body_.parts.empty()) {
      continue;
    }
    const double reach = dot(body_.halfExtents, (columns.transpose() * wall.normal).cwiseAbs());
    lowest = std::min(lowest, dot(wall.normal, middle) - reach - wall.offset);
  }
  return lowest;
}

double SteppedBody::gapRounding() const {
  return kGapRounding * (now_.position.cwiseAbs().sum() + radiusOf(body_));
}

// Requires a gap positive somewhere in (0, h) and negative at h.
double SteppedBody::contactWithin(double h, double gapAtEnd) const {
  FallingBracket bracket{.high = h, .valueLow = gapOf(now_), .valueHigh = gapAtEnd};
  // After an impact the body separates first.
  for (double part = 0.5; bracket.valueLow <= gapRounding(); part /= 2) {
    if (part < kShortestHop) {
      throw NumericalError(where() + "would have to rest, slide or roll on a wall, which method " +
                           std::string(traitsOf(method_.method).name) +
                           " cannot: end the run before it, or give the pair more restitution");
    }
    const double gap = gapOf(after(part * h));
    if (gap > gapRounding()) {
      bracket.low = part * h;
      bracket.valueLow = gap;
    } else if (gap < 0) {
      bracket.high = part * h;
      bracket.valueHigh = gap;
    }
  }
  double best = bracket.low;
  for (int k = 0; k < kMostRefinements && bracket.width() > std::numeric_limits<double>::epsilon() * h; ++k) {
    const double middle = bracket.next(std::numeric_limits<double>::epsilon() * h);
    const double gap = gapOf(after(middle));
    best = middle;
    if (std::fabs(gap) <= gapRounding() / 8) {
      break;
    }
    bracket.add(middle, gap);
  }
  return best;
}

// By multiplication: a running sum would drift away from the video frames.
double SteppedBody::stepEnd(std::int64_t step) const {
  const double end = static_cast<double>(step) * settings_.dt;
  return end < settings_.duration - kSliverStep * settings_.dt ? end : settings_.duration;
}

// Whole steps in which the bounding sphere reaches no wall.
std::int64_t SteppedBody::stepsOutOfReach() const {
  if (time_ != stepEnd(step_)) {
    return 0;
  }
  const double radius = radiusOf(body_);
  double safe = static_cast<double>(kStepsAtOnce) * settings_.dt;
  for (const Wall& wall : world_.walls) {
    const double room = careen::gap(wall, now_.position) - radius;
    const double speed = dot(wall.normal, now_.velocity);
    const double acceleration = dot(wall.normal, world_.gravity);
    if (room <= 0) {
      return 0;
    }
    // room + speed t + acceleration t²/2 ≥ room − (|speed| + |acceleration| t/2) t while both approach the
    // wall
    const double closing = std::max(0.0, -speed) + 0.5 * std::max(0.0, -acceleration) * safe;
    if (closing > 0) {
      safe = std::min(safe, room / closing);
    }
  }
  const double left = std::floor((settings_.duration - time_) / settings_.dt);
  return static_cast<std::int64_t>(
      std::min({std::floor(safe / settings_.dt), left, static_cast<double>(kStepsAtOnce)}));
}

std::string SteppedBody::where() const {
  std::ostringstream text;
  text << "at " << time_ << " s box " << body_.name << ' ';
  return text.str();
}

}  // namespace

RunFigures runStepped(const World& world, const RunSettings& settings, Recorder& recorder,
                      const std::stop_token& stop) {
  FlightAccount account(world);
  std::vector<Impact> impacts;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    const int index = static_cast<int>(i);
    if (isImmovable(body.mass)) {
      recorder.moves({index}, 0, Rest{body.initial.pose});
    } else {
      SteppedBody(world, index, settings, recorder, account, impacts).run(stop);
    }
  }
  std::stable_sort(impacts.begin(), impacts.end(),
                   [](const Impact& a, const Impact& b) { return a.time < b.time; });
  for (const Impact& impact : impacts) {
    recorder.strikes(impact);
  }
  return account.figures();
}

}  // namespace careen
