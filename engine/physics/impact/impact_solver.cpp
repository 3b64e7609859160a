#include "physics/impact/impact_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/impact/ldl.h"
#include "physics/impact/order_free_sum.h"

namespace careen {
namespace {

constexpr std::size_t kSix = ImpactSolver::kAxes;

/// ρ, as multiple of a contact's effective mass. Each outer iteration reduces the error by a factor of about
/// ρ, unless rows of different contacts are nearly parallel, and loses log₂ ρ of 53 bits in its solve: about
/// half is a compromise.
constexpr double kPenalty = 0x1p20;
/// A speed this small relative to the scale of speeds is rounding error.
constexpr double kRounding = 0x1p-52;
/// Violations this small that no longer decrease are rounding error.
constexpr double kNoise = 0x1p-49;
constexpr int kOuterCap = 60;
constexpr int kInnerCap = 60;
/// Full Newton steps taken before the line search is used; they nearly always suffice.
constexpr int kTrusted = 4;
/// Fraction of the initial slope at which the line search stops, and its most bisections.
constexpr double kFlat = 0.1;
constexpr int kSearchCap = 40;

}  // namespace

ImpactSolver::ImpactSolver(ImpactVector<double> inverseMass, ImpactVector<Contact> contacts)
    : inverseMass_(std::move(inverseMass)),
      mass_(inverseMass_.size(), 1, memory()),
      contacts_(std::move(contacts)),
      touchesOf_(inverseMass_.size() / kSix, memory()),
      blocks_(memory()),
      excess_(contacts_.size(), memory()),
      best_(memory()),
      q_(memory()),
      responses_(contacts_.size(), memory()),
      previous_(memory()),
      factorised_(memory()),
      z_(inverseMass_.size(), memory()),
      from_(memory()),
      gradient_(inverseMass_.size(), memory()),
      step_(inverseMass_.size(), memory()),
      matrix_(inverseMass_.size() * inverseMass_.size(), memory()),
      terms_(memory()) {
  const std::size_t axes = inverseMass_.size();
  terms_.reserve(1 + contacts_.size());
  for (std::size_t k = 0; k < axes; ++k) {
    if (inverseMass_[k] > 0) {
      mass_[k] = 1 / inverseMass_[k];
    }
  }
  for (std::size_t p = 0; p < axes / kSix; ++p) {
    const int body = static_cast<int>(p);
    blocks_.push_back({body, body, ImpactVector<Touch>(memory())});
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    Contact& contact = contacts_[c];
    const std::array<int, 2> sides{contact.a, contact.b};
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t k = 0; k < kSix; ++k) {
        const bool moves =
            sides[side] != kNobody && inverseMass_[static_cast<std::size_t>(sides[side]) * kSix + k] > 0;
        for (Row& row : contact.rows) {
          row[side * kSix + k] = moves ? row[side * kSix + k] : 0;
        }
      }
      if (sides[side] != kNobody) {
        const auto p = static_cast<std::size_t>(sides[side]);
        touchesOf_[p].push_back({c, side * kSix, side * kSix});
        blocks_[p].touches.push_back({c, side * kSix, side * kSix});
      }
    }
    if (contact.a != kNobody && contact.b != kNobody) {
      const int p = std::max(contact.a, contact.b);
      const int q = std::min(contact.a, contact.b);
      const Touch touch{c, p == contact.a ? 0 : kSix, q == contact.a ? 0 : kSix};
      const auto pair = std::find_if(blocks_.begin(), blocks_.end(),
                                     [&](const Block& block) { return block.p == p && block.q == q; });
      if (pair == blocks_.end()) {
        blocks_.push_back({p, q, ImpactVector<Touch>({touch}, memory())});
      } else {
        pair->touches.push_back(touch);
      }
    }
  }
}

double ImpactSolver::speed(std::size_t contact, int row, std::span<const double> q) const {
  const Contact& touched = contacts_[contact];
  const Row& values = touched.rows[static_cast<std::size_t>(row)];
  double linear = 0;  // summed per side, so that exchanging the sides changes no bit
  double angular = 0;
  const std::array<int, 2> sides{touched.a, touched.b};
  for (std::size_t side = 0; side < 2; ++side) {
    if (sides[side] != kNobody) {
      const double* value = &values[side * kSix];
      const double* of = &q[static_cast<std::size_t>(sides[side]) * kSix];
      linear += value[0] * of[0] + value[1] * of[1] + value[2] * of[2];
      angular += value[3] * of[3] + value[4] * of[4] + value[5] * of[5];
    }
  }
  return linear + angular;
}

