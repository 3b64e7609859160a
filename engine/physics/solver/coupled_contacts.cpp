#include "physics/solver/coupled_contacts.h"

#include <algorithm>
#include <cmath>

#include "core/math/order_free_sum.h"
#include "physics/solver/elimination_order.h"

namespace careen {

namespace {

using Row = ContactProblem::Row;
using Triple = ContactProblem::Triple;

/// Without order there is no sorting.
double numberOr0(double x) { return std::isfinite(x) ? x : 0; }

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

/// The contacts, in an order that does not follow the listing.
void CoupledContacts::copyContacts(const ContactProblem& problem) {
  const std::size_t count = problem.contacts.size();
  contacts_.resize(count);
  keys_.resize(count);
  for (std::size_t c = 0; c < count; ++c) {
    keys_[c] = keyOf(problem.contacts[c], c);
  }
  std::sort(keys_.begin(), keys_.end());
  scale_ = 0;
  noise_ = 0;
  for (std::size_t c = 0; c < count; ++c) {
    const ContactProblem::Contact& from = problem.contacts[keys_[c].listed];
    Contact& contact = contacts_[c];
    contact.a = placeOf(from.a);
    contact.b = placeOf(from.b);
    contact.rows = from.rows;
    contact.target = from.target;
    contact.blocks = blocks_[keys_[c].listed];
    const bool isLine = from.admissible == ContactProblem::Admissible::kCone && !(from.friction > 0);
    contact.kind = isLine ? ContactProblem::Admissible::kLine : from.admissible;
    contact.friction = contact.kind == ContactProblem::Admissible::kCone ? from.friction : 0;
    contact.least = from.least;
    contact.most = from.most;
    contact.drag = {};
    if (from.admissible == ContactProblem::Admissible::kLine) {
      contact.drag = {-from.friction * from.slip[0], -from.friction * from.slip[1]};
    }
    weigh(contact);
  }
  findTies();
}

int CoupledContacts::placeOf(int listed) const {
  return listed == kNobody ? kNobody : static_cast<int>(place_[static_cast<std::size_t>(listed)]);
}

/// Neither names nor mirroring change these numbers, and powers of two as units do not change their order.
CoupledContacts::Key CoupledContacts::keyOf(const ContactProblem::Contact& from, std::size_t listed) const {
  Triple u{};
  std::array<double, 2> squaredArm{};  // across the normal
  for (std::size_t side = 0; side < 2; ++side) {
    const int body = placeOf(side == 0 ? from.a : from.b);
    const double* turning = &from.rows[0][side * kAxes + 3];
    squaredArm[side] = turning[0] * turning[0] + (turning[1] * turning[1] + turning[2] * turning[2]);
    for (std::size_t row = 0; body != kNobody && row < 3; ++row) {
      u[row] += product(&from.rows[row][side * kAxes], &free_[static_cast<std::size_t>(body) * kAxes]);
    }
  }
  double normal = u[0] - from.target[0];
  const double x = u[1] - from.target[1];
  const double y = u[2] - from.target[2];
  if (!ContactProblem::hasNormal(from)) {
    normal *= normal;
  }
  return {.bodies = std::minmax(placeOf(from.a), placeOf(from.b)),
          .numbers = {numberOr0(from.friction + (from.most - from.least)), numberOr0(normal),
                      numberOr0(x * x + y * y), numberOr0(squaredArm[0] + squaredArm[1])},
          .listed = listed};
}

/// Effective masses, and what the contact adds to the scale of speeds and of their rounding errors.
void CoupledContacts::weigh(Contact& contact) {
  std::array<double, 2> normal{};  // by side, since which of both is a must not matter
  double largest = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    const int body = side == 0 ? contact.a : contact.b;
    for (std::size_t k = 0; body != kNobody && k < kAxes; ++k) {
      const std::size_t at = static_cast<std::size_t>(body) * kAxes + k;
      const std::size_t i = side * kAxes + k;
      const auto& [n, t, s] = contact.rows;
      normal[side] += inverseMass_[at] * (n[i] * n[i]);
      const double widest = std::max({std::fabs(n[i]), std::fabs(t[i]), std::fabs(s[i])});
      largest = std::max(largest, widest * std::fabs(free_[at]));
    }
  }
  contact.mass = 1 / (normal[0] + normal[1]);
  const Triple u = relativeVelocity(contact, free_);
  scale_ = std::max(scale_, std::sqrt(u[0] * u[0] + (u[1] * u[1] + u[2] * u[2])));
  if (contact.isGiven()) {  // which moves what is free to
    scale_ = std::max(scale_, std::fabs(contact.least) / contact.mass);
  }
  for (const double part : contact.target) {
    largest = std::max(largest, std::fabs(part));
  }
  noise_ = std::max(noise_, kNoise * largest);
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

double CoupledContacts::heaviest() const {
  double heaviest = 1;
  for (const Contact& contact : contacts_) {
    if (contact.a != kNobody && contact.b != kNobody) {
      const double ratio = mass_[static_cast<std::size_t>(contact.a) * kAxes] *
                           inverseMass_[static_cast<std::size_t>(contact.b) * kAxes];
      heaviest = std::max({heaviest, ratio, 1 / ratio});
    }
  }
  return heaviest;
}

double CoupledContacts::spread() const {
  double most = 0;
  for (std::size_t body = 0; body < bodies(); ++body) {
    most = std::max(most, mass_[body * kAxes]);
  }
  double least = most;
  for (const Contact& contact : contacts_) {
    least = std::min(least, contact.mass);
  }
  return least > 0 ? most / least : 1;
}

double CoupledContacts::largest(std::span<const Triple> impulses) const {
  double largest = 0;
  for (std::size_t c = 0; c < impulses.size(); ++c) {
    const Triple& impulse = impulses[c];
    const double size =
        contacts_[c].kind == Contact::Kind::kSpace || contacts_[c].kind == Contact::Kind::kInterval
            ? std::max({std::fabs(impulse[0]), std::fabs(impulse[1]), std::fabs(impulse[2])})
            : impulse[0];
    largest = std::max(largest, size / contacts_[c].mass);
  }
  return largest;
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

/// Jᵀ impulses.
template <class ImpulseOf>
void CoupledContacts::pushAll(const ImpulseOf& impulseOf, std::span<double> onto) const {
  std::fill(onto.begin(), onto.end(), 0.0);
  if (!hasTies_) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      push(contacts_[c], impulseOf(c), onto);
    }
    return;
  }
  std::vector<Six> terms;
  for (std::size_t body = 0; body < bodies(); ++body) {
    terms.clear();
    for (const auto& [c, side] : touches_[body]) {
      const auto& [n, t, s] = contacts_[c].rows;
      const Triple& impulse = impulseOf(c);
      Six& term = terms.emplace_back();
      for (std::size_t k = 0; k < kAxes; ++k) {
        const std::size_t i = side * kAxes + k;
        term[k] = n[i] * impulse[0] + (t[i] * impulse[1] + s[i] * impulse[2]);
      }
    }
    const Six sum = orderFreeSums<kAxes>(terms);
    std::copy(sum.begin(), sum.end(), &onto[body * kAxes]);
  }
}

void CoupledContacts::velocities(std::span<const Triple> impulses, std::span<double> q) const {
  pushAll([&](std::size_t c) -> const Triple& { return impulses[c]; }, q);
  for (std::size_t k = 0; k < q.size(); ++k) {
    q[k] = free_[k] + inverseMass_[k] * q[k];
  }
}

void CoupledContacts::add(const Contact& contact, const std::array<double, 9>& d) {
  const auto& [n, t, s] = contact.rows;
  const std::array<int, 2> sides{contact.a, contact.b};
  for (std::size_t to = 0; to < 2; ++to) {
    if (sides[to] == kNobody) {
      continue;
    }
    std::array<Six, 3> stiff;  // the columns `to` of D J
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < kAxes; ++k) {
        const std::size_t i = to * kAxes + k;
        stiff[row][k] = d[3 * row] * n[i] + d[3 * row + 1] * t[i] + d[3 * row + 2] * s[i];
      }
    }
    for (std::size_t from = 0; from < 2; ++from) {
      if (sides[from] == kNobody) {
        continue;
      }
      BlockLu::Block& block = matrix_.block(contact.blocks[2 * from + to]);
      for (std::size_t i = 0; i < kAxes; ++i) {
        const std::size_t k = from * kAxes + i;
        Six row;  // a copy, which cannot overlap with what is read
        for (std::size_t j = 0; j < kAxes; ++j) {
          row[j] = block[i * kAxes + j] + (n[k] * stiff[0][j] + t[k] * stiff[1][j] + s[k] * stiff[2][j]);
        }
        std::copy(row.begin(), row.end(), &block[i * kAxes]);
      }
    }
  }
}

