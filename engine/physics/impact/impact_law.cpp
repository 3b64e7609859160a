#include "physics/impact/impact_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <utility>

#include "core/error.h"
#include "physics/geometry/tangents.h"
#include "physics/impact/impact_solver.h"
#include "physics/impact/order_free_sum.h"
#include "physics/impact/secant_iteration.h"
#include "physics/impact/single_impact.h"

namespace careen {
namespace {

using Impulse = ImpactSolver::Impulse;
using Demand = ImpactSolver::Demand;
constexpr std::size_t kSix = ImpactSolver::kAxes;
/// Friction limits count normal impulses up to this many times the largest of the frictionless impact.
constexpr double kWedged = 0x1p10;

bool movable(const MassProperties& mass) {
  return mass.inverseMass > 0 || !mass.inverseInertiaBody.isZero(0);
}

/// One body's part of a Jacobian row: the speed of its point along `direction`, per unit of its velocities.
void fillSide(ImpactSolver::Row& row, std::size_t side, const Vec3& direction, const Vec3& arm, const Mat3& a,
              double sign) {
  const Vec3 turning = a.transpose() * arm.cross(direction);
  for (std::size_t k = 0; k < 3; ++k) {
    row[side * kSix + k] = sign * direction[static_cast<Eigen::Index>(k)];
    row[side * kSix + 3 + k] = sign * turning[static_cast<Eigen::Index>(k)];
  }
}

/// The impact in the coordinates of the solver: only the bodies that can move.
struct Setup {
  explicit Setup(std::pmr::memory_resource* memory)
      : movableOf(memory), velocity(memory), inverseMass(memory), contacts(memory) {}

  ImpactVector<int> movableOf;  // by body: index among the movable, or kNobody
  ImpactVector<double> velocity;
  ImpactVector<double> inverseMass;
  ImpactVector<ImpactSolver::Contact> contacts;
};

void addBodies(Setup& setup, std::span<const ImpactBody> bodies) {
  for (const ImpactBody& body : bodies) {
    if (!movable(*body.mass)) {
      setup.movableOf.push_back(ImpactSolver::kNobody);
      continue;
    }
    setup.movableOf.push_back(static_cast<int>(setup.velocity.size() / kSix));
    const Vec3 momentumBody = body.state->pose.worldFromBody.transpose() * body.state->angularMomentum;
    const Vec3 spin = body.mass->inverseInertiaBody.cwiseProduct(momentumBody);
    for (Eigen::Index k = 0; k < 3; ++k) {
      setup.velocity.push_back(body.state->velocity[k]);
      setup.inverseMass.push_back(body.mass->inverseMass);
    }
    for (Eigen::Index k = 0; k < 3; ++k) {
      setup.velocity.push_back(spin[k]);
      setup.inverseMass.push_back(body.mass->inverseInertiaBody[k]);
    }
  }
}

double inverseEffectiveMass(const Setup& setup, const ImpactSolver::Contact& contact, std::size_t row) {
  std::array<double, 2> sum{};
  const std::array<int, 2> sides{contact.a, contact.b};
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t k = 0; sides[side] != ImpactSolver::kNobody && k < kSix; ++k) {
      const double value = contact.rows[row][side * kSix + k];
      sum[side] += setup.inverseMass[static_cast<std::size_t>(sides[side]) * kSix + k] * (value * value);
    }
  }
  return sum[0] + sum[1];
}

void addContact(Setup& setup, std::span<const ImpactBody> bodies, const ImpactContact& contact) {
  ImpactSolver::Contact added;
  const Tangents tangents = tangentsOf(contact.normal);
  const std::array<Vec3, 3> directions{contact.normal, tangents.first, tangents.second};
  const auto a = static_cast<std::size_t>(contact.a);
  added.a = setup.movableOf[a];
  for (std::size_t row = 0; row < 3; ++row) {
    fillSide(added.rows[row], 0, directions[row], contact.armA, bodies[a].state->pose.worldFromBody, 1);
  }
  if (!contact.b.isWall()) {
    const auto b = static_cast<std::size_t>(contact.b.body());
    added.b = setup.movableOf[b];
    for (std::size_t row = 0; row < 3; ++row) {
      fillSide(added.rows[row], 1, directions[row], contact.armB, bodies[b].state->pose.worldFromBody, -1);
    }
  }
  const double normal = inverseEffectiveMass(setup, added, 0);
  const double tangential = inverseEffectiveMass(setup, added, 1) + inverseEffectiveMass(setup, added, 2);
  if (!(normal > 0) || !std::isfinite(normal + tangential)) {
    throw NumericalError(
        "impact: a contact between two sides that cannot move, or a number that is not finite");
  }
  added.normalMass = 1 / normal;
  added.tangentialMass = 2 / tangential;
  setup.contacts.push_back(added);
}

