#include "physics/impact/simultaneous_impact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/math/order_free_sum.h"
#include "physics/geometry/contact_frame.h"
#include "physics/impact/applied_impulses.h"
#include "physics/impact/impact_problem.h"
#include "physics/impact/single_impact.h"
#include "physics/solver/contact_solver.h"

namespace careen {
namespace {

using Impulse = ContactProblem::Triple;
using Impulses = std::vector<Impulse>;
constexpr std::size_t kSix = ContactProblem::kAxes;
/// [1] of the contacts' speeds: faster joints do not hold.
constexpr double kJointsMove = 0x1p-30;
/// [1] of the contacts' speeds: a residual with which an impact may go on although the solver aims at less.
constexpr double kTolerable = 0x1p-24;
/// [1] of the restitution that is tried, one after the other, where bodies are wedged.
constexpr std::array<double, 4> kParts{1, 0.5, 0.25, 0.125};
/// Of reflections and projections in turn: it is asked whether they have settled after so many passes, and
/// again after each as many more.
constexpr std::size_t kManyPasses = 32;
/// [1] of the rounding error of approaches: speeds this small are none.
constexpr double kSettled = 64;
/// Until impulses count as impossible.
constexpr int kMostFactorisations = 400;

/// The laws for several contacts, all in terms of impulses from the velocity before.
class Law {
 public:
  Law(ContactProblem problem, std::span<const ImpactContact> contacts, ImpactAccuracy accuracy)
      : problem_(std::move(problem)),
        before_(problem_.free),
        start_(problem_.free),
        contacts_(contacts),
        accuracy_(accuracy) {
    double scale = 0;  // [m/s] Σ|n_k q_k| of a contact: its speeds are rounded by parts of that
    for (const ContactProblem::Contact& contact : problem_.contacts) {
      scale = std::max(scale, sumOfTerms(contact, 0, before_, [](double term) { return std::fabs(term); }) +
                                  std::fabs(contact.target[0]));
    }
    rounding_ = kApproachRounding * scale;
  }

  Impulses resolve() {
    if (!movesJoints()) {
      return resolveHeld();
    }
    const Impulses first = projection(before_, Chosen(contacts_.size(), 0));
    before_ = problem_.free = after(first);
    Impulses all = resolveHeld();
    add(all, 1, first);
    return all;
  }

  double approach(std::size_t contact) const {
    return contacts_[contact].holds ? 0 : -parting(contact, start_);
  }
  ContactResiduals takeResiduals() { return solver_.takeResiduals(); }

 private:
  using Chosen = std::vector<char>;  // of the contacts

  /// Velocities that joints do not allow, as those of a scene's start may be: the joints alone come first.
  bool movesJoints() const {
    const double most = std::max(accuracy_.tolerable, kJointsMove / kApproachRounding * rounding_);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      for (std::size_t row = 0; contacts_[c].holds && row < 3; ++row) {
        if (std::fabs(speed(c, row, before_)) > most) {
          return true;
        }
      }
    }
    return false;
  }

  Impulses resolveHeld() {
    Chosen approaches;
    findApproaching(before_, approaches);
    if (std::none_of(approaches.begin(), approaches.end(), [](char yes) { return yes != 0; })) {
      return Impulses(contacts_.size());
    }
    const bool rough = std::any_of(contacts_.begin(), contacts_.end(),
                                   [](const ImpactContact& c) { return c.material.friction > 0; });
    const bool elastic = std::any_of(contacts_.begin(), contacts_.end(),
                                     [](const ImpactContact& c) { return c.material.restitution > 0; });
    if (rough && !elastic) {
      return solve(problem_);
    }
    Impulses impulses = frictionless();
    return rough ? withFriction(impulses) : impulses;
  }

