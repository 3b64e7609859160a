#include "physics/solver/contact_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "physics/solver/residual_sum.h"
#include "physics/solver/taking_part.h"

namespace careen {
namespace {

// [1] of V
constexpr double kEnough = 1e-9;
constexpr double kSmall = 1e-13;
constexpr double kGoal = 0x1p-50;  // where Newton's method stops
constexpr double kFirstGoal = 0x1p-46;
constexpr double kPolished = 0x1p-43;
// [1] of the largest λ/mass
constexpr double kOfImpulses = 1e-6;
constexpr double kRounding = 0x1p-49;  // of velocities that large impulses give and cancel
/// [m/s] Residuals of which ratios would overflow: of what friction has stopped.
constexpr double kNothing = 0x1p-500;

constexpr double kFall = 0x1p-10;  // of the gap, until Newton's method is tried again
constexpr int kIterations = 60;
/// The interior-point method is stuck after so many strides this short.
constexpr double kShortStride = 0.1;
constexpr double kShortStrideOfConvex = 0x1p-10;  // only rounding errors stop it
constexpr int kShortStrides = 3;
constexpr InteriorPoint::Options kCautious{
    .start = 1, .stride = 0.9, .leastCentering = 0.1, .secondOrder = false};

// [1] ε of the first proximal point
constexpr double kWarmEpsilon = 0x1p-13;
constexpr double kColdEpsilon = 0x1p-7;
constexpr int kFirstSteps = 100;
/// [1] Impulse over V and the least mass to start from: what neither closes nor opens counts as closed, so
/// that rounding does not choose among the answers.
constexpr double kTie = 0x1p-40;
/// [1] ε where everything may stand: a heavy body on light ones needs contacts this much stiffer.
constexpr double kStandingEpsilon = 0x1p-40;
constexpr double kNearlyStands = 0x1p-10;  // [1] of V
constexpr int kStandingSteps = 3;
constexpr double kStickingEpsilon = 0x1p-24;
constexpr int kConvexRounds = 4;
/// [1] Ratio of masses in contact from which a problem is taken for a jam first.
constexpr double kHeavy = 64;
constexpr int kStepsOfRound = 100;  // of a round
constexpr int kMostSets = 20;       // of contacts that push, without friction
/// [1] of the friction, raised step by step; each step may take this part of the factorisations.
constexpr std::array<double, 8> kPartsOfFriction = {0, 0.2, 0.4, 0.6, 0.8, 0.9, 0.96, 1};
constexpr int kPartForRaising = 4;

/// Whether velocities are against all directions of a contact by more than `least` [m/s].
bool isAgainstAll(const ContactProblem::Contact& contact, std::span<const double> q, double least) {
  ContactProblem::Triple u{};
  const std::array<int, 2> sides{contact.a, contact.b};
  for (std::size_t row = 0; row < 3; ++row) {
    u[row] = -contact.target[row];
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t k = 0; sides[side] != ContactProblem::kNobody && k < ContactProblem::kAxes; ++k) {
        u[row] += contact.rows[row][side * ContactProblem::kAxes + k] *
                  q[static_cast<std::size_t>(sides[side]) * ContactProblem::kAxes + k];
      }
    }
  }
  return std::all_of(
      contact.directions.begin(), contact.directions.end(),
      [&](const ContactProblem::Triple& d) { return d[0] * u[0] + (d[1] * u[1] + d[2] * u[2]) < -least; });
}

}  // namespace

bool ContactSolver::isEnough() const {
  const double largest = contacts_.largest(impulses_);
  const double enough = std::min(inScale(kEnough), std::max(inScale(kSmall), kOfImpulses * largest));
  const double rounding = std::max({contacts_.noise(), kRounding * largest, kNothing});
  return residual_ <= std::max(enough, rounding) ||
         ContactNewton::isGood(contacts_, impulses_, residual_, enough_);
}

/// Takes the trial if it is better than the best. Returns whether the best is enough.
bool ContactSolver::keepIfBetter(double residual) {
  factorisations_ += newton_.factorisations();
  if (residual < residual_) {
    residual_ = residual;
    std::swap(impulses_, trial_);
    std::swap(q_, trialQ_);
  }
  return isEnough();
}

