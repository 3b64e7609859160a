#include "physics/solver/coupled_contacts.h"

#include <algorithm>
#include <cmath>

#include "physics/solver/elimination_order.h"

namespace careen {

namespace {

constexpr double kRounding = 0x1p-52;

using Row = ContactProblem::Row;
using Triple = ContactProblem::Triple;

double product(const double* row, const double* part) {
  double sum = 0;
  for (std::size_t k = 0; k < ContactProblem::kAxes; ++k) {
    sum += row[k] * part[k];
  }
  return sum;
}

}  // namespace

bool CoupledContacts::hasGraphOf(const ContactProblem& problem) const {
  if (order_.size() * kAxes != problem.free.size() || graph_.size() != problem.contacts.size()) {
    return false;
  }
  for (std::size_t c = 0; c < graph_.size(); ++c) {
    if (graph_[c][0] != problem.contacts[c].a || graph_[c][1] != problem.contacts[c].b) {
      return false;
    }
  }
  return true;
}

void CoupledContacts::order(const ContactProblem& problem) {
  graph_.clear();
  for (const ContactProblem::Contact& contact : problem.contacts) {
    graph_.push_back({contact.a, contact.b});
  }
  order_ = eliminationOrder(problem);
  place_.resize(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) {
    place_[order_[k]] = k;
  }
  const auto placeOf = [&](int body) { return static_cast<int>(place_[static_cast<std::size_t>(body)]); };
  std::vector<std::pair<int, int>> edges;
  for (const auto& [a, b] : graph_) {
    if (a != kNobody && b != kNobody) {
      edges.emplace_back(placeOf(a), placeOf(b));
    }
  }
  matrix_.setPattern(order_.size(), edges);
  blocks_.assign(graph_.size(), {});
  for (std::size_t c = 0; c < graph_.size(); ++c) {
    for (std::size_t row = 0; row < 2; ++row) {
      for (std::size_t column = 0; column < 2; ++column) {
        if (graph_[c][row] != kNobody && graph_[c][column] != kNobody) {
          blocks_[c][2 * row + column] = matrix_.find(placeOf(graph_[c][row]), placeOf(graph_[c][column]));
        }
      }
    }
  }
}

void CoupledContacts::set(const ContactProblem& problem) {
  if (!hasGraphOf(problem)) {
    order(problem);
  }
  const std::size_t axes = problem.free.size();
  mass_.resize(axes);
  inverseMass_.resize(axes);
  free_.resize(axes);
  for (std::size_t body = 0; body < order_.size(); ++body) {
    for (std::size_t k = 0; k < kAxes; ++k) {
      const std::size_t from = order_[body] * kAxes + k;
      inverseMass_[body * kAxes + k] = problem.inverseMass[from];
      mass_[body * kAxes + k] = 1 / problem.inverseMass[from];
      free_[body * kAxes + k] = problem.free[from];
    }
  }
  copyContacts(problem);
}

void CoupledContacts::copyContacts(const ContactProblem& problem) {
  contacts_.resize(problem.contacts.size());
  listed_.resize(contacts_.size());
  scale_ = 0;
  noise_ = 0;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const ContactProblem::Contact& from = problem.contacts[c];
    Contact& contact = contacts_[c];
    listed_[c] = c;
    contact.a = from.a == kNobody ? kNobody : static_cast<int>(place_[static_cast<std::size_t>(from.a)]);
    contact.b = from.b == kNobody ? kNobody : static_cast<int>(place_[static_cast<std::size_t>(from.b)]);
    contact.rows = from.rows;
    contact.target = from.target;
    contact.blocks = blocks_[c];
    contact.onLine = from.slips || !(from.friction > 0);
    contact.friction = contact.onLine ? 0 : from.friction;
    contact.drag = from.slips ? std::array<double, 2>{-from.friction * from.slip[0], -from.friction * from.slip[1]}
                              : std::array<double, 2>{};
    double inverse = 0;
    double noise = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      const int body = side == 0 ? contact.a : contact.b;
      for (std::size_t k = 0; body != kNobody && k < kAxes; ++k) {
        const std::size_t at = static_cast<std::size_t>(body) * kAxes + k;
        const double n = contact.rows[0][side * kAxes + k];
        inverse += inverseMass_[at] * (n * n);
        for (std::size_t row = 0; row < 3; ++row) {
          noise = std::max(noise, std::fabs(contact.rows[row][side * kAxes + k] * free_[at]));
        }
      }
    }
    contact.mass = 1 / inverse;
    const Triple u = relativeVelocity(contact, free_);
    scale_ = std::max(scale_, std::sqrt(u[0] * u[0] + (u[1] * u[1] + u[2] * u[2])));
    for (const double part : contact.target) {
      noise = std::max(noise, std::fabs(part));
    }
    noise_ = std::max(noise_, 4 * kRounding * noise);
  }
}

