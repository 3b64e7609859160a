#include "physics/pile/crowd_impulses.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "physics/pile/belts.h"
#include "physics/pile/crowd_curvature.h"
#include "physics/pile/crowd_motion.h"

namespace careen {
namespace {

// Sweeps before the second order of gaps is known, and with it.
constexpr int kFirstSweeps = 5;
constexpr int kSweeps = 7;
constexpr std::int64_t kMostSweeps = 400;
constexpr std::int64_t kFewManifolds = 256;
constexpr double kTellLeast = 0x1p-36;
constexpr std::int64_t kEasy = 4;
constexpr std::int64_t kHard = 8;
constexpr double kGrowth = 1.5;  // [1] largest growth of an impulse per step that the warm start accepts
// [1] Times as much, to a longer step: impulses of a much shorter one are those of impacts.
constexpr double kMostScaled = 4;
constexpr double kRounding = 0x1p-30;  // [1] of the fastest speed: slower impacts do not bounce
// Gaps that may close during a step: that part of the smallest size, at the most; so many tolerances and what
// that part of the speeds of both bodies, and of those near them, closes.
constexpr double kAllowance = 0.1;
constexpr double kAllowedDepth = 4;
constexpr double kAllowedSpeed = 0.5;
// Of what the projection tolerates: penetration from which bodies are shifted, what is left of it, so that
// contacts persist, and the change that re-solves neighbours.
constexpr double kShifted = 0.8;
constexpr double kShiftedTo = 0.5;
constexpr double kShiftChange = 0.25;
constexpr int kShiftSweeps = 60;
// Rounds of sweeps and joints, until what the latter change is that part of a tolerance in the step.
constexpr int kMostRounds = 8;
constexpr double kLittle = 0x1p-4;
// [1] of the kinetic energy: if contacts add more to it, the step is taken again with more sweeps.
constexpr double kMostGained = 0x1p-13;

}  // namespace

CrowdImpulses::CrowdImpulses(const CrowdMembers& members, const CrowdLoads& loads, CrowdContacts& contacts,
                             CrowdArticulations& articulations, CrowdMemory& memory)
    : members_(members),
      loads_(loads),
      contacts_(contacts),
      articulations_(articulations),
      memory_(memory),
      solver_(members.team),
      direct_(members, contacts, articulations, memory) {}

void CrowdImpulses::find() {
  load();
  solver_.wakeAll();
  solve();
}

void CrowdImpulses::load() {
  solver_.begin(members_.size(), PileSolver::Rows::kSet);
  kinetic_.assign(members_.size(), 0);
  speed_ = members_.team->largest(members_.size(), [&](std::size_t first, std::size_t last) {
    double speed = 0;
    for (std::size_t i = first; i < last; ++i) {
      speed = std::max(speed, loadBody(i));
    }
    return speed;
  });
  findPushing();
  rowsOf_.resize(contacts_.near().size());
  contacts_.forNear([&](PileManifold& manifold, std::size_t n) { rowsOf_[n] = lookForRows(manifold); });
  PileSolver::Extent all;
  for (PileSolver::Extent& each : rowsOf_) {
    const PileSolver::Extent own = std::exchange(each, all);
    all.blocks += own.blocks;
    all.rows += own.rows;
    all.belts += own.belts;
  }
  solver_.reserve(all);
  isOnBelts_ = all.belts > 0;
  contacts_.forNear([&](PileManifold& manifold, std::size_t n) { addRows(manifold, rowsOf_[n]); });
  rowCount_ += static_cast<std::int64_t>(solver_.rowCount());
  solver_.link();
  articulations_.aimAtEnd(solver_);
  solver_.warmStart();
}

// Returns a bound of the speed [m/s] of its points, along axes.
double CrowdImpulses::loadBody(std::size_t place) {
  const PileBody& body = members_[place];
  const int index = static_cast<int>(place);
  solver_.setBody(index, body, memory_.tell * body.length / members_.h);
  if (body.isDriven()) {
    solver_.velocity(index) = body.velocity;
    solver_.omega(index) = body.omega;
  }
  if (body.still()) {
    return 0;
  }
  solver_.velocity(index) = body.velocity + body.behind * loads_.accelerationBefore(place) +
                            0.5 * members_.h * loads_.acceleration(place);
  solver_.omega(index) = body.omega;
  if (loads_.any()) {
    solver_.omega(index) +=
        spinBy(body, body.behind * loads_.torqueBefore(place) + 0.5 * members_.h * loads_.torque(place));
  }
  kinetic_[place] = kineticEnergy(place);
  return std::max(solver_.velocity(index).cwiseAbs().maxCoeff(),
                  body.radius * solver_.omega(index).cwiseAbs().maxCoeff());
}

// What a body may be struck with in the step: those that strike it are near it.
void CrowdImpulses::findPushing() {
  std::vector<double> own(members_.size());
  members_.forEach([&](std::size_t i) {
    const int index = static_cast<int>(i);
    own[i] = solver_.velocity(index).norm() + members_[i].radius * solver_.omega(index).norm();
  });
  pushing_ = own;
  contacts_.forNear([&](const PileManifold& manifold, std::size_t) {
    const std::size_t a = at(manifold.a);
    const std::size_t b = at(manifold.b);
    if (members_[b].isBox()) {
      raiseTo(pushing_[a], own[b]);
      raiseTo(pushing_[b], own[a]);
    }
  });
}

// [m/s] Slower approach is what forces give in a step, or rounding: no impact.
double CrowdImpulses::slowestBounce(const PileManifold& manifold) const {
  const double strongest =
      std::max(loads_.acceleration(at(manifold.a)).norm(), loads_.acceleration(at(manifold.b)).norm());
  return std::max(kStrikesFrom * strongest * members_.h, kRounding * speed_);
}

// What is to be known of a manifold before its rows are added, and how many there will be. Where a point
// strikes within the step, those of its manifold that are almost closed strike with it.
PileSolver::Extent CrowdImpulses::lookForRows(PileManifold& manifold) const {
  const Vec3 apart = members_.apart(manifold.a, manifold.b);
  const Vec3 vA = solver_.velocity(manifold.a);
  const Vec3 vB = solver_.velocity(manifold.b);
  const double slow = slowestBounce(manifold);
  const double pushing = pushing_[at(manifold.a)] + pushing_[at(manifold.b)];
  const double mayClose = std::min(kAllowance * manifold.length,
                                   kAllowedDepth * members_.tolerance + kAllowedSpeed * members_.h * pushing);
  PileSolver::Extent rows;
  const ContactFrame* begun = nullptr;
  manifold.meets = manifold.strikes = false;
  const bool isOnBelt = careen::isOnBelt(members_, manifold);
  for (int k = 0; k < manifold.count; ++k) {
    PilePoint& point = manifold.points[at(k)];
    const Vec3 relative = vA + solver_.omega(manifold.a).cross(point.world) - vB -
                          solver_.omega(manifold.b).cross(point.world + apart);
    point.speed = dot(manifold.frameOf(k).normal, relative);
    point.curved = 0;
    point.strikes = -point.speed > slow;
    point.row = point.gap + std::min(0.0, point.speed) * members_.h > mayClose ? -1 : 0;
    manifold.meets = manifold.meets || (point.gap + point.speed * members_.h <= 0 && point.strikes);
    if (point.row < 0) {
      point.normalImpulse = point.normalImpulseBefore = 0;
      continue;
    }
    manifold.strikes = manifold.strikes || point.strikes;
    rows.blocks += begun == &manifold.frameOf(k) ? 0 : 1;
    rows.belts += begun == &manifold.frameOf(k) || !isOnBelt ? 0 : 1;
    begun = &manifold.frameOf(k);
    ++rows.rows;
  }
  return rows;
}

void CrowdImpulses::addRows(PileManifold& manifold, PileSolver::Extent next) {
  const Vec3 apart = members_.apart(manifold.a, manifold.b);
  const double together = kTogether * members_.tolerance;
  const double scale = std::min(members_.span / manifold.span, kMostScaled);
  for (int k = 0; k < manifold.count;) {
    const ContactFrame& frame = manifold.frameOf(k);
    const int first = next.rows;
    const PilePoint& onBelt = manifold.points[at(k)];
    for (; k < manifold.count && &manifold.frameOf(k) == &frame; ++k) {
      PilePoint& point = manifold.points[at(k)];
      if (point.row < 0) {
        continue;
      }
      PileSolver::Row row{.arm = point.world};
      row.bound = manifold.meets && point.gap <= together ? 0 : -std::max(0.0, point.gap) / members_.h;
      row.normalImpulse = scale * std::min(point.normalImpulse, kGrowth * point.normalImpulseBefore);
      if (row.normalImpulse > 0) {
        const double part = row.normalImpulse / point.normalImpulse;
        row.tangential1 = part * point.tangential1;
        row.tangential2 = part * point.tangential2;
      }
      point.row = next.rows++;
      solver_.setRow(point.row, row);
    }
    if (next.rows > first) {
      const BeltBlock block =
          isOnBelt(members_, manifold)
              ? bodiesOnBelt(members_, manifold,
                             solver_.setBelt(next.belts++, motionOfBelt(members_, manifold, frame, onBelt)))
              : BeltBlock{.a = manifold.a, .b = manifold.b};
      solver_.setBlock({.blocks = next.blocks++, .rows = first}, next.rows - first, block.a, block.b,
                       manifold.material.friction, frame, apart);
    }
  }
}

// First without the second order of gaps, which is that of the velocities found; then with it. Few contacts
// are solved directly, both times where they are very few; of the others, the change threshold that re-solves
// neighbours adapts to the effort of the last step: coarse during heavy impacts, finer as the crowd comes to
// rest.
void CrowdImpulses::solve() {
  const auto manifolds = static_cast<std::int64_t>(solver_.blockCount()) + 1;
  const std::int64_t effort = 1 + kFewManifolds / manifolds;  // few manifolds are allowed more sweeps
  const auto most = [&](int sweeps) {
    return static_cast<int>(memory_.effort * std::min(sweeps * effort, kMostSweeps));
  };
  const bool found = solver_.rowCount() <= CrowdDirect::kFewRows && solveDirectly();
  std::int64_t solves = found ? 0 : sweep(most(kFirstSweeps));
  articulations_.bend(solver_);
  const bool curved = curveGaps(members_, contacts_, solver_) || articulations_.any();
  if ((found && !curved) || solveDirectly()) {
    residuals_.add(direct_.takeResiduals());
    return;
  }
  solves += sweep(most(kSweeps));
  residuals_.add(solver_.residuals(speed_));
  if (solves < kEasy * effort * manifolds) {
    memory_.tell = std::max(memory_.tell * 0.5, kTellLeast);
  } else if (solves > kHard * effort * manifolds) {
    memory_.tell = std::min(memory_.tell * 2, CrowdMemory::kTell);
  }
}

std::int64_t CrowdImpulses::sweep(int sweeps) {
  std::int64_t solves = solver_.solve(sweeps);
  const double little = kLittle * members_.tolerance / members_.h;
  for (int round = 0; articulations_.any(); ++round) {
    const double change = direct_.solveJoints(solver_);
    if (round == kMostRounds || (round > 0 && change <= little)) {
      break;
    }
    wakeJoined();
    solves += solver_.solve(sweeps);
  }
  return solves;
}

// The rows of what joints push.
void CrowdImpulses::wakeJoined() {
  contacts_.forNear([&](const PileManifold& manifold, std::size_t) {
    const bool isJoined = articulations_.isJoined(manifold.a) || articulations_.isJoined(manifold.b);
    for (int k = 0; isJoined && k < manifold.count; ++k) {
      if (const int row = manifold.points[at(k)].row; row >= 0) {
        solver_.wakeRow(row);
      }
    }
  });
}

void CrowdImpulses::keep() {
  articulations_.keep();
  contacts_.forNear([&](PileManifold& manifold, std::size_t) {
    manifold.span = members_.span;
    for (int k = 0; k < manifold.count; ++k) {
      PilePoint& point = manifold.points[at(k)];
      if (point.row >= 0) {
        point.normalImpulseBefore = point.normalImpulse;
        point.normalImpulse = solver_.normalImpulse(point.row);
        point.tangential1 = solver_.tangential1(point.row);
        point.tangential2 = solver_.tangential2(point.row);
      }
    }
  });
}

void CrowdImpulses::shift(const PileProjection& projection) {
  solver_.beginShifts(members_.h);
  std::atomic<bool> any = false;
  const double before =
      members_.team->largest(contacts_.near().size(), [&](std::size_t first, std::size_t last) {
        double most = 0;
        for (std::size_t n = first; n < last; ++n) {
          const PileManifold& manifold = contacts_[contacts_.near()[n]];
          const double tolerated = projection.tolerated(manifold.length);
          for (int k = 0; k < manifold.count; ++k) {
            const PilePoint& point = manifold.points[at(k)];
            if (point.row < 0) {
              continue;
            }
            const double lacks =
                solver_.addToShiftBound(point.row, -(point.gap + point.curved + kShiftedTo * tolerated));
            if (lacks > (kShifted - kShiftedTo) * tolerated) {
              any = true;
              solver_.wakeRow(point.row);
            }
            most = std::max(most, lacks);
          }
        }
        return most;
      });
  shifts_ = any;
  if (!shifts_) {
    return;
  }
  solver_.shift(kShiftSweeps, kShiftChange * members_.tolerance);
  shifts_ = solver_.mostLacking() <= before;
  if (!shifts_) {
    return;
  }
  contacts_.forNear([&](PileManifold& manifold, std::size_t) {
    manifold.moved += shiftOf(manifold.a) + shiftOf(manifold.b);
  });
}

double CrowdImpulses::shiftOf(int body) const {
  return isShifted(body)
             ? solver_.displacement(body).norm() + members_[body].radius * solver_.turn(body).norm()
             : 0;
}

double CrowdImpulses::kineticEnergy(std::size_t place) const {
  const PileBody& body = members_[place];
  const int index = static_cast<int>(place);
  return 0.5 * (solver_.velocity(index).squaredNorm() / body.inverseMass +
                dot(solver_.omega(index), body.angularMomentum));
}

// An exact solution adds none; surfaces that move do. Under springs and drag the angular momenta before are
// not those of the spins, and it is not looked at.
bool CrowdImpulses::gainedEnergy() const {
  double before = 0;
  double after = 0;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_.ways[i].moved) {
      before += kinetic_[i];
      after += members_.ways[i].kinetic;
    }
  }
  return !loads_.any() && !isOnBelts_ && after - before > kMostGained * before;
}

}  // namespace careen
