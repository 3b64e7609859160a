#include "physics/exact/bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "core/names.h"
#include "physics/contact/island.h"
#include "physics/exact/changing_world.h"
#include "physics/exact/next_contact.h"
#include "physics/motion/hermite_step.h"

namespace careen {
namespace {

std::vector<double> radiiOf(const World& world) {
  std::vector<double> radii;
  radii.reserve(world.bodies.size());
  for (const Body& body : world.bodies) {
    radii.push_back(radiusOf(body));
  }
  return radii;
}

// [s] Of bodies in contact: some times that in which they fall, or move, their own size; a second where
// nothing tells a time.
double longestStepOf(const World& world) {
  constexpr double kSizes = 64;
  double largest = 0;
  for (const Body& body : world.bodies) {
    largest = std::max(largest, isImmovable(body.mass) ? 0 : radiusOf(body));
  }
  const double longest = largest > 0 ? timeScaleOf(world, kSizes * largest) : 1;
  return std::isfinite(longest) ? longest : 1;
}

// [m/s] No point of it is faster.
double fastestPoint(const Body& body, const BodyState& state) {
  return state.velocity.norm() + radiusOf(body) * angularVelocity(body.mass, state).norm();
}

Doubt ofRounding(const Body& body) {
  constexpr double kRounding = std::numeric_limits<double>::epsilon();
  return {.place = kRounding * (body.initial.pose.position.norm() + radiusOf(body)),
          .speed = kRounding * fastestPoint(body, body.initial)};
}

// [m²/s²] What gravity beyond `usual` [m/s²] gives in a flight of so long [s]: ∫ (g − usual)·v, by parts.
double workOfChange(const Flight& flight, const Vec3& usual, double elapsed) {
  if (flight.jerk.isZero(0)) {
    return 0;
  }
  const Vec3 way = flight.positionAt(elapsed) - flight.position;
  const Vec3 area = (elapsed * elapsed) * (0.5 * flight.velocity + (elapsed / 6) * flight.acceleration +
                                           (elapsed * elapsed / 24) * flight.jerk);  // of that way over time
  return dot(flight.accelerationAt(elapsed) - usual, way) - dot(flight.jerk, area);
}

struct Bond {
  int from = 0;           // index of a body on which more than gravity acts
  std::optional<int> to;  // that moves with it
};

// By springs and joints; what is held does not connect those joined to it.
std::vector<Bond> bondsOf(const World& world) {
  std::vector<Bond> bonds;
  const auto add = [&](const std::optional<int>& from, const std::optional<int>& to) {
    if (from) {
      bonds.push_back({.from = *from, .to = to});
    }
  };
  for (const Spring& spring : world.springs) {
    add(spring.from.body, spring.to.body);
    add(spring.to.body, spring.from.body);
  }
  for (const Joint& joint : world.joints) {
    for (const JointEnd* end : {&joint.from, &joint.to}) {
      const bool isHeld = end->body && isImmovable(world.bodies[static_cast<std::size_t>(*end->body)].mass);
      if (!isHeld) {
        add(end->body, end == &joint.from ? joint.to.body : joint.from.body);
      }
    }
  }
  return bonds;
}

// [s] When one that rests may move, as one of its joints lets go or its motor changes.
double changeAtRest(const World& world, const ChangingWorld* changing, const Mover& body) {
  double change = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < world.joints.size() && changing != nullptr && !body.isHeld(); ++j) {
    const Joint& joint = world.joints[j];
    if (joint.from.body == body.listed.value || joint.to.body == body.listed.value) {
      change = std::min(change, changing->nextOf(static_cast<int>(j)));
    }
  }
  return change;
}

// All that move look for what is driven, and a crowd sees to its members.
bool looksFor(const Mover& driven, const Mover& other) {
  if (other.moves() || other.isHeld()) {
    return false;
  }
  const auto isOf = [&](const ContactGroup& group) {
    return std::find(group.ranks().begin(), group.ranks().end(), driven.rank) != group.ranks().end();
  };
  return !other.group || !isOf(*other.group);
}

void takeSooner(std::optional<Event>& first, const std::optional<Event>& candidate) {
  if (candidate && (!first || earlier(candidate->time, first->time))) {
    first = candidate;
  }
}

}  // namespace

DoubtfulBody doubtful(Bodies& bodies, int rank, const Instant& time, const BodyState& after) {
  const Body& body = *bodies[rank].body;
  return {.body = &body, .doubt = bodies.doubtAt(rank, time), .speed = fastestPoint(body, after)};
}

