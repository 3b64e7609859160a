#include "physics/solver/elimination_order.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace careen {

std::vector<std::size_t> eliminationOrder(const ContactProblem& problem) {
  const std::size_t bodies = problem.free.size() / ContactProblem::kAxes;
  std::vector<std::set<std::size_t>> neighbors(bodies);
  for (const ContactProblem::Contact& contact : problem.contacts) {
    if (contact.a != ContactProblem::kNobody && contact.b != ContactProblem::kNobody) {
      const auto a = static_cast<std::size_t>(contact.a);
      const auto b = static_cast<std::size_t>(contact.b);
      neighbors[a].insert(b);
      neighbors[b].insert(a);
    }
  }
  std::set<std::pair<std::size_t, std::size_t>> next;  // degree, body
  for (std::size_t body = 0; body < bodies; ++body) {
    next.emplace(neighbors[body].size(), body);
  }
  std::vector<std::size_t> order;
  while (!next.empty()) {
    const std::size_t body = next.begin()->second;
    next.erase(next.begin());
    order.push_back(body);
    const std::set<std::size_t> others = neighbors[body];
    for (const std::size_t other : others) {
      next.erase({neighbors[other].size(), other});
      neighbors[other].erase(body);
      neighbors[other].insert(others.begin(), others.end());
      neighbors[other].erase(other);
      next.emplace(neighbors[other].size(), other);
    }
  }
  return order;
}

}  // namespace careen
