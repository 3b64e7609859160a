#include "physics/pile/crowd.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace careen {
namespace {

constexpr std::int64_t kStepsPerSorting = 16;
// Lengths of steps, at the usual tolerance.
constexpr double kShortestStep = 1.0 / 720;  // [s]
constexpr double kShortestTurn = 0x1p-4;     // [1] of it: for boxes that spin fast
constexpr double kMostMoved =
    0x1p-3;  // [1] of the smallest size, motion per step: faster bodies take shorter steps
constexpr double kProjected = 3;  // longest steps between two projections
// Sweeps before the second order of gaps is known, and with it.
constexpr int kFirstSweeps = 5;
constexpr int kSweeps = 7;
constexpr std::int64_t kMostSweeps = 400;
constexpr std::int64_t kFewManifolds = 256;
constexpr double kTell = 0x1p-12;  // [1] of the smallest size, change per step that re-solves neighbours
constexpr double kTellLeast = 0x1p-36;
constexpr std::int64_t kEasy = 4;
constexpr std::int64_t kHard = 8;

// [rad/s] What an angular impulse [N m s] changes.
Vec3 spinBy(const PileBody& body, const Vec3& angularImpulse) {
  const Mat3 axes = body.principalAxes();
  return axes * body.inverseInertiaBody.cwiseProduct(axes.transpose() * angularImpulse);
}

}  // namespace

Crowd::Crowd(const World& world, double tolerance, std::shared_ptr<Team> team)
    : world_(world),
      team_(std::move(team)),
      tolerance_(tolerance),
      scale_(std::sqrt(tolerance / kUsualTolerance)),
      gravityMagnitude_(world.gravity.norm()),
      springLimit_(std::numeric_limits<double>::infinity()),
      h_(longestStep()),
      hBefore_(h_),
      span_(h_),
      pairs_(world.walls, team_),
      solver_(team_),
      projection_(tolerance, team_),
      tell_(kTell) {
  if (!world.springs.empty() || world.drag) {
    for (const Body& body : world.bodies) {
      worldStates_.push_back(body.initial);
    }
  }
}

// ---- Members.

std::size_t Crowd::admit(std::size_t body, const BodyState& state, const Quat& attitude, double past) {
  PileBody added = pileBody(world_.bodies[body], state);
  added.attitude = attitude;
  atRest_ = atRest_ && added.held;
  const std::size_t index = place(added, body);
  past_[index] = past;
  return index;
}

std::size_t Crowd::admitAtRest(std::size_t body, const Pose& pose, std::optional<std::size_t> cluster) {
  PileBody added = pileBody(world_.bodies[body], {.pose = pose});
  added.asleep = !added.held;
  const std::size_t index = place(added, body);
  bodies_[index].cluster = static_cast<int>(cluster.value_or(index));
  return index;
}

std::size_t Crowd::place(const PileBody& body, std::size_t listed) {
  if (free_.empty()) {
    free_.push_back(static_cast<int>(bodies_.size()));
    bodies_.emplace_back();
    listed_.emplace_back();
    before_.emplace_back();
    untouchedSteps_.emplace_back();
    unrest_.emplace_back();
    quietChecks_.emplace_back();
    woken_.emplace_back();
    pairs_.addPlace();
  }
  const std::size_t index = at(free_.back());
  free_.pop_back();
  bodies_[index] = body;
  start_.resize(bodies_.size());
  start_[index] = body;
  before_[index] = {};
  ratesBefore_.resize(bodies_.size());
  ratesBefore_[index] = {.velocity = body.velocity, .omega = body.omega};
  past_.resize(bodies_.size());
  past_[index] = std::numeric_limits<double>::max();
  listed_[index] = listed;
  untouchedSteps_[index] = 0;
  quietChecks_[index] = 0;
  unrest_[index] = std::numeric_limits<double>::max();
  limitBySprings(listed);
  return index;
}

void Crowd::dismiss(std::size_t place) {
  pairs_.clearPlace(static_cast<int>(place));
  bodies_[place] = {};
  bodies_[place].absent = true;
  start_[place] = bodies_[place];
  free_.push_back(static_cast<int>(place));
}

// ---- A step: the whole method, up to freeze().

double Crowd::step(double most) {
  ++figures_.steps;
  if (figures_.steps % kStepsPerSorting == 0) {
    sortManifolds();
  }
  forPlaces([&](std::size_t i) {
    ratesBefore_[i] = before_[i].moved ? meanRates(i) : Rates{bodies_[i].velocity, bodies_[i].omega};
    past_[i] = before_[i].moved ? std::numeric_limits<double>::max() : past_[i];
  });
  forPlaces([&](std::size_t i) { start_[i] = bodies_[i]; });
  loadsBefore_ = loads_;
  hBefore_ = h_;
  chosen_ = chooseLength();
  take(std::min(chosen_, most));
  return keepApart();
}