bool endsInWorld(const World& world) {
  return std::any_of(world.joints.begin(), world.joints.end(),
                     [](const Joint& joint) { return !joint.to.body; });
}

Bodies::Bodies(const World& world, const RunSettings& settings, Recorder& recorder,
               const ChangingWorld* changing)
    : world_(world),
      changing_(changing),
      end_(settings.duration),
      tolerance_(settings.tolerance),
      crowds_(settings.crowds),
      team_(std::make_shared<Team>(settings.threads)),
      timeScale_(timeScaleOf(world, settings.tolerance)),
      longestStep_(longestStepOf(world)),
      recorder_(recorder),
      neighbors_(radiiOf(world)),
      queue_(world.bodies.size() + world.walls.size() + 1),
      account_(world),
      forced_(world.bodies.size(), world.drag ? 1 : 0),
      bonds_(world.bodies.size() + world.walls.size() + 1) {
  std::vector<int> rankOf(world.bodies.size());
  double movable = 0;
  for (const std::size_t listed : orderByName(world.bodies)) {
    const int rank = static_cast<int>(movers_.size());
    rankOf[listed] = rank;
    Mover& mover = movers_.emplace_back();
    mover.body = &world.bodies[listed];
    mover.rank = rank;
    mover.listed = {static_cast<int>(listed)};
    if (!mover.isHeld()) {
      ++movable;
      mover.doubt = ofRounding(*mover.body);
    }
    // What is driven may be anywhere.
    neighbors_.insert(
        rank, mover.body->initial.pose.position,
        mover.body->course.empty() ? radiusOf(*mover.body) : std::numeric_limits<double>::infinity());
  }
  for (std::size_t w = 0; w < world.walls.size(); ++w) {
    const int rank = static_cast<int>(movers_.size());
    Mover& mover = movers_.emplace_back();
    mover.body = &bodyOfWalls();
    mover.halfSpace = &world.walls[w];
    mover.rank = rank;
    mover.listed = {static_cast<int>(w)};
  }
  if (endsInWorld(world)) {
    const int rank = static_cast<int>(movers_.size());
    Mover& mover = movers_.emplace_back();
    mover.body = &bodyOfWalls();
    mover.halfSpace = &careen::nowhere();
    mover.rank = rank;
  }
  forced_.resize(movers_.size(), 0);
  const double part = kFew / std::max(1.0, movable);
  isFew_ = movable <= kFew;
  workShare_ = part * std::min(1.0, part) * std::sqrt(std::max(1.0, RunSettings().tolerance / tolerance_));
  for (const auto& [from, to] : bondsOf(world)) {
    const auto rank = static_cast<std::size_t>(rankOf[static_cast<std::size_t>(from)]);
    forced_[rank] = 1;
    if (to) {
      bonds_[rank].push_back(rankOf[static_cast<std::size_t>(*to)]);
    }
  }
}

std::vector<int> Bodies::around(int rank) const {
  std::vector<int> found;
  neighbors_.findCandidates(rank, found);
  return found;
}

std::vector<int> Bodies::mayReach(const Vec3& low, const Vec3& high, const Instant& time,
                                  double length) const {
  const double gained = length * gravityScale(world_);
  const double speed = std::max(0.0, fastestAtZero_ + time.hi * gravityScale(world_)) + 2 * gained;
  // They are filed where they are now, which is on their way.
  const Vec3 way = Vec3::Constant(2 * length * (speed + gained));
  std::vector<int> found;
  neighbors_.findWithin(low - way, high + way, found);
  return found;
}

// ---- Motions.

void Bodies::fly(int rank, const Instant& time, const BodyState& state, const Quat& attitude) {
  Mover& body = (*this)[rank];
  begins(rank, time);
  body.fly(state, attitude, gravityNow(world_, time.hi), gravitySlope(world_));
  recorder_.moves(body.listed, time.hi, body.flight);
  account_.departs(static_cast<std::size_t>(body.listed.value), state);
  noteSpeed(body);
  body.wall = firstWall(body, walls(), foreseen());
  body.crossing = {};
  findCrossing(rank);
}

void Bodies::rest(int rank, const Instant& time, const Pose& pose) {
  (*this)[rank].group.reset();
  sleep(rank, time, pose);
}

void Bodies::stand(int rank, const Instant& from, const Instant& until, const Vec3& position,
                   const Quat& attitude) {
  const double length = secondsBetween(from, until);
  if (length > 0) {
    const StepEnd still{.position = position, .worldFromBody = attitude};
    recorder_.moves((*this)[rank].listed, from.hi, hermiteStep(still, still, length));
  }
}

