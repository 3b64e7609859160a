#include "physics/solver/contact_solver.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

constexpr double kEnough = 1e-9;           // [1] of V
constexpr double kSmall = 1e-13;           // [1] of V
constexpr double kOfImpulses = 1e-6;       // [1] of the largest λ/mass
constexpr double kGhost = 1e-3;            // [1] of the largest λ/mass
constexpr double kGoal = 0x1p-50;          // [1] of V
constexpr double kFall = 0x1p-7;           // of the gap, until Newton's method is tried again

}  // namespace

bool ContactSolver::isEnough() const {
  double largest = 0;
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    largest = std::max(largest, impulses_[c][0] / contacts_.contacts()[c].mass);
  }
  const double scale = contacts_.scale();
  const double exact = std::min(kEnough * scale, std::max(kSmall * scale, kOfImpulses * largest));
  return residual_ <= std::max({exact, contacts_.noise(), std::min(enough_, kGhost * largest)});
}

/// Takes the trial if it is better than the best. Returns whether the best is enough.
bool ContactSolver::keepIfBetter(double residual) {
  if (residual < residual_) {
    residual_ = residual;
    std::swap(impulses_, trial_);
    std::swap(q_, trialQ_);
  }
  return isEnough();
}

bool ContactSolver::tryNewton(std::span<const Triple> from, const ContactNewton::Options& options) {
  std::copy(from.begin(), from.end(), trial_.begin());
  const double goal = kGoal * contacts_.scale();
  const double residual = newton_.improve(contacts_, trial_, trialQ_, options, goal);
  factorisations_ += newton_.factorisations();
  return keepIfBetter(residual);
}

bool ContactSolver::tryInterior(const InteriorPoint::Options& options, int iterations) {
  interior_.start(contacts_, options);
  double polished = interior_.gap();
  for (int k = 0; k < iterations; ++k) {
    ++factorisations_;
    const bool goesOn = interior_.advance(contacts_);
    if (interior_.gap() < kFall * polished || !goesOn) {
      polished = interior_.gap();
      if (tryNewton(interior_.impulses(), {})) {
        return true;
      }
    }
    if (!goesOn) {
      break;
    }
  }
  return false;
}

void ContactSolver::search() {
  if (tryNewton(impulses_, {.steps = 8, .stickFirst = true})) {
    return;
  }
  if (tryInterior({}, 60)) {
    return;
  }
  for (const double start : {1.0, 1e4, 0.1, 100.0, 0.01, 10.0, 1e6}) {
    if (tryInterior({.start = start, .stride = 0.9, .leastCentering = 0.1, .secondOrder = false}, 150)) {
      return;
    }
  }
}

bool ContactSolver::solve(const ContactProblem& problem, ContactSolution& solution) {
  contacts_.set(problem);
  enough_ = solution.enough;
  const std::size_t count = problem.contacts.size();
  impulses_.assign(count, {});
  trial_.resize(count);
  q_.resize(problem.free.size());
  trialQ_.resize(problem.free.size());
  factorisations_ = 0;
  residual_ = ContactNewton::residual(contacts_, impulses_, q_);
  bool solved = isEnough();
  if (!solved && solution.impulses.size() == count) {
    contacts_.importImpulses(solution.impulses, trial_);
    solved = tryNewton(trial_, {.steps = 8});
  }
  if (!solved) {
    search();
  }
  solution.solved = isEnough();
  solution.residual = residual_;
  solution.scale = contacts_.scale();
  solution.factorisations = factorisations_;
  contacts_.exportImpulses(impulses_, solution.impulses);
  contacts_.exportVelocities(q_, solution.velocities);
  return solution.solved;
}

}  // namespace careen
