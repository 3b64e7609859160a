#include "physics/pile/crowd.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/pile/crowd_motion.h"

namespace careen {
namespace {

constexpr std::int64_t kStepsPerSorting = 16;
// Lengths of steps, at the usual tolerance.
constexpr double kShortestStep = 1.0 / 720;  // [s]
constexpr double kShortestTurn = 0x1p-4;     // [1] of it: for boxes that spin fast
constexpr double kMostMoved =
    0x1p-3;  // [1] of the smallest size, motion per step: faster bodies take shorter steps
// [1] Times as many sweeps as usual, the longer a jam lasts, at the most.
constexpr std::int64_t kMostEffort = 32;
constexpr int kMostHalvings = 6;
constexpr double kShortest = 0x1p-10;  // [1] of the length that the crowd would take: not halved
// [1] of the tolerance: deeper new penetration makes a step be halved at once; and what is too much to be
// left.
constexpr double kMostMended = 8;
constexpr double kTooDeep = 1.5;
// [1] of the tolerance: how far corners may leave their tangents in a step, at the least. The second order of
// gaps undoes it at its end and in its middle. Less after steps that had to be taken again, as they have to
// be more often the more members there are.
constexpr double kLeastBent = 2;
constexpr double kJoinedBend = 3;  // [1] times as much where it opens a joint, by a quarter of it
constexpr double kLessBent = 0.85;
constexpr double kMoreBent = 1.04;

// As it moves where members are, relative to the size of the smallest of them.
void addWall(const CrowdMembers& members, const PileBody& wall, double& fastest, double& bending) {
  if (!wall.isDriven()) {
    return;
  }
  const MotionRates rates = boundsOf(wall.drivenBy->motion);
  double farthest = 0;
  double speed = 0;
  double smallest = wall.length;
  for (const PileBody& body : members.bodies) {
    if (body.isBox() && !body.absent && !body.held()) {
      farthest = std::max(farthest, (body.position - wall.position).norm());
      speed = std::max(speed, (body.velocity - wall.velocity).norm());
      smallest = std::min(smallest, body.length);
    }
  }
  fastest = std::max(fastest, (wall.velocity.norm() + farthest * wall.omega.norm()) / smallest);
  const double turning = rates.angularSpeed * rates.angularSpeed + rates.angularAcceleration;
  bending = std::max(bending, rates.acceleration + farthest * turning + 2 * rates.angularSpeed * speed);
}

}  // namespace

Crowd::Crowd(const World& world, double tolerance, std::shared_ptr<Team> team, double time)
    : members_(world, tolerance, std::move(team), time),
      loads_(members_, memory_),
      contacts_(members_),
      articulations_(members_),
      impulses_(members_, loads_, contacts_, articulations_, memory_),
      bounces_(members_, loads_, contacts_, articulations_, memory_),
      depth_(members_, contacts_),
      apart_(members_, contacts_, articulations_, depth_, memory_),
      sleep_(members_, loads_, contacts_, articulations_, memory_),
      path_(members_, loads_, contacts_),
      seams_(members_, contacts_, memory_) {
  memory_.length = members_.h;
}

// ---- Members.

std::size_t Crowd::admit(std::size_t body, const BodyState& state, const Quat& attitude, double past,
                         const CoursePart* part) {
  PileBody added = pileBody(members_.world.bodies[body], state);
  added.attitude = attitude;
  if (part != nullptr) {
    added.drivenBy = part;
    added.velocity = state.velocity;
    added.omega = state.angularMomentum;
  }
  atRest_ = atRest_ && added.stays();
  const std::size_t index = place(added, body);
  memory_.places[index].past = past;
  return index;
}

std::size_t Crowd::admitAtRest(std::size_t body, const Pose& pose, std::optional<std::size_t> cluster) {
  PileBody added = pileBody(members_.world.bodies[body], {.pose = pose});
  added.asleep = !added.held();
  const std::size_t index = place(added, body);
  members_[index].cluster = static_cast<int>(cluster.value_or(index));
  return index;
}

std::size_t Crowd::place(const PileBody& body, std::size_t listed) {
  const std::size_t index = members_.add(body, listed);
  memory_.places.resize(members_.size());
  memory_.places[index] = {.rates = {.velocity = body.velocity, .omega = body.omega}};
  loads_.limitBySprings(listed);
  return index;
}

void Crowd::dismiss(std::size_t place) {
  contacts_.clearPlace(place);
  members_.remove(place);
}

Crowd::Figures Crowd::figures() const {
  Figures figures = figures_;
  figures.rows = impulses_.rows();
  figures.projections = apart_.passes();
  return figures;
}

BodyState Crowd::stateAtVelocity(std::size_t place) const {
  BodyState state = stateOf(members_[place]);
  state.pose.position -= members_[place].behind * state.velocity;
  return state;
}

BodyState Crowd::stateAtEnd(std::size_t place) const {
  BodyState state = stateOf(members_[place]);
  state.velocity += loads_.halfKick(place);
  state.angularMomentum += members_[place].behind * loads_.torque(place);
  return state;
}

double Crowd::fastest() const {
  double fastest = 0;
  for (const PileBody& body : members_.bodies) {
    fastest = body.stays() ? fastest : std::max(fastest, body.velocity.norm());
  }
  return fastest;
}

double Crowd::penetration() const {
  double deepest = 0;
  for (const PilePair& pair : contacts_.pairs()) {
    deepest = std::max(deepest, depth_.overlap(pair));
  }
  return deepest;
}

// ---- A step.

double Crowd::step(double most, double time) {
  members_.time = time;
  if (++figures_.steps % kStepsPerSorting == 0) {
    contacts_.sort();
  }
  seams_.remember();
  memory_.loads = loads_.ofStep();
  memory_.length = members_.h;
  members_.begin();
  chosen_ = chooseLength();
  take(std::min(chosen_, most), Shifts::kMay);
  return keepApart();
}

// [s] What the fastest body requires, relative to its size, and the one that turns fastest: its corners leave
// their tangents by r ω² h²/2.
double Crowd::chooseLength() const {
  const double longest = members_.longestStep();
  double fastest = 0;
  double bending = 0;  // [m/s²]
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const PileBody& body = members_[i];
    if (!body.isBox()) {
      addWall(members_, body, fastest, bending);
    } else if (!body.stays()) {
      const double times = articulations_.isJoined(static_cast<int>(i)) ? kJoinedBend : 1;
      fastest = std::max(fastest, (body.velocity.norm() + longest * members_.gravity) / body.length);
      bending = std::max(bending, times * body.radius * body.omega.squaredNorm());
      if (body.isDriven()) {
        const MotionRates rates = boundsOf(body.drivenBy->motion);
        bending = std::max(bending, rates.acceleration + body.radius * rates.angularAcceleration);
      }
    }
  }
  double h = longest;
  if (h * fastest > kMostMoved * members_.scale) {
    h = std::min(h, kMostMoved * members_.scale / fastest);
  }
  h = std::max(h, kShortestStep * members_.scale);
  if (h * h * bending > 2 * memory_.bent * members_.tolerance) {
    const double straight = std::sqrt(2 * memory_.bent * members_.tolerance / bending);
    h = std::min(h, std::max(straight, kShortestTurn * kShortestStep * members_.scale));
  }
  return std::min(h, loads_.longestStep());
}

