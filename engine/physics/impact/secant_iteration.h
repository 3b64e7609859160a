#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "physics/impact/order_free_sum.h"

namespace careen {

/// Solves the fixed-point equation x = g(x). Plain iteration takes g(x) next; this takes the point on the
/// line through the last two where the residual would be least (D. G. Anderson, "Iterative procedures for
/// nonlinear integral equations", J. ACM 12, 1965, with one step of memory).
class SecantIteration {
 public:
  explicit SecantIteration(std::size_t size,
                           std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : x_(size, memory), rest_(size, memory), terms_(size, memory) {}

  /// Replaces x by the next iterate; `part` is the damping factor, 1 for none.
  void step(std::span<double> x, std::span<const double> g, double part) {
    for (std::size_t c = 0; c < x.size(); ++c) {
      const double rest = g[c] - x[c];
      const double turned = rest - rest_[c];
      terms_[c] = {rest * turned, turned * turned};
    }
    const auto [along, squared] = orderFreeSums<2>(terms_);
    const double back = hasLast_ && squared > 0 ? along / squared : 0;
    for (std::size_t c = 0; c < x.size(); ++c) {
      const double rest = g[c] - x[c];
      const double next = x[c] + part * rest;
      const double last = x_[c] + part * rest_[c];
      x_[c] = x[c];
      rest_[c] = rest;
      x[c] = next - back * (next - last);
    }
    hasLast_ = true;
  }

 private:
  std::pmr::vector<double> x_;     // the previous iterate
  std::pmr::vector<double> rest_;  // g(x) − x there
  std::pmr::vector<std::array<double, 2>> terms_;
  bool hasLast_ = false;
};

}  // namespace careen