bool ContactSolver::tryNewton(std::span<const Triple> from, ContactNewton::Options options) {
  std::copy(from.begin(), from.end(), trial_.begin());
  options.enough = std::max({options.enough, inScale(kGoal), contacts_.noise()});
  options.good = enough_;
  return keepIfBetter(newton_.improve(contacts_, trial_, trialQ_, options));
}

bool ContactSolver::tryApproach(std::span<const Triple> from, ContactNewton::Options options) {
  std::copy(from.begin(), from.end(), trial_.begin());
  options.enough = std::max(options.enough, contacts_.noise());
  options.good = enough_;
  return keepIfBetter(newton_.approach(contacts_, trial_, trialQ_, options));
}

bool ContactSolver::tryInterior(const InteriorPoint::Options& options, int iterations,
                                std::span<const double> slips) {
  interior_.start(contacts_, options, slips);
  const double shortest = slips.empty() ? kShortStride : kShortStrideOfConvex;
  double polished = interior_.gap();
  int slow = 0;
  bool goesOn = true;
  for (int k = 0; k < iterations && goesOn && slow < kShortStrides && mayGoOn(); ++k) {
    ++factorisations_;
    goesOn = interior_.advance(contacts_);
    if (interior_.gap() < kFall * polished || !goesOn) {
      polished = interior_.gap();
      if (tryNewton(interior_.impulses(), {})) {
        return true;
      }
    }
    slow = interior_.lastStride() < shortest ? slow + 1 : 0;
  }
  return false;
}

/// Convex problems, each with the slip that the one before leads to (F. Cadoux 2009). In a jam nearly
/// everything sticks, and already the first is close.
bool ContactSolver::tryConvex() {
  std::vector<double> slips(impulses_.size(), 0.0);
  for (int round = 0; round < kConvexRounds && mayGoOn(); ++round) {
    if (tryInterior({}, kIterations, slips)) {
      return true;
    }
    contacts_.velocities(interior_.impulses(), trialQ_);
    for (std::size_t c = 0; c < slips.size(); ++c) {
      const Triple u = contacts_.relativeVelocity(contacts_.contacts()[c], trialQ_);
      slips[c] = std::sqrt(u[1] * u[1] + u[2] * u[2]);
    }
  }
  return false;
}

/// From no impulses, with every contact closed and sticking in the first step.
bool ContactSolver::trySticking(double epsilon, int steps) {
  std::fill(from_.begin(), from_.end(), Triple{});
  return tryNewton(from_, {.epsilon = epsilon, .steps = steps, .sticking = true});
}

/// Whether nothing moves at any contact, to rounding errors.
bool ContactSolver::stands() const {
  const double still =
      std::max({inScale(kPolished), contacts_.noise(), kRounding * contacts_.largest(impulses_)});
  return residual_ <= still &&
         std::all_of(contacts_.contacts().begin(), contacts_.contacts().end(),
                     [&](const CoupledContacts::Contact& contact) {
                       const Triple u = contacts_.relativeVelocity(contact, q_);
                       return std::max({std::fabs(u[0]), std::fabs(u[1]), std::fabs(u[2])}) <= still;
                     });
}

/// The bodies stand, or the attempt cost two factorisations. First with the ε that lets equal contacts share
/// evenly.
bool ContactSolver::tryStanding() {
  for (const double epsilon : {kStickingEpsilon, kStandingEpsilon}) {
    bool found = trySticking(epsilon, 1);
    if (residual_ <= inScale(kNearlyStands)) {
      std::copy(impulses_.begin(), impulses_.end(), from_.begin());
      found = tryNewton(from_, {.epsilon = epsilon, .steps = kStandingSteps});
    }
    if (found && stands()) {
      return true;
    }
  }
  std::fill(from_.begin(), from_.end(), Triple{});
  forget();
  return false;
}

bool ContactSolver::hasFriction() const {
  return std::any_of(contacts_.contacts().begin(), contacts_.contacts().end(),
                     [](const CoupledContacts::Contact& contact) {
                       return contact.kind == CoupledContacts::Contact::Kind::kCone ||
                              contact.drag != std::array<double, 2>{};
                     });
}