/// The laws for several contacts, all in terms of impulses from the velocity before.
class Law {
 public:
  Law(Setup setup, std::span<const ImpactContact> contacts)
      : memory_(setup.velocity.get_allocator().resource()),
        before_(std::move(setup.velocity)),
        solver_(std::move(setup.inverseMass), std::move(setup.contacts)),
        contacts_(contacts),
        rounding_(kApproachRounding * solver_.speedScale(before_)),
        plastic_(memory_),
        projected_(contacts.size(), memory_),
        demands_(contacts.size(), memory_) {}

  ImpactVector<Impulse> resolve() {
    Chosen approaches(memory_);
    findApproaching(before_, approaches);
    if (std::none_of(approaches.begin(), approaches.end(), [](char yes) { return yes != 0; })) {
      return Impulses(contacts_.size(), memory_);
    }
    ImpactVector<Impulse> impulses = frictionless();
    const bool rough = std::any_of(contacts_.begin(), contacts_.end(),
                                   [](const ImpactContact& c) { return c.material.friction > 0; });
    if (rough) {
      return withFriction(impulses);
    }
    return impulses;
  }

  double approach(std::size_t contact) const { return -solver_.speed(contact, 0, before_); }

 private:
  using Impulses = ImpactVector<Impulse>;
  using Chosen = ImpactVector<char>;  // of the contacts

  void findApproaching(std::span<const double> q, Chosen& approaches) const {
    approaches.clear();
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      approaches.push_back(solver_.speed(c, 0, q) < -rounding_ ? 1 : 0);
    }
  }

  /// Impulses that project q onto the motions in which the chosen contacts do not approach.
  const Impulses& projection(std::span<const double> q, std::span<const char> chosen) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      demands_[c].included = chosen[c] != 0;
      projected_[c] = {};
    }
    solver_.solve(q, demands_, projected_);
    return projected_;
  }

  static void add(Impulses& sum, double factor, const Impulses& impulses) {
    for (std::size_t c = 0; c < sum.size(); ++c) {
      for (std::size_t row = 0; row < 3; ++row) {
        sum[c][row] += factor * impulses[c][row];
      }
    }
  }

  /// P: Moreau's projection.
  const Impulses& plastic() {
    if (plastic_.empty()) {
      plastic_ = projection(before_, Chosen(contacts_.size(), 1, memory_));
    }
    return plastic_;
  }

  /// Xₜ: reflections about the contacts with e > t, projections onto the others, until nothing approaches.
  /// Reflections alone terminate; a mixture that does not within the cap is ended by the plastic law.
  Impulses reflected(double threshold) {
    Impulses total(contacts_.size(), memory_);
    ImpactVector<double> q(before_, memory_);
    Chosen violated(memory_);
    Chosen elastic(memory_);
    const std::size_t cap = 100 + 10 * contacts_.size() * contacts_.size();
    for (std::size_t pass = 0; pass < cap; ++pass) {
      findApproaching(q, violated);
      elastic = violated;
      bool any = false;
      bool anyElastic = false;
      for (std::size_t c = 0; c < contacts_.size(); ++c) {
        elastic[c] = violated[c] != 0 && contacts_[c].material.restitution > threshold ? 1 : 0;
        any = any || violated[c] != 0;
        anyElastic = anyElastic || elastic[c] != 0;
      }
      if (!any) {
        return total;
      }
      const Chosen& chosen = anyElastic ? elastic : violated;
      const bool isPlastic = pass == 0 && std::find(chosen.begin(), chosen.end(), 0) == chosen.end();
      add(total, anyElastic ? 2 : 1, isPlastic ? plastic() : projection(q, chosen));
      solver_.after(before_, total, q);
    }
    add(total, 1, projection(q, Chosen(contacts_.size(), 1, memory_)));
    return total;
  }

  Impulses frictionless() {
    ImpactVector<double> levels(memory_);  // the distinct e above 0, ascending
    bool somePlastic = false;
    for (const ImpactContact& contact : contacts_) {
      if (contact.material.restitution > 0) {
        levels.push_back(contact.material.restitution);
      }
      somePlastic = somePlastic || contact.material.restitution < 1;
    }
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    Impulses total(contacts_.size(), memory_);
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
  Impulses shortened(const Impulses& smooth, Impulses rough);

  std::pmr::memory_resource* memory_;
  ImpactVector<double> before_;
  ImpactSolver solver_;
  std::span<const ImpactContact> contacts_;
  double rounding_;
  Impulses plastic_;    // empty: not yet computed
  Impulses projected_;  // the last projection
  ImpactVector<Demand> demands_;
};