void Bodies::sleep(int rank, const Instant& time, const Pose& pose) {
  Mover& body = (*this)[rank];
  begins(rank, time);
  body.rest(pose);
  if (!body.isHeld()) {
    body.wall = firstWall(body, walls(), end_);
  }
  recorder_.moves(body.listed, time.hi, Rest{pose});
  account_.departs(static_cast<std::size_t>(body.listed.value), {.pose = pose});
}

void Bodies::step(const std::shared_ptr<ContactGroup>& group, std::size_t place) {
  const int rank = group->ranks()[place];
  begins(rank, group->start());
  (*this)[rank].step(group, place);
  noteSpeed((*this)[rank]);
}

void Bodies::noteSpeed(const Mover& body) {
  const auto note = [&](const Mover& each) {
    const double speed = each.flies() ? each.flight.velocity.norm() : each.bounds.speed;
    fastestAtZero_ = std::max(fastestAtZero_, speed - each.start.hi * gravityScale(world_));
  };
  if (++noted_ > count()) {
    noted_ = 0;
    int moving = 0;
    fastestAtZero_ = -std::numeric_limits<double>::infinity();
    for (const Mover& each : movers_) {
      if (each.moves()) {
        ++moving;
        note(each);
      }
    }
    mostMoving_ = std::max(mostMoving_, moving);
  }
  note(body);
}

void Bodies::begins(int rank, const Instant& time) {
  Mover& body = (*this)[rank];
  const bool again = body.motion > 0 && !earlier(body.start, time);
  body.atOneMoment = again ? body.atOneMoment + 1 : 0;
  if (body.atOneMoment > 2 * kMostAtOneMoment) {
    std::ostringstream text;
    text << "at " << time.hi << " s box " << body.body->name
         << " collides again and again without time passing";
    throw NumericalError(text.str());
  }
  body.start = time;
  ++body.motion;
}

void Bodies::strike(const Instant& time, int rank, int with, const Vec3& point, const ImpactShare& share) {
  const Mover& other = (*this)[with];
  recorder_.strikes({.time = time.hi,
                     .a = (*this)[rank].listed,
                     .b = other.isBox() ? Partner::ofBody(other.listed.value)
                                        : Partner::ofWall(static_cast<std::size_t>(other.listed.value)),
                     .point = point,
                     .normal = share.normal,
                     .approach = share.approach,
                     .impulse = share.impulse,
                     .tangential = share.tangential});
}

void Bodies::arrive(const Mover& body, const Instant& time, const BodyState& state) {
  const double elapsed = body.elapsed(time);
  account_.gives(body.body->mass.mass * workOfChange(body.flight, world_.gravity, elapsed));
  account_.arrives(static_cast<std::size_t>(body.listed.value), state, elapsed,
                   body.flight.accelerationAt(0.5 * elapsed) - world_.gravity);
}

Doubt* Bodies::doubtAt(int rank, const Instant& time) {
  Mover& body = (*this)[rank];
  if (body.isHeld()) {
    return nullptr;
  }
  const double size = radiusOf(*body.body);
  if (body.doubt.at(time) > size) {
    const double before = std::max(0.0, size - body.doubt.place);
    account_.losesPlaces(instantAfter(body.doubt.since, before > 0 ? before / body.doubt.speed : 0).hi);
  }
  body.doubt.goOn(time);
  return &body.doubt;
}

// ---- Prediction of events.

Instant Bodies::foreseen() const {
  return isGravitySloping(world_) ? Instant(world_.gravityChanges.front().time) : end_;
}

void Bodies::predict(int rank) {
  const Mover& body = (*this)[rank];
  if (!body.moves() || !body.isBox()) {
    // Walls that are driven come to it, and a crowd sees to its members.
    std::optional<Event> first = body.group ? std::nullopt : body.wall;
    const double change = changeAtRest(world_, changing_, body);
    if (std::isfinite(change)) {
      takeSooner(first, Event{.time = Instant(change), .kind = EventKind::kTouching, .body = rank});
    }
    if (first) {
      queue_.set(*first);
    } else {
      queue_.clear(rank);
    }
    return;
  }
  if (body.flies() && isForced(rank)) {  // has just begun, and has yet to feel springs and drag
    queue_.set({.time = body.start, .kind = EventKind::kTouching, .body = rank});
    return;
  }
  std::optional<Event> first = body.wall;
  if (body.steps() && body.group->leader() == rank && earlier(body.group->end(), end_)) {
    first = {.time = body.group->end(), .kind = EventKind::kStep, .body = rank};
  }
  if (body.crosses) {
    takeSooner(first, Event{.time = instantAfter(body.start, body.crossing.time),
                            .kind = EventKind::kCrossing,
                            .body = rank});
  }
  for (const int candidate : around(rank)) {
    if (body.isDriven() && !looksFor(body, (*this)[candidate])) {
      continue;
    }
    if (mayTouch(world_, body.listed.value, (*this)[candidate].listed.value)) {
      takeSooner(first, firstMeeting(body, (*this)[candidate], foreseen(), first ? first->time : foreseen()));
    }
  }
  if (first) {
    queue_.set(*first);
  } else {
    queue_.clear(rank);
  }
}