// Stores manifolds in processing order, for cache locality with thousands of boxes. The storage order does
// not affect results.
void Crowd::sortManifolds() {
  near_.clear();
  for (PilePair& pair : pairs_.pairs()) {
    if (pair.slot >= 0) {
      near_.push_back(std::exchange(pair.slot, static_cast<int>(near_.size())));
    }
  }
  sorted_.resize(near_.size());
  forNear([&](const PileManifold& manifold, std::size_t n) { sorted_[n] = manifold; });
  manifolds_.swap(sorted_);
  unused_.clear();
  pairs_.freed().clear();  // of members that left since the last step: slots of the old order
  near_.clear();
}

// [s] What the fastest body requires, relative to its size, and the one that turns fastest: its corners leave
// their tangents by r ω² h²/2.
double Crowd::chooseLength() const {
  const double longest = longestStep();
  double fastest = 0;
  double bending = 0;  // [m/s²]
  for (const PileBody& body : bodies_) {
    if (!body.still()) {
      fastest = std::max(fastest, (body.velocity.norm() + longest * gravityMagnitude_) / body.length);
      bending = std::max(bending, body.radius * body.omega.squaredNorm());
    }
  }
  double h = longest;
  if (fastest > 0) {
    h = std::min(h, kMostMoved * scale_ / fastest);
  }
  h = std::max(h, kShortestStep * scale_);
  if (bending > 0) {
    const double straight = std::sqrt(2 * bent_ * tolerance_ / bending);
    h = std::min(h, std::max(straight, kShortestTurn * kShortestStep * scale_));
  }
  return std::min(h, springLimit_);
}

void Crowd::take(double length, bool mayShift) {
  projected_ = 0;
  h_ = length;
  span_ = 0.5 * (hBefore_ + length);
  findLoads();
  wakeDisturbed();
  for (bool struck = true; struck; struck = wakeStruck()) {
    lookAround();
    loadSolver();
    solver_.wakeAll();
    solve();
  }
  keepImpulses();
  findDisturbed();
  shifts_ = false;
  if (mayShift) {
    findShifts();
  }
  move();
  bounce();
  noteImpacts();
  countUntouched();
  sinceProjection_ += length;
  if (sinceProjection_ >= kProjected * longestStep()) {
    projectAll();
    sinceProjection_ = 0;
    atRest_ = freeze();
  }
}

// First without the second order of gaps, which is that of the velocities found; then with it. Few contacts
// are solved directly, both times where they are very few; of the others, the change threshold that re-solves
// neighbours adapts to the effort of the last step: coarse during heavy impacts, finer as the crowd comes to
// rest.
void Crowd::solve() {
  const auto manifolds = static_cast<std::int64_t>(solver_.blockCount()) + 1;
  const std::int64_t effort = 1 + kFewManifolds / manifolds;  // few manifolds are allowed more sweeps
  const auto most = [&](int sweeps) {
    return static_cast<int>(effort_ * std::min(sweeps * effort, kMostSweeps));
  };
  const bool found = solver_.rowCount() <= kFewRows && solveDirectly();
  std::int64_t solves = found ? 0 : solver_.solve(most(kFirstSweeps), true);
  const bool curved = curveGaps();
  if ((found && !curved) || solveDirectly()) {
    residuals_.add(direct_.takeResiduals());
    return;
  }
  solves += solver_.solve(most(kSweeps), true);
  figures_.solves += solves;
  residuals_.add(solver_.residuals(speed_));
  if (solves < kEasy * effort * manifolds) {
    tell_ = std::max(tell_ * 0.5, kTellLeast);
  } else if (solves > kHard * effort * manifolds) {
    tell_ = std::min(tell_ * 2, kTell);
  }
}

// Returns a bound of the speed [m/s] of its points, along axes.
double Crowd::loadBody(std::size_t place) {
  const PileBody& body = bodies_[place];
  const int index = static_cast<int>(place);
  solver_.setBody(index, body, tell_ * body.length / h_);
  if (body.still()) {
    return 0;
  }
  solver_.velocity(index) =
      body.velocity + body.behind * accelerationBefore(place) + 0.5 * h_ * acceleration(place);
  solver_.omega(index) = body.omega;
  if (!loads_.empty()) {
    solver_.omega(index) += spinBy(body, body.behind * torqueBefore(place) + 0.5 * h_ * torque(place));
  }
  kinetic_[place] = {.before = kineticEnergy(place)};
  return std::max(solver_.velocity(index).cwiseAbs().maxCoeff(),
                  body.radius * solver_.omega(index).cwiseAbs().maxCoeff());
}