/// The Coulomb friction limits depend on the normal impulses and these on friction: fixed-point iteration
/// makes them agree, with a convex problem each time.
Law::Impulses Law::withFriction(const Impulses& smooth) {
  ImpactVector<double> parting(memory_);
  ImpactVector<double> compressed(memory_);
  solver_.after(before_, smooth, parting);
  solver_.after(before_, plastic(), compressed);
  ImpactVector<double> restituted(parting, memory_);
  for (std::size_t k = 0; k < restituted.size(); ++k) {
    restituted[k] -= compressed[k];
  }
  ImpactVector<Demand> demands(contacts_.size(), memory_);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    demands[c].partingSpeed = smooth[c][0] > 0 ? solver_.speed(c, 0, parting) : 0;
    demands[c].frictionLimit = contacts_[c].material.friction * smooth[c][0];
    demands[c].slip = {solver_.speed(c, 1, restituted), solver_.speed(c, 2, restituted)};
  }
  // For a box with friction wedged between walls, the impulses are not bounded and the iteration could
  // diverge: impulses that cancel are limited to a size whose rounding error does not matter.
  double most = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    most = std::max(most, kWedged * smooth[c][0]);
  }
  ImpactVector<double> limits(contacts_.size(), memory_);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    limits[c] = demands[c].frictionLimit;
  }
  constexpr int kCap = 100;
  constexpr int kUndamped = 30;
  constexpr int kPatience = 16;  // iterations without improvement
  constexpr double kAgree = 0x1p-46;
  // Each problem is solved only as accurately as the limits are known.
  constexpr double kAhead = 0x1p-10;
  double accuracy = kAhead;
  Impulses rough(smooth, memory_);
  Impulses best(smooth, memory_);
  double bestChange = std::numeric_limits<double>::infinity();
  int bestAt = 0;
  SecantIteration iteration(contacts_.size(), memory_);
  ImpactVector<double> found(contacts_.size(), memory_);
  for (int k = 0; k < kCap; ++k) {
    solver_.solve(before_, demands, rough, accuracy);
    double change = 0;
    double largest = 0;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      found[c] = contacts_[c].material.friction * std::min(rough[c][0], most);
      change = std::max(change, std::fabs(found[c] - limits[c]));
      largest = std::max(largest, std::max(found[c], limits[c]));
    }
    const double relative = largest > 0 ? change / largest : 0;
    const bool full = accuracy == ImpactSolver::kFullAccuracy;
    if (relative <= kAgree && full) {
      return shortened(smooth, std::move(rough));
    }
    if (relative < bestChange && (full || accuracy <= relative / 8)) {
      bestChange = relative;
      bestAt = k;
      best = rough;
    }
    if (k - bestAt >= kPatience) {
      break;
    }
    iteration.step(limits, found, k < kUndamped ? 1 : 0.5);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      limits[c] = std::max(0.0, limits[c]);
      demands[c].frictionLimit = limits[c];
    }
    accuracy = std::clamp(kAhead * relative, ImpactSolver::kFullAccuracy, kAhead);
  }
  return shortened(smooth, std::move(best));
}

