// When a step is taken again, and what spares that.
#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/pile/crowd.h"

namespace careen {
namespace {

// [1] Times as many sweeps as usual, the longer a jam lasts, at the most.
constexpr std::int64_t kMostEffort = 32;
constexpr int kMostHalvings = 6;
// [1] of the kinetic energy: if contacts add more to it, the step is taken again with more sweeps.
constexpr double kMostGained = 0x1p-13;
constexpr double kShortest = 0x1p-10;  // [1] of the length that the crowd would take: not halved
// [1] of the tolerance: deeper new penetration makes a step be halved at once; and what is too much to be
// left.
constexpr double kMostMended = 8;
constexpr double kTooDeep = 1.5;
// [1] of the tolerance: how far corners may leave their tangents in a step, at the least. The second order of
// gaps undoes it at its end and in its middle. Less after steps that had to be taken again, as they have to
// be more often the more members there are.
constexpr double kLeastBent = 2;
constexpr double kLessBent = 0.85;
constexpr double kMoreBent = 1.04;

}  // namespace

double Crowd::stepAgain(double length) {
  goBack();
  if (length > 0) {
    take(length);
    return keepApart();
  }
  impacts_.clear();
  for (Before& before : before_) {
    before.moved = false;
  }
  return 0;
}

// Takes the step again with more sweeps if it gained energy. Pushes apart those that went deep into each
// other in it, or, where that is too much or fails, takes it again with half its length, and then without
// shifts, which are as long in a shorter one; returns its length. Not without end, where the step was cut far
// below what the crowd would take. In a jam, where all that leaves bodies deep, the next steps take more
// sweeps.
double Crowd::keepApart() {
  const double shortest = kShortest * chosen_;
  double left = 0;
  if (gainedEnergy() && effort_ < kMostEffort) {
    effort_ = std::min(4 * effort_, kMostEffort);
    ++figures_.retaken;
    goBack();
    take(h_);
  }
  int halving = 0;
  for (;; ++halving) {
    const double depth = newDepth();
    if (depth == 0 || halving == kMostHalvings || h_ <= shortest) {
      const bool any = std::find(isDeep_.begin(), isDeep_.end(), 1) != isDeep_.end();
      left = any ? projectOnWay() : 0;
      break;
    }
    if (depth <= kMostMended * tolerance_ && mend()) {
      break;
    }
    ++figures_.retaken;
    goBack();
    take(0.5 * h_, halving == 0);
  }
  deepest_ = std::max({deepest_, undone_, left, projected_ > 0 ? left_ : 0});
  bent_ = halving > 0 ? std::max(kLessBent * bent_, kLeastBent) : std::min(kMoreBent * bent_, kMostBent);
  effort_ = left > kTooDeep * tolerance_ ? std::min(2 * effort_, kMostEffort)
                                         : std::max<std::int64_t>(effort_ / 2, 1);
  findSharp();
  return h_;
}

// To the start of the step, but for what it woke.
void Crowd::goBack() {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const bool woken = start_[i].asleep && !bodies_[i].asleep;
    const double path = bodies_[i].path;
    const double turned = bodies_[i].turned;
    bodies_[i] = start_[i];
    bodies_[i].path = path;
    bodies_[i].turned = turned;
    if (woken) {
      bodies_[i].asleep = false;
      bodies_[i].cluster = -1;
    }
  }
  for (const int slot : near_) {
    manifolds_[at(slot)].moved = std::numeric_limits<double>::max();  // they were those of other places
  }
  atRest_ = false;
}

// [J] At the velocities of the solver, whose angular momentum the body has.
double Crowd::kineticEnergy(std::size_t place) const {
  const PileBody& body = bodies_[place];
  const int index = static_cast<int>(place);
  return 0.5 * (solver_.velocity(index).squaredNorm() / body.inverseMass +
                dot(solver_.omega(index), body.angularMomentum));
}

// Whether the contacts of the step added too much to the kinetic energy: where Gauss–Seidel stopped too
// early. An exact solution adds none. Under springs and drag the angular momenta before are not those of the
// spins, and it is not looked at.
bool Crowd::gainedEnergy() const {
  double before = 0;
  double after = 0;
  for (const Kinetic& kinetic : kinetic_) {
    before += kinetic.before;
    after += kinetic.after;
  }
  return loads_.empty() && after - before > kMostGained * before;
}

}  // namespace careen