void Bodies::predictAround(int rank) {
  for (const int candidate : around(rank)) {
    if ((*this)[candidate].moves()) {
      predict(candidate);
    }
  }
}

void Bodies::cross(int rank) {
  neighbors_.move(rank, (*this)[rank].crossing.cell);
  findCrossing(rank);
  predict(rank);
}

void Bodies::feelJump(const Instant& time) {
  timeScale_ = timeScaleOf(world_, tolerance_);
  longestStep_ = longestStepOf(world_);
  fastestAtZero_ = -std::numeric_limits<double>::infinity();
  for (Mover& body : movers_) {
    const int rank = body.rank;
    const Course& course = body.course();
    const CoursePart* const part = course.empty() ? nullptr : &partAt(course, time.hi);
    if (part == nullptr || part->from != time.hi) {
      continue;
    }
    if (!body.isBox()) {  // a run knows where it is by its course
      begins(rank, time);
      part->motion.moves() ? body.drive(*part) : body.rest(part->motion.at(0).pose);
      continue;
    }
    if (!part->motion.moves()) {
      rest(rank, time, part->motion.at(0).pose);
      continue;
    }
    begins(rank, time);
    body.drive(*part);
    recorder_.moves(body.listed, time.hi, part->motion);
    noteSpeed(body);
  }
}

void Bodies::file(int rank, const Vec3& position) {
  if (neighbors_.isFiled(rank)) {
    neighbors_.move(rank, neighbors_.cellOf(position));
  }
}

void Bodies::findCrossing(int rank) {
  Mover& body = (*this)[rank];
  body.crosses = neighbors_.isFiled(rank) && count() > 1;
  if (!body.crosses) {
    return;
  }
  const Cell& cell = neighbors_.cell(rank);
  if (body.steps()) {
    body.crossing =
        neighbors_.nextCrossing(body.group->motion(body.place), body.bounds.speed, cell, body.crossing.time);
  } else {
    body.crossing = neighbors_.nextCrossing(body.flight, body.elapsed(foreseen()), cell, body.crossing.time);
  }
}

double Bodies::withinCell(double speed) const {
  if (!(neighbors_.cellEdge() > 0)) {
    return longestStep_;
  }
  const double margin = neighbors_.cellEdge() / 32;
  const double acceleration = 8 * gravityScale(world_);
  // speed t + acceleration t²/2 ≤ margin
  return speed + acceleration > 0
             ? std::min(longestStep_,
                        2 * margin / (speed + std::sqrt(speed * speed + 2 * acceleration * margin)))
             : longestStep_;
}

double Bodies::workLeft(std::span<const int> ranks, const Instant& time) const {
  if (!crowds_.areAllowed()) {
    return std::numeric_limits<double>::infinity();
  }
  double spent = 0;
  double doubt = 0;  // [m]
  int movable = 0;
  for (const int rank : ranks) {
    const Mover& body = (*this)[rank];
    if (!body.isHeld()) {
      ++movable;
      spent += body.work;
      doubt = std::max(doubt, body.doubt.at(time));
    }
  }
  const bool isWorthLess = !isFew_ && movable > 1 && doubt >= crowds_.tolerance;
  const double share = workShare_ * kFew / std::max(kFew, mostMoving_);
  return movable * share * ((isWorthLess ? 0 : kWorkAtOnce) + kWorkPerSecond * time.hi) - spent;
}

double untilChange(const Bodies& bodies, const Joint& joint, const Instant& time) {
  double next = std::numeric_limits<double>::infinity();
  if (bodies.changing() != nullptr) {
    next = bodies.changing()->nextOf(static_cast<int>(&joint - bodies.world().joints.data()));
  }
  return std::isfinite(next) ? secondsBetween(time, Instant(next)) : next;
}

bool isTooMany(const Bodies& bodies, int movable) {
  const CrowdSettings& crowds = bodies.crowds();
  return crowds.areAllowed() &&
         movable > (crowds.when == CrowdSettings::When::kAbove ? crowds.above : Bodies::kFew);
}

}  // namespace careen