/// Goes from the frictionless solution towards the one with friction, as far as energy, the friction cones
/// and the walls allow: all the way, unless the iteration above did not converge or a lifted contact would
/// gain energy. All three constraints are convex and hold at the start.
Law::Impulses Law::shortened(const Impulses& smooth, Impulses rough) {
  ImpactVector<double> start(memory_);
  ImpactVector<double> end(memory_);
  solver_.after(before_, smooth, start);
  solver_.after(before_, rough, end);
  double fraction = 1;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const double size = std::sqrt(rough[c][1] * rough[c][1] + rough[c][2] * rough[c][2]);
    const double limit = contacts_[c].material.friction * smooth[c][0];
    const double over = size - contacts_[c].material.friction * rough[c][0];
    if (over > 0x1p-44 * size) {
      fraction = std::min(fraction, limit / (limit + over));
    }
    const double closing = -solver_.speed(c, 0, end);
    if (closing > rounding_) {
      const double parting = std::max(0.0, solver_.speed(c, 0, start));
      fraction = std::min(fraction, parting / (parting + closing));
    }
  }
  ImpactVector<double> way(end, memory_);
  double slope = 0;  // dE/dfraction at the start
  for (std::size_t k = 0; k < way.size(); ++k) {
    way[k] -= start[k];
    slope += solver_.inverseMass()[k] > 0 ? start[k] * way[k] / solver_.inverseMass()[k] : 0;
  }
  const double curvature = 2 * solver_.energy(way);
  const double full = solver_.energy(start);
  if (fraction * slope + fraction * fraction * curvature / 2 > 0x1p-50 * full) {
    fraction = slope < 0 ? std::min(fraction, -slope / curvature) : 0;
  }
  if (fraction == 1) {
    return rough;
  }
  Impulses result(smooth, memory_);
  for (std::size_t c = 0; c < result.size(); ++c) {
    for (std::size_t row = 0; row < 3; ++row) {
      result[c][row] += fraction * (rough[c][row] - smooth[c][row]);
    }
  }
  return result;
}

/// Adds the impulses of the contacts to velocity and angular momentum; a component below the rounding error
/// of its terms becomes zero.
void applyTo(int index, const ImpactBody& body, std::span<const ImpactContact> contacts,
             std::span<const Vec3> impulses, std::pmr::memory_resource* memory) {
  using Six = std::array<double, kSix>;
  BodyState& state = *body.state;
  ImpactVector<Six> terms(memory);
  terms.reserve(1 + 2 * contacts.size());
  const auto add = [&terms](const Vec3& linear, const Vec3& angular) {
    terms.push_back({linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]});
  };
  add(state.velocity, state.angularMomentum);
  const bool turns = !body.mass->inverseInertiaBody.isZero(0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (const bool second : {false, true}) {
      if (second ? contacts[c].b.isBody(index) : contacts[c].a == index) {
        const Vec3 impulse = second ? Vec3(-impulses[c]) : impulses[c];
        const Vec3& arm = second ? contacts[c].armB : contacts[c].armA;
        add(body.mass->inverseMass * impulse, turns ? arm.cross(impulse) : Vec3(Vec3::Zero()));
      }
    }
  }
  Six sums = orderFreeSums<kSix>(terms);
  for (std::size_t k = 0; k < kSix; ++k) {
    double largest = 0;
    for (const Six& term : terms) {
      largest = std::max(largest, std::fabs(term[k]));
    }
    sums[k] = std::fabs(sums[k]) <= 0x1p-49 * largest ? 0 : sums[k];
  }
  state.velocity = Vec3(sums[0], sums[1], sums[2]);
  state.angularMomentum = Vec3(sums[3], sums[4], sums[5]);
}

}  // namespace

void resolveImpact(std::span<const ImpactBody> bodies, std::span<const ImpactContact> contacts,
                   std::span<ImpactShare> shares) {
  if (contacts.size() == 1) {
    const ImpactContact& only = contacts[0];
    const ImpactBody* b = only.b.isWall() ? nullptr : &bodies[static_cast<std::size_t>(only.b.body())];
    shares[0] = resolveSingleImpact(bodies[static_cast<std::size_t>(only.a)], b, only);
    return;
  }
  // Usual impacts need no heap: a dozen contacts of one body fit.
  std::array<std::byte, std::size_t{1} << 15U> room;
  std::pmr::monotonic_buffer_resource memory(room.data(), room.size());
  Setup setup(&memory);
  addBodies(setup, bodies);
  setup.contacts.reserve(contacts.size());
  for (const ImpactContact& contact : contacts) {
    addContact(setup, bodies, contact);
  }
  Law law(std::move(setup), contacts);
  const ImpactVector<Impulse> impulses = law.resolve();
  ImpactVector<Vec3> world(contacts.size(), &memory);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Tangents tangents = tangentsOf(contacts[c].normal);
    const Impulse& j = impulses[c];
    world[c] = j[0] * contacts[c].normal + (j[1] * tangents.first + j[2] * tangents.second);
    shares[c] = {
        .approach = law.approach(c), .impulse = j[0], .tangential = std::sqrt(j[1] * j[1] + j[2] * j[2])};
    if (!world[c].allFinite()) {
      throw NumericalError("impact: an impulse is not a finite number");
    }
  }
  for (std::size_t index = 0; index < bodies.size(); ++index) {
    applyTo(static_cast<int>(index), bodies[index], contacts, world, &memory);
  }
}

}  // namespace careen