void Crowd::loadSolver() {
  solver_.begin(bodies_.size(), PileSolver::Rows::kSet);
  bounces_.clear();
  kinetic_.assign(bodies_.size(), {});
  speed_ = team_->largest(bodies_.size(), [&](std::size_t first, std::size_t last) {
    double speed = 0;
    for (std::size_t i = first; i < last; ++i) {
      speed = std::max(speed, loadBody(i));
    }
    return speed;
  });
  findPushing();
  rowsOf_.resize(near_.size());
  strike_.resize(near_.size());
  forNear([&](PileManifold& manifold, std::size_t n) {
    rowsOf_[n] = lookForRows(manifold);
    strike_[n] = manifold.strikes ? 1 : 0;
  });
  PileSolver::Extent all;
  for (PileSolver::Extent& each : rowsOf_) {
    const PileSolver::Extent own = std::exchange(each, all);
    all.blocks += own.blocks;
    all.rows += own.rows;
  }
  solver_.reserve(all);
  forNear([&](PileManifold& manifold, std::size_t n) { addRows(manifold, rowsOf_[n]); });
  for (std::size_t n = 0; n < near_.size(); ++n) {
    if (strike_[n] != 0) {
      addBounces(manifolds_[at(near_[n])], near_[n]);
    }
  }
  figures_.rows += static_cast<std::int64_t>(solver_.rowCount());
  solver_.link();
  solver_.warmStart();
}

// The solver's velocities are those of the middle of the step. Bodies without contact impulse follow their
// parabola, the others a straight line.
void Crowd::move() {
  forPlaces([&](std::size_t i) {
    PileBody& body = bodies_[i];
    before_[i].moved = false;
    if (body.still()) {
      return;
    }
    const int index = static_cast<int>(i);
    Before& before = before_[i];
    before = {.position = body.position,
              .attitude = body.attitude,
              .velocity = body.velocity + body.behind * accelerationBefore(i),
              .omega = body.omega,
              .angularMomentum = body.angularMomentum,
              .pushed = solver_.pushed(index),
              .moved = true};
    if (!loads_.empty()) {
      const Vec3 turned = body.behind * torqueBefore(i);
      before.omega += spinBy(body, turned);
      before.angularMomentum += turned;
    }
    body.path += body.ahead;
    body.turned += body.turning;
    body.position += h_ * solver_.velocity(index);
    if (!before.pushed) {
      unrest_[i] = std::numeric_limits<double>::max();
    } else {
      const double turning = body.radius * (solver_.omega(index) - body.omega).norm();
      unrest_[i] = (solver_.velocity(index) - body.velocity).norm() + turning;
      body.path += h_ * unrest_[i];
      body.turned += h_ * turning;
    }
    const bool shifted = shifts_ && solver_.isShifted(index);
    if (shifted) {
      before.pushed = true;
      body.position += solver_.displacement(index);
      body.path += shiftOf(index);
      body.turned += body.radius * solver_.turn(index).norm();
    }
    if (solver_.pushed(index)) {
      takeVelocity(body, index);
      kinetic_[i].after = kineticEnergy(i);
      body.behind = 0.5 * h_;
      turnFree(body, h_);
    } else {
      kinetic_[i].after = kinetic_[i].before;
      body.velocity = solver_.velocity(index) + 0.5 * h_ * acceleration(i);
      turnUnderLoad(body, i);
      body.behind = 0;
    }
    if (shifted) {
      turnBy(body, solver_.turn(index));
    }
    before.endVelocity = body.velocity;
    before.endOmega = body.omega;
  });
}

// By the torque that acts in the middle.
void Crowd::turnUnderLoad(PileBody& body, std::size_t place) const {
  if (loads_.empty()) {
    turnFree(body, h_);
    return;
  }
  turnFree(body, 0.5 * h_);
  body.angularMomentum += body.behind * torqueBefore(place) + h_ * torque(place);
  turnFree(body, 0.5 * h_);
}

// Impulses change L at the attitude at which they were solved.
void Crowd::takeVelocity(PileBody& body, int index) {
  const Mat3 axes = body.principalAxes();
  const Vec3 change = axes.transpose() * (solver_.omega(index) - body.omega);
  body.angularMomentum += axes * body.inertiaBody.cwiseProduct(change);
  body.velocity = solver_.velocity(index);
}

// A member is untouched while no contact point is near it.
void Crowd::countUntouched() {
  forPlaces([&](std::size_t i) { untouchedSteps_[i] = bodies_[i].still() ? 0 : untouchedSteps_[i] + 1; });
  const auto touch = [&](int body) {
    std::atomic_ref(untouchedSteps_[at(body)]).store(0, std::memory_order_relaxed);
  };
  forNear([&](const PileManifold& manifold, std::size_t) {
    touch(manifold.a);
    if (!manifold.b.isWall()) {
      touch(manifold.b.body());
    }
  });
}

}  // namespace careen