  /// Each side for itself, since which of both is a must not matter.
  template <class Use>
  static double sumOfTerms(const ContactProblem::Contact& contact, std::size_t row, std::span<const double> q,
                           const Use& use) {
    std::array<double, 2> sums{};
    const std::array<int, 2> sides{contact.a, contact.b};
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t k = 0; sides[side] != ContactProblem::kNobody && k < kSix; ++k) {
        sums[side] +=
            use(contact.rows[row][side * kSix + k] * q[static_cast<std::size_t>(sides[side]) * kSix + k]);
      }
    }
    return sums[0] + sums[1];
  }

  /// n q, t₁ q or t₂ q of a contact [m/s].
  double speed(std::size_t contact, std::size_t row, std::span<const double> q) const {
    return sumOfTerms(problem_.contacts[contact], row, q, [](double term) { return term; });
  }

  /// [m/s] n q, less what is driven there.
  double parting(std::size_t contact, std::span<const double> q) const {
    return speed(contact, 0, q) - problem_.contacts[contact].target[0];
  }

  /// q₀ + M⁻¹ Jᵀλ, from the velocities before.
  std::vector<double> after(const Impulses& impulses) const { return after(impulses, before_); }
  std::vector<double> after(const Impulses& impulses, std::span<const double> from) const {
    using Six = std::array<double, kSix>;
    std::vector<std::vector<Six>> terms(before_.size() / kSix);
    for (std::size_t c = 0; c < impulses.size(); ++c) {
      const ContactProblem::Contact& contact = problem_.contacts[c];
      const auto& [n, t, s] = contact.rows;
      const std::array<int, 2> sides{contact.a, contact.b};
      for (std::size_t side = 0; side < 2; ++side) {
        if (sides[side] == ContactProblem::kNobody) {
          continue;
        }
        Six& term = terms[static_cast<std::size_t>(sides[side])].emplace_back();
        for (std::size_t k = 0; k < kSix; ++k) {
          const std::size_t i = side * kSix + k;
          term[k] = n[i] * impulses[c][0] + (t[i] * impulses[c][1] + s[i] * impulses[c][2]);
        }
      }
    }
    std::vector<double> q(from.begin(), from.end());
    for (std::size_t body = 0; body < terms.size(); ++body) {
      const Six sum = orderFreeSums<kSix>(terms[body]);
      for (std::size_t k = 0; k < kSix; ++k) {
        q[body * kSix + k] += problem_.inverseMass[body * kSix + k] * sum[k];
      }
    }
    return q;
  }

  /// pᵀ M q [J], in no order of the bodies.
  double product(std::span<const double> p, std::span<const double> q) const {
    std::vector<std::array<double, 1>> ofBodies(q.size() / kSix);
    for (std::size_t k = 0; k < q.size(); ++k) {
      ofBodies[k / kSix][0] += p[k] * q[k] / problem_.inverseMass[k];
    }
    return orderFreeSums<1>(ofBodies)[0];
  }

  /// From the solution's impulses, if it has some; they are the best that were found.
  bool trySolve(const ContactProblem& problem, int mostFactorisations, ContactSolution& solution) {
    return solver_.solve(problem, solution, mostFactorisations) ||
           solution.residual <= std::max(kTolerable * solution.scale, accuracy_.tolerable);
  }

  Impulses solve(const ContactProblem& problem) {
    ContactSolution solution;
    if (!trySolve(problem, ContactSolver::kMost, solution) &&
        !trySolve(problem, ContactSolver::kMost, solution)) {
      throw NumericalError("impact: no impulses of its " + std::to_string(problem.contacts.size()) +
                           " contacts were found");
    }
    return solution.impulses;
  }

  void findApproaching(std::span<const double> q, Chosen& approaches) const {
    approaches.clear();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      approaches.push_back(!contacts_[c].holds && parting(c, q) < -rounding_ ? 1 : 0);
    }
  }

  /// Impulses that project q onto the motions in which the chosen contacts do not approach, and joints hold.
  Impulses projection(std::span<const double> q, std::span<const char> chosen) {
    ContactProblem chosenOnly{
        .inverseMass = problem_.inverseMass, .free = {q.begin(), q.end()}, .contacts = {}};
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (chosen[c] != 0 || contacts_[c].holds) {
        chosenOnly.contacts.push_back(problem_.contacts[c]);
        chosenOnly.contacts.back().friction = 0;
      }
    }
    const Impulses found = solve(chosenOnly);
    Impulses all(contacts_.size());
    std::size_t next = 0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      all[c] = chosen[c] != 0 || contacts_[c].holds ? found[next++] : Impulse{};
    }
    return all;
  }

  static void add(Impulses& sum, double factor, const Impulses& impulses) {
    for (std::size_t c = 0; c < sum.size(); ++c) {
      for (std::size_t row = 0; row < 3; ++row) {
        sum[c][row] += factor * impulses[c][row];
      }
    }
  }

  /// Of the contacts; joints hold anyway.
  bool areAll(const Chosen& chosen) const {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (chosen[c] == 0 && !contacts_[c].holds) {
        return false;
      }
    }
    return true;
  }
  bool areNone(const Impulses& impulses) const {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (impulses[c][0] != 0 && !contacts_[c].holds) {
        return false;
      }
    }
    return true;
  }

  /// P: Moreau's projection.
  const Impulses& plastic() {
    if (plastic_.empty()) {
      plastic_ = projection(before_, Chosen(contacts_.size(), 1));
    }
    return plastic_;
  }

  /// Where reflections and projections end that go on at the recent contacts, ever slower: they change q by
  /// impulses of these contacts only, until none of them moves. Nothing if something else happens before.
  std::optional<Impulses> endOf(std::span<const double> q, const Chosen& recent) {
    Impulses last = projection(q, recent);
    const std::vector<double> end = after(last, q);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      const double left = contacts_[c].holds ? 0 : parting(c, end);
      if (left < -kSettled * rounding_ || (recent[c] != 0 && left > kSettled * rounding_)) {
        return std::nullopt;
      }
    }
    return last;
  }

  /// Xₜ: reflections about the contacts with e > t; where none of those approaches, projection onto the
  /// motions in which no other contact does, approaching yet or not: one after the other they would take
  /// thousands of passes. Reflections alone terminate; a mixture may go on for ever, at the same contacts: it
  /// ends with the projection to which that converges. What does not within the cap is ended by it too.
  Impulses reflected(double threshold) {
    Impulses total(contacts_.size());
    std::vector<double> q = before_;
    Chosen approaches;
    Chosen elastic(contacts_.size());
    Chosen others(contacts_.size());
    Chosen recent(contacts_.size());  // that took an impulse since it was last asked
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      others[c] = contacts_[c].material.restitution > threshold || contacts_[c].holds ? 0 : 1;
    }
    const bool isMixture = std::find(others.begin(), others.end(), 1) != others.end();
    const std::size_t cap = 100 + 10 * contacts_.size() * contacts_.size();
    for (std::size_t pass = 0; pass < cap; ++pass) {
      findApproaching(q, approaches);
      if (std::find(approaches.begin(), approaches.end(), 1) == approaches.end()) {
        return total;
      }
      std::transform(approaches.begin(), approaches.end(), others.begin(), elastic.begin(),
                     [](char yes, char other) { return static_cast<char>(yes != 0 && other == 0 ? 1 : 0); });
      if (isMixture && pass > 0 && pass % kManyPasses == 0) {
        if (const std::optional<Impulses> last = endOf(q, recent)) {
          add(total, 1, *last);
          return total;
        }
        recent.assign(contacts_.size(), 0);
      }
      const bool anyElastic = std::find(elastic.begin(), elastic.end(), 1) != elastic.end();
      const Chosen& chosen = anyElastic ? elastic : others;
      const bool isPlastic = pass == 0 && areAll(chosen);
      const Impulses change = isPlastic ? plastic() : projection(q, chosen);
      if (areNone(change)) {
        return total;  // what is left of their approach is rounding
      }
      add(total, anyElastic ? 2 : 1, change);
      for (std::size_t c = 0; c < contacts_.size(); ++c) {
        recent[c] = recent[c] != 0 || (!contacts_[c].holds && change[c][0] > 0) ? 1 : 0;
      }
      q = after(total);
    }
    add(total, 1, projection(q, Chosen(contacts_.size(), 1)));
    return total;
  }

  Impulses frictionless() {
    std::vector<double> levels;  // the distinct e above 0, ascending
    for (const ImpactContact& contact : contacts_) {
      if (contact.material.restitution > 0) {
        levels.push_back(contact.material.restitution);
      }
    }
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    Impulses total(contacts_.size());
    double below = 0;
    for (const double level : levels) {
      add(total, level - below, reflected(below));
      below = level;
    }
    if (below < 1) {
      add(total, 1 - below, plastic());
    }
    return total;
  }

  Impulses withFriction(const Impulses& smooth);
  Impulses shortened(const Impulses& smooth, Impulses rough) const;

  ContactProblem problem_;
  std::vector<double> before_;
  std::vector<double> start_;  // the same, but where joints had to come first
  std::span<const ImpactContact> contacts_;
  ContactSolver solver_;
  ImpactAccuracy accuracy_;
  double rounding_ = 0;  // [m/s]
  Impulses plastic_;     // empty: not yet computed
};

