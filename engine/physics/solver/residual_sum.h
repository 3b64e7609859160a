#pragma once

#include <algorithm>
#include <cmath>

#include "physics/solver/impulse_set.h"
#include "physics/world/contact_residuals.h"

namespace careen {

/// The residuals of one problem, contact by contact.
class ResidualSum {
 public:
  using Triple = ContactProblem::Triple;

  /// `speed` is S [m/s], `impulse` is Λ [N s].
  ResidualSum(double speed, double impulse) : speed_(speed), impulse_(impulse) {}

  /// A contact with impulse λ [N s] and relative velocity u [m/s].
  void add(const ImpulseSet& set, const Triple& impulse, const Triple& u) {
    const auto& [n, t, s] = impulse;
    double power = n * u[0];
    if (set.kind == ImpulseSet::Kind::kSpace) {
      primal_ = std::max(primal_, set.violation(impulse, u));
      power_ = std::max(power_, std::fabs(power + (t * u[1] + s * u[2])));
      return;
    }
    if (set.kind == ImpulseSet::Kind::kInterval) {
      dual_ = std::max({dual_, set.least - n, n - set.most});
      power_ = std::max(power_, std::fabs((n - (u[0] > 0 ? set.least : set.most)) * u[0]));
      return;
    }
    primal_ = std::max(primal_, -u[0]);
    if (set.kind == ImpulseSet::Kind::kLine) {
      dual_ = std::max({dual_, -n, norm(t - set.drag[0] * n, s - set.drag[1] * n)});
    } else {
      const double limit = set.limit(n);
      dual_ = std::max({dual_, -n, norm(t, s) - limit});
      power += std::min(limit, impulse_) * norm(u[1], u[2]) + (t * u[1] + s * u[2]);
    }
    power_ = std::max(power_, std::fabs(power));
  }

  /// Those of other contacts of the same problem; in any order.
  void include(const ResidualSum& other) { include(other.primal_, other.dual_, other.power_); }
  /// Their largest: primal [m/s], dual [N s] and power [J].
  void include(double primal, double dual, double power) {
    primal_ = std::max(primal_, primal);
    dual_ = std::max(dual_, dual);
    power_ = std::max(power_, power);
  }

  double impulse() const { return impulse_; }

  ContactResiduals residuals() const {
    ContactResiduals all{.problems = 1};
    all.primal = speed_ > 0 ? primal_ / speed_ : 0;
    all.dual = impulse_ > 0 ? dual_ / impulse_ : 0;
    all.complementarity = speed_ > 0 && impulse_ > 0 ? power_ / impulse_ / speed_ : 0;
    return all;
  }

 private:
  static double norm(double x, double y) { return std::sqrt(x * x + y * y); }

  double speed_;
  double impulse_;
  double primal_ = 0;
  double dual_ = 0;
  double power_ = 0;
};

}  // namespace careen