/// Without friction a problem is convex, and Newton's method a search for the contacts that push: those that
/// would pull, or approach, change sides.
bool ContactSolver::trySets() {
  if (trySticking(kStickingEpsilon, kMostSets)) {
    return true;
  }
  std::fill(from_.begin(), from_.end(), Triple{});
  forget();
  return false;
}

/// Back to no impulses.
void ContactSolver::forget() {
  std::fill(impulses_.begin(), impulses_.end(), Triple{});
  residual_ = ContactNewton::residual(contacts_, impulses_, q_);
}

/// From the best iterate. Rounds alternate between two ρ: what is stuck with one often moves with the other.
bool ContactSolver::tryProximal(int rounds) {
  std::copy(impulses_.begin(), impulses_.end(), from_.begin());
  for (int round = 0; round < rounds && mayGoOn(); ++round) {
    const double rho = round % 2 == 0 ? 0x1p-2 : 0x1p-5;
    if (tryApproach(from_, {.rho = rho,
                            .epsilon = 0x1p-10,
                            .steps = kStepsOfRound,
                            .patience = kStepsOfRound,
                            .enough = inScale(kEnough / 8)})) {
      return true;
    }
    std::copy(newton_.lastCentre().begin(), newton_.lastCentre().end(), from_.begin());
  }
  return false;
}

void ContactSolver::solveWithoutPolish(const ContactSolution& solution) {
  forget();
  if (isEnough()) {
    return;
  }
  std::fill(from_.begin(), from_.end(), Triple{});
  if (solution.impulses.size() == impulses_.size()) {
    contacts_.importImpulses(solution.impulses, from_);
  }
  const bool warm = contacts_.largest(from_) > 0;
  if (!warm && (hasFriction() ? enough_ == 0 && tryStanding() : trySets())) {
    return;
  }
  if (!warm) {
    const auto& contacts = contacts_.contacts();
    const double lightest =
        std::min_element(contacts.begin(), contacts.end(), [](const auto& x, const auto& y) {
          return x.mass < y.mass;
        })->mass;
    for (std::size_t c = 0; c < from_.size(); ++c) {
      const auto kind = contacts[c].kind;
      const bool isJoint = kind == ImpulseSet::Kind::kSpace || kind == ImpulseSet::Kind::kInterval;
      from_[c] = {isJoint ? 0 : kTie * inScale(lightest), 0, 0};
    }
  }
  if (tryApproach(from_, {.epsilon = warm ? kWarmEpsilon : kColdEpsilon,
                          .steps = kFirstSteps,
                          .enough = inScale(kFirstGoal)}) ||
      (contacts_.heaviest() > kHeavy ? tryConvex() || tryProximal(2) : tryProximal(2) || tryConvex())) {
    return;
  }
  for (const double start : {1e4, 0.01, 1.0, 100.0, 0.1, 1e6}) {
    InteriorPoint::Options options = kCautious;
    options.start = start;
    options.mostFriction = start == 1e4 ? 0x1p10 : start == 0.01 ? 8 : 0x1p16;
    if (tryInterior(options, 2 * kIterations, {}) || tryProximal(16)) {
      return;
    }
  }
}

/// Where nearly redundant contacts leave the accepted residual far above rounding errors.
void ContactSolver::polish() {
  std::copy(impulses_.begin(), impulses_.end(), from_.begin());
  tryNewton(from_, {.steps = 3});
  if (residual_ > std::max(inScale(kPolished), contacts_.noise())) {
    std::copy(impulses_.begin(), impulses_.end(), from_.begin());
    tryApproach(from_, {.epsilon = 0x1p-16, .steps = 60, .patience = 20, .enough = inScale(kPolished)});
  }
}

ContactResiduals ContactSolver::residuals() const {
  double largest = 0;
  for (const Triple& impulse : impulses_) {
    largest = std::max(
        largest, std::sqrt(impulse[0] * impulse[0] + (impulse[1] * impulse[1] + impulse[2] * impulse[2])));
  }
  ResidualSum sum(contacts_.speed(), largest);
  for (std::size_t c = 0; c < impulses_.size(); ++c) {
    const CoupledContacts::Contact& contact = contacts_.contacts()[c];
    sum.add(contact, impulses_[c], contacts_.relativeVelocity(contact, q_));
  }
  return sum.residuals();
}

