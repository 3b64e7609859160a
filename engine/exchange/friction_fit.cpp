#include "exchange/friction_fit.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

class Fit {
 public:
  Fit(const std::vector<double>& own, const std::vector<bool>& movable,
      const std::function<double(std::size_t, std::size_t)>& friction)
      : own_(own), movable_(movable), friction_(friction) {}

  std::optional<std::pair<std::size_t, std::size_t>> misfit(const std::vector<double>& coefficients) const {
    for (std::size_t i = 0; i < own_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (isPair(i, j)) {
          const double wanted = friction_(j, i);
          if (std::fabs(std::sqrt(coefficients[i] * coefficients[j]) - wanted) > kFrictionFits * wanted) {
            return std::pair(j, i);
          }
        }
      }
    }
    return std::nullopt;
  }

  // Of three that are pairs of each other, μ_a = F_ab F_ac / F_bc. Others follow from one that is known.
  std::vector<double> solve() const {
    std::vector<double> found(own_.size(), 0);
    std::vector<std::size_t> rough;  // all but those whose every pair is without friction
    for (std::size_t i = 0; i < own_.size(); ++i) {
      if (isRough(i)) {
        rough.push_back(i);
      }
    }
    // Movable ones first: any two of them, and any of them with an immovable one, are a pair.
    std::stable_partition(rough.begin(), rough.end(), [this](std::size_t i) { return movable_[i]; });
    if (rough.size() < 2) {
      return found;
    }
    const std::size_t a = rough[0];
    const std::size_t b = rough[1];
    found[a] = own_[a] > 0 ? own_[a] : 1;
    if (movable_[b] && rough.size() > 2 && friction_(b, rough[2]) > 0) {
      found[a] = friction_(a, b) * friction_(a, rough[2]) / friction_(b, rough[2]);
    } else if (movable_[b]) {
      found[a] = friction_(a, b);
    }
    if (!(found[a] > 0)) {
      return own_;  // two rough ones without friction between them: nothing fits
    }
    for (std::size_t k = 1; k < rough.size(); ++k) {
      const double shared = friction_(a, rough[k]);
      found[rough[k]] = std::isnan(shared) ? own_[rough[k]] : shared * shared / found[a];
    }
    return found;
  }

 private:
  bool isPair(std::size_t i, std::size_t j) const { return i != j && (movable_[i] || movable_[j]); }
  bool isRough(std::size_t i) const {
    for (std::size_t j = 0; j < own_.size(); ++j) {
      if (isPair(i, j) && friction_(i, j) > 0) {
        return true;
      }
    }
    return false;
  }

  const std::vector<double>& own_;
  const std::vector<bool>& movable_;
  const std::function<double(std::size_t, std::size_t)>& friction_;
};

}  // namespace

FrictionFit fitFrictions(const std::vector<double>& own, const std::vector<bool>& movable,
                         const std::function<double(std::size_t, std::size_t)>& friction) {
  const Fit fit(own, movable, friction);
  if (!fit.misfit(own)) {
    return {.coefficients = own, .misfit = {}};
  }
  std::vector<double> solved = fit.solve();
  const auto misfit = fit.misfit(solved);
  return {.coefficients = std::move(solved), .misfit = misfit};
}

}  // namespace careen