/// The blocks of M + Σ Jᵀ stiffness J, each entry summed in no order.
void CoupledContacts::addWithoutOrder(std::span<const ContactAnswer> answers) {
  std::vector<Six> terms;
  for (auto part = parts_.begin(); part != parts_.end();) {
    const auto end = std::find_if(part, parts_.end(), [&](const Part& p) { return p.block != part->block; });
    BlockLu::Block& block = matrix_.block(part->block);
    for (std::size_t i = 0; i < kAxes; ++i) {
      terms.assign(1, {});
      std::copy_n(&block[i * kAxes], kAxes, terms.front().begin());
      for (auto p = part; p != end; ++p) {
        const auto& [n, t, s] = contacts_[p->contact].rows;
        const std::array<double, 9>& d = answers[p->contact].stiffness;
        if (d[0] == 0) {
          continue;
        }
        const std::size_t k = p->from * kAxes + i;
        const Triple row{n[k] * d[0] + (t[k] * d[3] + s[k] * d[6]), n[k] * d[1] + (t[k] * d[4] + s[k] * d[7]),
                         n[k] * d[2] + (t[k] * d[5] + s[k] * d[8])};
        Six& term = terms.emplace_back();
        for (std::size_t j = 0; j < kAxes; ++j) {
          const std::size_t l = p->to * kAxes + j;
          term[j] = row[0] * n[l] + (row[1] * t[l] + row[2] * s[l]);
        }
      }
      const Six sum = orderFreeSums<kAxes>(terms);
      std::copy(sum.begin(), sum.end(), &block[i * kAxes]);
    }
    part = end;
  }
}