/// The contact problem whose targets are the normal speeds that restitution sets and the slip that it adds. A
/// body wedged between rough sides may not be able to part so fast with any impulses in the cones: then it
/// parts with half that speed, or a quarter, …, or sticks, which is always possible.
Impulses Law::withFriction(const Impulses& smooth) {
  const std::vector<double> end = after(smooth);
  std::vector<double> restituted = end;
  const std::vector<double> compressed = after(plastic());
  for (std::size_t k = 0; k < restituted.size(); ++k) {
    restituted[k] -= compressed[k];
  }
  ContactProblem rough = problem_;
  for (const double part : kParts) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (contacts_[c].holds) {
        continue;
      }
      const auto& surface = problem_.contacts[c].target;
      rough.contacts[c].target = {(smooth[c][0] > 0 ? part * parting(c, end) : 0) + surface[0],
                                  part * speed(c, 1, restituted) + surface[1],
                                  part * speed(c, 2, restituted) + surface[2]};
    }
    ContactSolution solution;
    solution.enough = accuracy_.enough;
    if (accuracy_.enough > 0) {
      solution.impulses = smooth;
    }
    if (trySolve(rough, kMostFactorisations, solution)) {
      return part == 1 ? shortened(smooth, std::move(solution.impulses)) : solution.impulses;
    }
  }
  return solve(problem_);
}