double ImpactSolver::speedScale(std::span<const double> q) const {
  double largest = 0;
  for (const Contact& contact : contacts_) {
    double sum = 0;
    const std::array<int, 2> sides{contact.a, contact.b};
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t k = 0; sides[side] != kNobody && k < kSix; ++k) {
        sum +=
            std::fabs(contact.rows[0][side * kSix + k] * q[static_cast<std::size_t>(sides[side]) * kSix + k]);
      }
    }
    largest = std::max(largest, sum);
  }
  return largest;
}

void ImpactSolver::after(std::span<const double> q0, std::span<const Impulse> impulses,
                         ImpactVector<double>& q) {
  q.resize(q0.size());
  for (std::size_t p = 0; p < touchesOf_.size(); ++p) {
    terms_.clear();
    Six& start = terms_.emplace_back();
    std::copy_n(&q0[p * kSix], kSix, start.begin());
    for (const Touch& touch : touchesOf_[p]) {
      const auto& rows = contacts_[touch.contact].rows;
      const Impulse& impulse = impulses[touch.contact];
      Six& term = terms_.emplace_back();
      for (std::size_t k = 0; k < kSix; ++k) {
        term[k] = inverseMass_[p * kSix + k] *
                  (rows[0][touch.first + k] * impulse[0] + rows[1][touch.first + k] * impulse[1] +
                   rows[2][touch.first + k] * impulse[2]);
      }
    }
    const Six sum = orderFreeSums<kSix>(terms_);
    std::copy_n(sum.begin(), kSix, &q[p * kSix]);
  }
}

double ImpactSolver::energy(std::span<const double> q) const {
  double twice = 0;
  for (std::size_t k = 0; k < q.size(); ++k) {
    twice += inverseMass_[k] > 0 ? mass_[k] * q[k] * q[k] : 0;
  }
  return twice / 2;
}

/// The impulse of the augmented Lagrangian at a contact: the guess minus penalty times excess, projected onto
/// the admissible set.
ImpactSolver::Response ImpactSolver::respond(const Contact& contact, const Demand& demand,
                                             const Impulse& guess, const Impulse& excess) const {
  Response response;
  if (!demand.included) {
    return response;
  }
  const double normal = guess[0] - kPenalty * contact.normalMass * excess[0];
  if (normal > 0) {
    response.impulse[0] = normal;
    response.normal = State::kOn;
  }
  if (demand.frictionLimit > 0) {
    const double x = guess[1] - kPenalty * contact.tangentialMass * excess[1];
    const double y = guess[2] - kPenalty * contact.tangentialMass * excess[2];
    const double size = std::sqrt(x * x + y * y);
    if (size <= demand.frictionLimit) {
      response.impulse[1] = x;
      response.impulse[2] = y;
      response.tangent = State::kStick;
      response.stiffness = {1, 0, 1};
    } else {
      const double shrink = demand.frictionLimit / size;
      const double alongX = x / size;
      const double alongY = y / size;
      response.impulse[1] = shrink * x;
      response.impulse[2] = shrink * y;
      response.tangent = State::kSlip;
      response.stiffness = {shrink * (alongY * alongY), -shrink * (alongX * alongY),
                            shrink * (alongX * alongX)};
    }
  }
  return response;
}

void ImpactSolver::respondAll(std::span<const Demand> demands, std::span<const Impulse> impulses) {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    Impulse excess{};
    if (demands[c].included) {
      excess[0] = excess_[c][0] + speed(c, 0, z_);
      if (demands[c].frictionLimit > 0) {
        excess[1] = excess_[c][1] + speed(c, 1, z_);
        excess[2] = excess_[c][2] + speed(c, 2, z_);
      }
    }
    responses_[c] = respond(contacts_[c], demands[c], impulses[c], excess);
  }
}