Triple CoupledContacts::change(const Contact& contact, std::span<const double> dq) const {
  Triple sums{};
  if (contact.a != kNobody) {
    const double* part = &dq[static_cast<std::size_t>(contact.a) * kAxes];
    for (std::size_t row = 0; row < 3; ++row) {
      sums[row] = product(contact.rows[row].data(), part);
    }
  }
  if (contact.b != kNobody) {
    const double* part = &dq[static_cast<std::size_t>(contact.b) * kAxes];
    for (std::size_t row = 0; row < 3; ++row) {
      sums[row] += product(contact.rows[row].data() + kAxes, part);
    }
  }
  return sums;
}

Triple CoupledContacts::relativeVelocity(const Contact& contact, std::span<const double> q) const {
  Triple u = change(contact, q);
  for (std::size_t row = 0; row < 3; ++row) {
    u[row] -= contact.target[row];
  }
  return u;
}

void CoupledContacts::relativeVelocities(std::span<const double> q, std::span<Triple> u) const {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    u[c] = relativeVelocity(contacts_[c], q);
  }
}

void CoupledContacts::push(const Contact& contact, const Triple& impulse, std::span<double> onto) const {
  const auto& [n, t, s] = contact.rows;
  for (std::size_t side = 0; side < 2; ++side) {
    const int body = side == 0 ? contact.a : contact.b;
    if (body == kNobody) {
      continue;
    }
    double* part = &onto[static_cast<std::size_t>(body) * kAxes];
    for (std::size_t k = 0; k < kAxes; ++k) {
      const std::size_t i = side * kAxes + k;
      part[k] += n[i] * impulse[0] + t[i] * impulse[1] + s[i] * impulse[2];
    }
  }
}

void CoupledContacts::velocities(std::span<const Triple> impulses, std::span<double> q) const {
  std::fill(q.begin(), q.end(), 0.0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    push(contacts_[c], impulses[c], q);
  }
  for (std::size_t k = 0; k < q.size(); ++k) {
    q[k] = free_[k] + inverseMass_[k] * q[k];
  }
}

void CoupledContacts::add(const Contact& contact, const std::array<double, 9>& d) {
  const auto& [n, t, s] = contact.rows;
  std::array<Row, 3> stiff;  // D J
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 2 * kAxes; ++k) {
      stiff[row][k] = d[3 * row] * n[k] + d[3 * row + 1] * t[k] + d[3 * row + 2] * s[k];
    }
  }
  const std::array<int, 2> sides{contact.a, contact.b};
  for (std::size_t from = 0; from < 2; ++from) {
    for (std::size_t to = 0; to < 2; ++to) {
      if (sides[from] == kNobody || sides[to] == kNobody) {
        continue;
      }
      BlockLu::Block& block = matrix_.block(contact.blocks[2 * from + to]);
      for (std::size_t i = 0; i < kAxes; ++i) {
        const std::size_t k = from * kAxes + i;
        for (std::size_t j = 0; j < kAxes; ++j) {
          const std::size_t l = to * kAxes + j;
          block[i * kAxes + j] += n[k] * stiff[0][l] + t[k] * stiff[1][l] + s[k] * stiff[2][l];
        }
      }
    }
  }
}

bool CoupledContacts::factorise(std::span<const ContactAnswer> answers) {
  matrix_.setZero();
  for (std::size_t body = 0; body < bodies(); ++body) {
    BlockLu::Block& block = matrix_.block(matrix_.find(static_cast<int>(body), static_cast<int>(body)));
    for (std::size_t k = 0; k < kAxes; ++k) {
      block[k * kAxes + k] = mass_[body * kAxes + k];
    }
  }
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (answers[c].stiffness[0] != 0) {
      add(contacts_[c], answers[c].stiffness);
    }
  }
  return matrix_.factorise();
}

void CoupledContacts::step(std::span<const ContactAnswer> answers, std::span<const double> q,
                           std::span<double> dq) const {
  std::fill(dq.begin(), dq.end(), 0.0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    push(contacts_[c], answers[c].given, dq);
  }
  for (std::size_t k = 0; k < dq.size(); ++k) {
    dq[k] -= mass_[k] * (q[k] - free_[k]);
  }
  matrix_.solve(dq);
}

void CoupledContacts::importImpulses(std::span<const Triple> listed, std::span<Triple> impulses) const {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    impulses[c] = listed[listed_[c]];
  }
}

void CoupledContacts::exportImpulses(std::span<const Triple> impulses, std::vector<Triple>& listed) const {
  listed.resize(contacts_.size());
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    listed[listed_[c]] = impulses[c];
  }
}

void CoupledContacts::exportVelocities(std::span<const double> q, std::vector<double>& listed) const {
  listed.resize(q.size());
  for (std::size_t body = 0; body < bodies(); ++body) {
    std::copy_n(&q[body * kAxes], kAxes, &listed[order_[body] * kAxes]);
  }
}

}  // namespace careen
