#include "physics/solver/elimination_order.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace careen {
namespace {

constexpr std::size_t kAxes = ContactProblem::kAxes;
using Graph = std::vector<std::vector<std::size_t>>;  // of each body, the other one of each of its contacts
using Ranks = std::vector<std::size_t>;

Graph graphOf(const ContactProblem& problem) {
  Graph graph(problem.free.size() / kAxes);
  for (const ContactProblem::Contact& contact : problem.contacts) {
    if (contact.a != ContactProblem::kNobody && contact.b != ContactProblem::kNobody) {
      graph[static_cast<std::size_t>(contact.a)].push_back(static_cast<std::size_t>(contact.b));
      graph[static_cast<std::size_t>(contact.b)].push_back(static_cast<std::size_t>(contact.a));
    }
  }
  return graph;
}

/// Equal keys have equal ranks.
template <class Key>
Ranks ranksOf(const std::vector<Key>& keys) {
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return keys[i] < keys[j]; });
  Ranks ranks(keys.size());
  for (std::size_t k = 1; k < order.size(); ++k) {
    ranks[order[k]] = ranks[order[k - 1]] + (keys[order[k - 1]] < keys[order[k]] ? 1 : 0);
  }
  return ranks;
}

std::size_t distinct(const Ranks& ranks) {
  return ranks.empty() ? 0 : *std::max_element(ranks.begin(), ranks.end()) + 1;
}

/// Splits equal ranks by the ranks of neighbours, again and again (B. Weisfeiler, A. Leman, 1968).
Ranks refined(Ranks ranks, const Graph& graph) {
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::pair<std::size_t, Ranks>> keys(ranks.size());
    for (std::size_t body = 0; body < ranks.size(); ++body) {
      keys[body].first = ranks[body];
      for (const std::size_t other : graph[body]) {
        keys[body].second.push_back(ranks[other]);
      }
      std::sort(keys[body].second.begin(), keys[body].second.end());
    }
    const std::size_t before = distinct(ranks);
    ranks = ranksOf(keys);
    if (distinct(ranks) == before) {
      break;
    }
  }
  return ranks;
}

double squareSum(const double* x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; }

/// What tells bodies apart, whatever they are called, in mirrors and with powers of two as units.
struct Marks {
  std::array<double, kAxes> inverseMass{};
  std::array<double, 2> speeds{};               // squared
  std::vector<std::array<double, 3>> contacts;  // sorted: friction, normal target, squared arm across normal
  bool operator<(const Marks& other) const {
    return std::tie(inverseMass, speeds, contacts) <
           std::tie(other.inverseMass, other.speeds, other.contacts);
  }
};

/// The rows of a joint point along axes of the world, which mirrors turn round.
std::array<double, 3> markOf(const ContactProblem::Contact& contact, std::size_t side) {
  const double arm = squareSum(&contact.rows[0][side * kAxes + 3]);
  if (ContactProblem::hasNormal(contact)) {
    return {contact.friction, contact.target[0], arm};
  }
  const double arms =
      arm + squareSum(&contact.rows[1][side * kAxes + 3]) + squareSum(&contact.rows[2][side * kAxes + 3]);
  return {contact.friction, squareSum(contact.target.data()), arms};
}

std::vector<Marks> marksOf(const ContactProblem& problem) {
  std::vector<Marks> marks(problem.free.size() / kAxes);
  for (std::size_t body = 0; body < marks.size(); ++body) {
    std::copy_n(&problem.inverseMass[body * kAxes], kAxes, marks[body].inverseMass.begin());
    const double* q = &problem.free[body * kAxes];
    marks[body].speeds = {squareSum(q), squareSum(q + 3)};
  }
  for (const ContactProblem::Contact& contact : problem.contacts) {
    const std::array<int, 2> sides{contact.a, contact.b};
    for (std::size_t side = 0; side < 2; ++side) {
      if (sides[side] != ContactProblem::kNobody) {
        marks[static_cast<std::size_t>(sides[side])].contacts.push_back(markOf(contact, side));
      }
    }
  }
  for (Marks& each : marks) {
    std::sort(each.contacts.begin(), each.contacts.end());
  }
  return marks;
}

/// Bodies from first to last where degree does not decide.
std::vector<std::size_t> preference(const ContactProblem& problem, const Graph& graph) {
  const Ranks ranks = refined(ranksOf(marksOf(problem)), graph);
  std::vector<std::size_t> order(ranks.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return ranks[i] < ranks[j]; });
  return order;
}

}  // namespace

std::vector<std::size_t> eliminationOrder(const ContactProblem& problem) {
  const Graph graph = graphOf(problem);
  const std::vector<std::size_t> preferred = preference(problem, graph);
  Ranks place(preferred.size());
  for (std::size_t k = 0; k < preferred.size(); ++k) {
    place[preferred[k]] = k;
  }
  std::vector<std::set<std::size_t>> neighbors(preferred.size());  // of what is left, by place
  for (std::size_t body = 0; body < graph.size(); ++body) {
    for (const std::size_t other : graph[body]) {
      neighbors[place[body]].insert(place[other]);
    }
  }
  std::set<std::pair<std::size_t, std::size_t>> next;  // degree, place
  for (std::size_t k = 0; k < neighbors.size(); ++k) {
    next.emplace(neighbors[k].size(), k);
  }
  std::vector<std::size_t> order;
  while (!next.empty()) {
    const std::size_t k = next.begin()->second;
    next.erase(next.begin());
    order.push_back(preferred[k]);
    for (const std::size_t other : neighbors[k]) {
      next.erase({neighbors[other].size(), other});
      neighbors[other].insert(neighbors[k].begin(), neighbors[k].end());
      neighbors[other].erase(k);
      neighbors[other].erase(other);
      next.emplace(neighbors[other].size(), other);
    }
  }
  return order;
}

}  // namespace careen