/// Contacts that only their listing tells apart: mirror images of each other. Sums over them must not depend
/// on an order, or a scene that is its own image would not stay so.
void CoupledContacts::findTies() {
  hasTies_ = false;
  for (std::size_t c = 1; c < keys_.size(); ++c) {
    hasTies_ =
        hasTies_ || (keys_[c].bodies == keys_[c - 1].bodies && keys_[c].numbers == keys_[c - 1].numbers);
  }
  if (!hasTies_) {
    return;
  }
  touches_.assign(bodies(), {});
  parts_.clear();
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const std::array<int, 2> sides{contacts_[c].a, contacts_[c].b};
    for (std::size_t from = 0; from < 2; ++from) {
      if (sides[from] == kNobody) {
        continue;
      }
      touches_[static_cast<std::size_t>(sides[from])].push_back({c, from});
      for (std::size_t to = 0; to < 2; ++to) {
        if (sides[to] != kNobody) {
          parts_.push_back({contacts_[c].blocks[2 * from + to], c, from, to});
        }
      }
    }
  }
  std::stable_sort(parts_.begin(), parts_.end(),
                   [](const Part& x, const Part& y) { return x.block < y.block; });
}

bool CoupledContacts::factorise(std::span<const ContactAnswer> answers) {
  matrix_.setZero();
  for (std::size_t body = 0; body < bodies(); ++body) {
    BlockLu::Block& block = matrix_.block(matrix_.diagonal(body));
    for (std::size_t k = 0; k < kAxes; ++k) {
      block[k * kAxes + k] = mass_[body * kAxes + k];
    }
  }
  if (hasTies_) {
    addWithoutOrder(answers);
    return matrix_.factorise();
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
  pushAll([&](std::size_t c) -> const Triple& { return answers[c].given; }, dq);
  for (std::size_t k = 0; k < dq.size(); ++k) {
    dq[k] -= mass_[k] * (q[k] - free_[k]);
  }
  matrix_.solve(dq);
}

Triple CoupledContacts::answerTo(std::size_t c, const ContactAnswer& answer,
                                 std::span<const double> dq) const {
  if (answer.stiffness[0] == 0) {
    return answer.given;
  }
  const Triple du = change(contacts_[c], dq);
  Triple impulse = answer.given;
  for (std::size_t k = 0; k < impulse.size(); ++k) {
    const double* row = &answer.stiffness[3 * k];
    impulse[k] -= row[0] * du[0] + (row[1] * du[1] + row[2] * du[2]);
  }
  return impulse;
}

void CoupledContacts::importImpulses(std::span<const Triple> listed, std::span<Triple> impulses) const {
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    impulses[c] = listed[keys_[c].listed];
  }
}

void CoupledContacts::exportImpulses(std::span<const Triple> impulses, std::vector<Triple>& listed) const {
  listed.resize(contacts_.size());
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    listed[keys_[c].listed] = impulses[c];
  }
}

void CoupledContacts::exportVelocities(std::span<const double> q, std::vector<double>& listed) const {
  listed.resize(q.size());
  for (std::size_t body = 0; body < bodies(); ++body) {
    std::copy_n(&q[body * kAxes], kAxes, &listed[order_[body] * kAxes]);
  }
}

}  // namespace careen