/// Goes from the frictionless solution towards the one with friction, as far as energy, the friction cones
/// and the walls allow: all the way, unless a lifted contact would gain energy. All three constraints are
/// convex and hold at the start.
Impulses Law::shortened(const Impulses& smooth, Impulses rough) const {
  const std::vector<double> start = after(smooth);
  const std::vector<double> end = after(rough);
  double fraction = 1;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (contacts_[c].holds) {
      continue;
    }
    const double size = std::sqrt(rough[c][1] * rough[c][1] + rough[c][2] * rough[c][2]);
    const double limit = contacts_[c].material.friction * smooth[c][0];
    const double over = size - contacts_[c].material.friction * rough[c][0];
    if (over > 0x1p-44 * size) {
      fraction = std::min(fraction, limit / (limit + over));
    }
    const double closing = -parting(c, end);
    if (closing > rounding_) {
      const double opening = std::max(0.0, parting(c, start));
      fraction = std::min(fraction, opening / (opening + closing));
    }
  }
  std::vector<double> way = end;
  for (std::size_t k = 0; k < way.size(); ++k) {
    way[k] -= start[k];
  }
  double slope = product(start, way);  // dE/dfraction at the start, less the work of surfaces
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto& surface = problem_.contacts[c].target;
    slope -= contacts_[c].holds
                 ? 0
                 : (rough[c][0] - smooth[c][0]) * surface[0] + ((rough[c][1] - smooth[c][1]) * surface[1] +
                                                                (rough[c][2] - smooth[c][2]) * surface[2]);
  }
  const double curvature = product(way, way);
  const double full = product(start, start) / 2;
  if (fraction * slope + fraction * fraction * curvature / 2 > 0x1p-50 * full) {
    fraction = slope < 0 ? std::min(fraction, -slope / curvature) : 0;
  }
  if (fraction == 1) {
    return rough;
  }
  Impulses result = smooth;
  for (std::size_t c = 0; c < result.size(); ++c) {
    for (std::size_t row = 0; row < 3; ++row) {
      result[c][row] += fraction * (rough[c][row] - smooth[c][row]);
    }
  }
  return result;
}

}  // namespace

ContactResiduals resolveTogether(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts,
                                 std::span<ImpactShare> shares, ImpactAccuracy accuracy) {
  if (contacts.size() == 1 && !contacts[0].rows) {
    const ImpactContact& only = contacts[0];
    const ImpactBody& b = bodies[static_cast<std::size_t>(only.b)];
    shares[0] = resolveSingleImpact(bodies[static_cast<std::size_t>(only.a)],
                                    isImmovable(*b.mass) && !b.isDriven() ? nullptr : &b, only);
    shares[0].normal = only.normal;
    return {};
  }
  Law law(impactProblemOf(bodies, contacts), contacts, accuracy);
  const Impulses impulses = law.resolve();
  std::vector<Vec3> world(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Impulse& j = impulses[c];
    world[c] = frameOf(contacts[c].normal).inWorld(j);
    shares[c] = {.approach = law.approach(c),
                 .impulse = j[0],
                 .tangential = std::sqrt(j[1] * j[1] + j[2] * j[2]),
                 .normal = contacts[c].normal};
    if (!world[c].allFinite()) {
      throw NumericalError("impact: an impulse is not a finite number");
    }
    if (contacts[c].rows) {
      shares[c].rows = j;
      shares[c].impulse = Vec3(j[0], j[1], j[2]).norm();
      shares[c].tangential = 0;
    }
  }
  for (std::size_t index = 0; index < bodies.size(); ++index) {
    if (!isImmovable(*bodies[index].mass)) {
      applyImpulses(static_cast<int>(index), bodies[index], contacts, shares, world);
    }
  }
  return law.takeResiduals();
}

}  // namespace careen