// Members and what acts on them → who wakes → contacts → impulses → motion, and bounces → apart → who sleeps.
void Crowd::take(double length, Shifts shifts) {
  members_.h = length;
  members_.span = 0.5 * (memory_.length + length);
  members_.drive();
  loads_.find();
  sleep_.wakeDisturbed();
  do {
    contacts_.begin();
    do {
      contacts_.lookAtAll();
    } while (sleep_.wakePushed());
    contacts_.listNear();
    sleep_.forgetWoken();
    impulses_.find();
  } while (sleep_.wakeStruck(impulses_.solver()));
  impulses_.keep();
  sleep_.findDisturbed();
  if (shifts == Shifts::kMay) {
    impulses_.shift(apart_.projection());
  } else {
    impulses_.dontShift();
  }
  bounces_.find();
  moveMembers(members_, loads_, impulses_);
  if (articulations_.close()) {
    contacts_.displaced(articulations_.closedBy());
  }
  bounces_.bounce(impulses_);
  countUntouched(members_, contacts_, memory_);
  apart_.begin();
  if (apart_.projectAll()) {
    atRest_ = sleep_.freeze();
  }
}

// To the start of the step.
void Crowd::goBack() {
  members_.goBack();
  contacts_.rebuildNear();  // they were those of other places
  atRest_ = false;
}

double Crowd::stepAgain(double length) {
  goBack();
  if (length > 0) {
    take(length, Shifts::kMay);
    return keepApart();
  }
  bounces_.clear();
  for (CrowdMembers::Way& way : members_.ways) {
    way.moved = false;
  }
  return 0;
}

// Takes the step again with more sweeps if it gained energy. In a jam, where all that leaves bodies deep, the
// next steps take more sweeps.
double Crowd::keepApart() {
  if (impulses_.gainedEnergy() && memory_.effort < kMostEffort) {
    memory_.effort = std::min(4 * memory_.effort, kMostEffort);
    ++figures_.retaken;
    goBack();
    take(members_.h, Shifts::kMay);
  }
  const double left = pushApart();
  deepest_ = std::max({deepest_, depth_.undone(), left, apart_.left()});
  memory_.effort = left > kTooDeep * members_.tolerance ? std::min(2 * memory_.effort, kMostEffort)
                                                        : std::max<std::int64_t>(memory_.effort / 2, 1);
  isSharp_ = seams_.isSharp();
  return members_.h;
}

// Pushes apart those that went deep into each other in the step, or, where that is too much or fails, takes
// it again with half its length, and then without shifts, which are as long in a shorter one; not without
// end, where the step was cut far below what the crowd would take. Returns how deep [m] any are left.
double Crowd::pushApart() {
  double left = 0;
  int halving = 0;
  for (;; ++halving) {
    const double depth = depth_.find();
    if (depth == 0 || halving == kMostHalvings || members_.h <= kShortest * chosen_) {
      left = depth_.anyIsDeep() ? apart_.projectOnWay() : 0;
      break;
    }
    if (depth <= kMostMended * members_.tolerance && apart_.mend()) {
      break;
    }
    ++figures_.retaken;
    goBack();
    take(0.5 * members_.h, halving == 0 ? Shifts::kMay : Shifts::kMayNot);
  }
  memory_.bent = halving > 0 ? std::max(kLessBent * memory_.bent, kLeastBent)
                             : std::min(kMoreBent * memory_.bent, CrowdMemory::kMostBent);
  return left;
}

}  // namespace careen