/// M z − Jᵀ(response − guess): M (q − q₀) at the outer iterate is Jᵀ guess, so that no large terms cancel.
void ImpactSolver::gradient(std::span<const Impulse> impulses) {
  for (std::size_t p = 0; p < touchesOf_.size(); ++p) {
    terms_.clear();
    Six& inertia = terms_.emplace_back();
    for (std::size_t k = 0; k < kSix; ++k) {
      inertia[k] = mass_[p * kSix + k] * z_[p * kSix + k];
    }
    for (const Touch& touch : touchesOf_[p]) {
      const auto& rows = contacts_[touch.contact].rows;
      const Impulse& now = responses_[touch.contact].impulse;
      const Impulse& guess = impulses[touch.contact];
      Six& term = terms_.emplace_back();
      for (std::size_t k = 0; k < kSix; ++k) {
        term[k] = -(rows[0][touch.first + k] * (now[0] - guess[0]) +
                    rows[1][touch.first + k] * (now[1] - guess[1]) +
                    rows[2][touch.first + k] * (now[2] - guess[2]));
      }
    }
    const Six sum = orderFreeSums<kSix>(terms_);
    std::copy_n(sum.begin(), kSix, &gradient_[p * kSix]);
  }
}

/// M + ρ Σ m nᵀn + ρ Σ m tᵀ S t over the active contacts.
void ImpactSolver::assemble() {
  std::fill(matrix_.begin(), matrix_.end(), 0.0);
  for (const Block& block : blocks_) {
    assembleBlock(block);
  }
}

/// Row by row; entries above the diagonal are computed but never read.
void ImpactSolver::assembleBlock(const Block& block) {
  const std::size_t axes = mass_.size();
  const std::size_t top = static_cast<std::size_t>(block.p) * kSix;
  const std::size_t left = static_cast<std::size_t>(block.q) * kSix;
  for (std::size_t k = 0; k < kSix; ++k) {
    terms_.clear();
    if (block.p == block.q) {
      terms_.emplace_back()[k] = mass_[top + k];
    }
    for (const Touch& touch : block.touches) {
      const Response& response = responses_[touch.contact];
      const Contact& contact = contacts_[touch.contact];
      if (response.normal == State::kOff && response.tangent == State::kOff) {
        continue;
      }
      Six& term = terms_.emplace_back();
      const auto& [n, t, u] = contact.rows;
      const std::size_t i = touch.first + k;
      const double* nj = &n[touch.second];
      const double* tj = &t[touch.second];
      const double* uj = &u[touch.second];
      if (response.normal == State::kOn) {
        for (std::size_t l = 0; l < kSix; ++l) {
          term[l] = kPenalty * contact.normalMass * (n[i] * nj[l]);
        }
      }
      if (response.tangent != State::kOff) {
        const std::array<double, 3>& s = response.stiffness;
        for (std::size_t l = 0; l < kSix; ++l) {
          term[l] += kPenalty * contact.tangentialMass *
                     (s[0] * (t[i] * tj[l]) + s[2] * (u[i] * uj[l]) + s[1] * (t[i] * uj[l] + u[i] * tj[l]));
        }
      }
    }
    const Six sum = orderFreeSums<kSix>(terms_);
    std::copy_n(sum.begin(), kSix, &matrix_[(top + k) * axes + left]);
  }
}

void ImpactSolver::newtonStep() {
  const bool known = std::equal(responses_.begin(), responses_.end(), factorised_.begin(), factorised_.end(),
                                [](const Response& x, const Response& y) { return x.feelsLike(y); });
  if (!known) {
    assemble();
    factoriseLdl(matrix_, mass_.size());
    factorised_ = responses_;
  }
  for (std::size_t k = 0; k < step_.size(); ++k) {
    step_[k] = -gradient_[k];
  }
  solveLdl(matrix_, step_);
}

/// Slope of the smooth subproblem along the last step.
double ImpactSolver::along() const {
  double slope = 0;
  for (std::size_t k = 0; k < step_.size(); ++k) {
    slope += gradient_[k] * step_[k];
  }
  return slope;
}

