#include "exchange/friction_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

  // From one to the next along pairs, as shares of the first one's: μ_b = F_ab² / μ_a. An odd round of pairs
  // says what that is: of three, μ_a = F_ab F_ac / F_bc.
  std::vector<double> solve() const {
    std::vector<double> found(own_.size(), 0);
    std::vector<Share> shares(own_.size());
    std::vector<std::size_t> seeds(own_.size());
    std::iota(seeds.begin(), seeds.end(), std::size_t{0});
    std::stable_partition(seeds.begin(), seeds.end(), [this](std::size_t i) { return movable_[i]; });
    for (const std::size_t seed : seeds) {
      if (shares[seed].power == 0) {
        solveFrom(seed, shares, found);
      }
    }
    return found;
  }

 private:
  /// Of one coefficient: factor times the seed's to the power of 1 or −1; 0: not yet known.
  struct Share {
    double factor = 1;
    int power = 0;
  };

  void solveFrom(std::size_t seed, std::vector<Share>& shares, std::vector<double>& found) const {
    std::vector<std::size_t> members = {seed};
    shares[seed].power = 1;
    double first = 0;  // the seed's
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t i = members[k];
      for (std::size_t j = 0; j < own_.size(); ++j) {
        const double friction = isPair(i, j) ? friction_(i, j) : 0;
        if (!(friction > 0)) {
          continue;
        }
        if (shares[j].power == 0) {
          shares[j] = {.factor = friction * friction / shares[i].factor, .power = -shares[i].power};
          members.push_back(j);
        } else if (shares[j].power == shares[i].power && first == 0) {
          const double mean = std::sqrt(shares[i].factor * shares[j].factor);
          first = shares[i].power > 0 ? friction / mean : mean / friction;
        }
      }
    }
    if (members.size() == 1) {
      return;  // it has no friction with any
    }
    if (first == 0 && movable_[members[1]]) {
      first = friction_(seed, members[1]);
    } else if (first == 0) {
      first = own_[seed] > 0 ? own_[seed] : 1;
    }
    for (const std::size_t each : members) {
      found[each] = shares[each].power > 0 ? shares[each].factor * first : shares[each].factor / first;
    }
  }

  bool isPair(std::size_t i, std::size_t j) const { return i != j && (movable_[i] || movable_[j]); }

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