/// Where nothing else helps: without friction a problem is convex, and from there on each answer is the start
/// for a little more friction.
bool ContactSolver::raiseFriction(const ContactProblem& problem, ContactSolution& solution,
                                  int mostFactorisations) {
  const ContactResiduals known = residuals_;
  ContactProblem eased = problem;
  ContactSolution raised;
  raised.enough = solution.enough;
  int spent = solution.factorisations;
  for (const double part : kPartsOfFriction) {
    for (std::size_t c = 0; c < problem.contacts.size(); ++c) {
      eased.contacts[c].friction = part > 0 ? part * problem.contacts[c].friction : 0;
    }
    residuals_ = known;
    const bool solved = solveOnce(eased, raised, mostFactorisations / kPartForRaising);
    spent += raised.factorisations;
    if (!solved) {
      solution.factorisations = spent;
      return false;
    }
  }
  solution = raised;
  solution.factorisations = spent;
  return true;
}

bool ContactSolver::solveWithAll(const ContactProblem& problem, ContactSolution& solution,
                                 int mostFactorisations) {
  return solveOnce(problem, solution, mostFactorisations) ||
         (hasFriction() && raiseFriction(problem, solution, mostFactorisations));
}

bool ContactSolver::solve(const ContactProblem& problem, ContactSolution& solution, int mostFactorisations) {
  std::vector<char> takes;
  for (const ContactProblem::Contact& contact : problem.contacts) {
    takes.push_back(contact.directions.empty() ? 1 : 0);
  }
  if (std::find(takes.begin(), takes.end(), 0) == takes.end()) {
    return solveWithAll(problem, solution, mostFactorisations);
  }
  const std::vector<Triple> warm = std::move(solution.impulses);
  ContactProblem part{.inverseMass = problem.inverseMass, .free = problem.free, .contacts = {}};
  int spent = 0;
  const auto solvePart = [&](const std::vector<char>& chosen) {
    part.contacts.clear();
    solution.impulses.clear();
    for (std::size_t c = 0; c < chosen.size(); ++c) {
      if (chosen[c] != 0) {
        part.contacts.push_back(problem.contacts[c]);
        if (warm.size() == chosen.size()) {
          solution.impulses.push_back(warm[c]);
        }
      }
    }
    const bool solved = solveWithAll(part, solution, mostFactorisations);
    spent += solution.factorisations;
    return solved;
  };
  const bool solved = solveWithTakingPart(takes, solvePart, [&](std::size_t c) {
    return isAgainstAll(problem.contacts[c], solution.velocities,
                        std::max({solution.enough, inScale(kEnough), contacts_.noise()}));
  });
  solution.factorisations = spent;
  std::vector<Triple> all(takes.size());
  for (std::size_t c = 0, next = 0; c < takes.size(); ++c) {
    all[c] = takes[c] != 0 ? solution.impulses[next++] : Triple{};
  }
  solution.impulses = std::move(all);
  return solved;
}

bool ContactSolver::solveOnce(const ContactProblem& problem, ContactSolution& solution,
                              int mostFactorisations) {
  contacts_.set(problem);
  enough_ = solution.enough;
  const std::size_t count = problem.contacts.size();
  impulses_.resize(count);
  trial_.resize(count);
  from_.resize(count);
  q_.resize(problem.free.size());
  trialQ_.resize(problem.free.size());
  factorisations_ = 0;
  most_ = mostFactorisations;
  solveWithoutPolish(solution);
  solution.solved = isEnough();
  if (solution.solved && residual_ > enough_) {
    polish();
  }
  solution.residual = residual_;
  solution.scale = contacts_.scale();
  solution.factorisations = factorisations_;
  solution.residuals = residuals();
  if (solution.solved) {
    residuals_.add(solution.residuals);
  }
  contacts_.exportImpulses(impulses_, solution.impulses);
  contacts_.exportVelocities(q_, solution.velocities);
  return solution.solved;
}

}  // namespace careen