/// Line search: takes the full step if `trusted` or if it still descends at its end, else goes to about the
/// minimum. The subproblem is convex, hence its slope along the step only rises.
double ImpactSolver::lineSearch(std::span<const Demand> demands, std::span<const Impulse> impulses,
                                bool trusted) {
  const auto moveTo = [&](double length) {
    for (std::size_t k = 0; k < z_.size(); ++k) {
      z_[k] = from_[k] + length * step_[k];
    }
    respondAll(demands, impulses);
  };
  const double slopeAtStart = along();
  moveTo(1);
  if (trusted) {
    return 1;
  }
  gradient(impulses);
  if (along() <= kFlat * std::fabs(slopeAtStart)) {
    return 1;
  }
  double low = 0;
  double high = 1;
  double length = 1;
  for (int i = 0; i < kSearchCap; ++i) {
    length = (low + high) / 2;
    moveTo(length);
    gradient(impulses);
    const double slope = along();
    if (std::fabs(slope) <= kFlat * std::fabs(slopeAtStart)) {
      break;
    }
    (slope < 0 ? low : high) = length;
  }
  return length;
}

/// Solves the smooth subproblem; leaves its solution in z_ and responses_.
void ImpactSolver::minimise(std::span<const double> q, std::span<const Demand> demands,
                            std::span<const Impulse> impulses, double accuracy) {
  std::fill(z_.begin(), z_.end(), 0.0);
  respondAll(demands, impulses);
  const double whole = energy(q);
  for (int iteration = 0; iteration < kInnerCap; ++iteration) {
    gradient(impulses);
    newtonStep();
    previous_ = responses_;
    from_ = z_;
    const double length = lineSearch(demands, impulses, iteration < kTrusted);
    bool same = length == 1;
    bool slips = false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      same = same && responses_[c].normal == previous_[c].normal &&
             responses_[c].tangent == previous_[c].tangent;
      slips = slips || responses_[c].tangent == State::kSlip;
    }
    // Without slip the subproblem is piecewise quadratic and the step exact. With slip the error is about the
    // square of the step; if it is larger, the outer iteration repeats.
    if (same && (!slips || energy(step_) <= accuracy * whole)) {
      return;
    }
  }
}

/// Largest violation of a condition [m/s]; an inadmissible impulse counts by the speed it gives.
double ImpactSolver::violation(std::span<const double> q, std::span<const Demand> demands,
                               std::span<const Impulse> impulses) {
  double worst = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& contact = contacts_[c];
    const Demand& demand = demands[c];
    excess_[c] = {};
    if (!demand.included) {
      continue;
    }
    excess_[c][0] = speed(c, 0, q) - demand.partingSpeed;
    worst = std::max(worst, std::fabs(std::min(excess_[c][0], impulses[c][0] / contact.normalMass)));
    if (demand.frictionLimit > 0) {
      excess_[c][1] = speed(c, 1, q) - demand.slip[0];
      excess_[c][2] = speed(c, 2, q) - demand.slip[1];
      // λ satisfies its conditions iff it is the projection of λ − m (t q − b) onto the disc of radius R.
      const double x = impulses[c][1] - contact.tangentialMass * excess_[c][1];
      const double y = impulses[c][2] - contact.tangentialMass * excess_[c][2];
      const double size = std::sqrt(x * x + y * y);
      const double shrink = size > demand.frictionLimit ? demand.frictionLimit / size : 1;
      worst = std::max(worst, std::fabs(impulses[c][1] - shrink * x) / contact.tangentialMass);
      worst = std::max(worst, std::fabs(impulses[c][2] - shrink * y) / contact.tangentialMass);
    }
  }
  return worst;
}

bool ImpactSolver::solve(std::span<const double> q0, std::span<const Demand> demands,
                         ImpactVector<Impulse>& impulses, double accuracy) {
  double scale = speedScale(q0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (!demands[c].included) {
      impulses[c] = {};
    } else if (!(demands[c].frictionLimit > 0)) {
      impulses[c][1] = 0;
      impulses[c][2] = 0;
    }
  }
  double bestViolation = std::numeric_limits<double>::infinity();
  int stalled = 0;
  for (int iteration = 0; iteration < kOuterCap; ++iteration) {
    after(q0, impulses, q_);
    scale = std::max(scale, speedScale(q_));
    const double now = violation(q_, demands, impulses);
    stalled = now < bestViolation / 2 ? 0 : stalled + 1;
    if (now < bestViolation) {
      bestViolation = now;
      best_ = impulses;
    }
    if (now <= accuracy * scale || stalled >= (bestViolation <= kNoise * scale ? 1 : 3)) {
      break;
    }
    minimise(q_, demands, impulses, accuracy);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      impulses[c] = responses_[c].impulse;
    }
  }
  impulses = best_;
  return bestViolation <= 16 * kRounding * scale;
}

}  // namespace careen
