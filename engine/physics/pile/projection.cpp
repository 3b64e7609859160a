#include "physics/pile/projection.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "physics/pile/index.h"

namespace careen {
namespace {

constexpr double kTellPush =
    1.0 / 12;                      // [1] of the tolerance: smallest displacement that re-solves neighbours
constexpr double kLongest = 0.25;  // [1] of the smallest size: largest displacement per pass
constexpr int kLayersAtFirst = 3;
constexpr int kMostLayerDoublings = 4;
constexpr std::size_t kMostReached = 64;  // for each that penetrates; more only in the last layer
// Passes by Gauss–Seidel, the first with so many sweeps, the next with twice as many.
constexpr int kSweptPasses = 3;
constexpr int kSweepsAtFirst = 20;
constexpr int kGradients = 300;
constexpr double kEnough = 0.03;  // [1] of the tolerance: what gradients may leave
// Where bodies are held: of what was deep before the step, how much [1] may stay; and the gradients, which
// must come nearer to the solution, as what they leave adds up from step to step.
constexpr double kHeld = 0.95;
constexpr double kHoldingCompliance = 1e-4;
constexpr int kHoldingGradients = 1000;
constexpr double kNear = 0x1p-6;  // [1] of the smallest size: larger gaps are ignored

template <class Visit>
void forBodies(const PileManifold& manifold, const Visit& visit) {
  visit(manifold.a);
  visit(manifold.b);
}

}  // namespace

void PileProjection::begin(std::span<PileBody> bodies, std::span<PileManifold> manifolds,
                           std::span<const int> near, Refresh refresh, TakeBack takeBack) {
  bodies_ = bodies;
  manifolds_ = manifolds;
  near_ = near;
  refresh_ = std::move(refresh);
  takeBack_ = std::move(takeBack);
  seen_.assign(near.size(), {});
  firstOf_.clear();
  moved_.clear();
}

void PileProjection::lookAt(std::size_t n) {
  PileManifold& manifold = manifolds_[at(near_[n])];
  Seen& seen = seen_[n];
  refresh_(manifold, seen.everSeen ? Look::kAgain : Look::kFirst);
  double gap = manifold.length;
  for (int k = 0; k < manifold.count; ++k) {
    gap = std::min(gap, manifold.points[at(k)].gap);
  }
  seen = {.depth = std::max(0.0, -gap),
          .everSeen = true,
          .upToDate = true,
          .deep = gap < -tolerated(manifold.length),
          .close = gap < kNear * manifold.length};
}

void PileProjection::lookAtAll() {
  team_->share(near_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) {
      lookAt(n);
    }
  });
}

void PileProjection::lookAgain() {
  for (std::size_t n = 0; n < near_.size(); ++n) {
    if (seen_[n].everSeen) {
      lookAt(n);
    }
  }
}

double PileProjection::deepest() const {
  double deepest = 0;
  for (const Seen& seen : seen_) {
    deepest = std::max(deepest, seen.depth);
  }
  return deepest;
}

void PileProjection::listNearOfBodies() {
  firstOf_.assign(bodies_.size() + 1, 0);
  for (const int slot : near_) {
    forBodies(manifolds_[at(slot)], [&](int body) { ++firstOf_[at(body)]; });
  }
  std::size_t sum = 0;
  for (std::size_t& first : firstOf_) {
    sum += first;
    first = sum;  // the end: filled from there
  }
  nearOf_.resize(sum);
  for (std::size_t n = near_.size(); n-- > 0;) {
    forBodies(manifolds_[at(near_[n])], [&](int body) { nearOf_[--firstOf_[at(body)]] = n; });
  }
}

void PileProjection::reach(const PileManifold& manifold) {
  forBodies(manifold, [&](int body) {
    if (!bodies_[at(body)].still() && isReached_[at(body)] == 0) {
      isReached_[at(body)] = 1;
      reached_.push_back(body);
    }
  });
}

// Bodies of penetrating pairs, those in that many layers around them but for the last ones where they are
// many, and the manifolds of all of these. Who is held goes back, and so must all around it.
bool PileProjection::collect(int layers) {
  reached_.clear();
  isReached_.assign(bodies_.size(), 0);
  std::size_t deep = 0;
  for (std::size_t n = 0; n < near_.size(); ++n) {
    if (seen_[n].deep) {
      reach(manifolds_[at(near_[n])]);
      ++deep;
    }
  }
  if (deep == 0) {
    return false;
  }
  if (firstOf_.empty()) {
    listNearOfBodies();
  }
  isChosen_.assign(near_.size(), 0);
  std::size_t done = 0;
  bool isLast = false;
  for (int layer = 1; !isLast; ++layer) {
    isLast = layer == layers || (!holds() && reached_.size() > kMostReached * deep);
    for (const std::size_t end = reached_.size(); done < end; ++done) {
      const std::size_t body = at(reached_[done]);
      for (std::size_t k = firstOf_[body]; k < firstOf_[body + 1]; ++k) {
        const std::size_t n = nearOf_[k];
        if (!seen_[n].upToDate) {
          lookAt(n);
        }
        isChosen_[n] = 1;
        if (!isLast && seen_[n].close) {
          reach(manifolds_[at(near_[n])]);
        }
      }
    }
  }
  chosen_.clear();
  for (std::size_t n = 0; n < near_.size(); ++n) {
    if (isChosen_[n] != 0) {
      chosen_.push_back(n);
    }
  }
  std::sort(reached_.begin(), reached_.end());
  return true;
}

void PileProjection::solve(int number) {
  if (number < kSweptPasses && !holds()) {
    solver_.wakeAll();
    solver_.solve(kSweepsAtFirst << number, PileSolver::Friction::kNone);
    return;
  }
  gradients_.begin(bodies_.size(), holds() ? kHoldingCompliance : DisplacementSolver::kCompliance);
  for (const int body : reached_) {
    const Mat3 axes = bodies_[at(body)].principalAxes();
    gradients_.setBody(body, {.inverseMass = bodies_[at(body)].inverseMass,
                              .inverseInertia = axes * bodies_[at(body)].inverseInertiaBody.asDiagonal() *
                                                axes.transpose()});
  }
  for (std::size_t k = 0; k < solver_.rowCount(); ++k) {
    const PileSolver::RowView row = solver_.row(static_cast<int>(k));
    gradients_.add({.a = row.a,
                    .b = row.b,
                    .armA = row.armA,
                    .armB = row.armB,
                    .normal = row.axes[0],
                    .bound = row.bound});
  }
  gradients_.solve(kEnough * tolerance_, holds() ? kHoldingGradients : kGradients);
  for (const int body : reached_) {
    if (gradients_.moves(body)) {
      solver_.setPushed(body, gradients_.displacement(body), gradients_.turn(body));
    }
  }
}

bool PileProjection::pass(int number) {
  moved_.clear();
  farthest_ = 0;
  if (!collect(kLayersAtFirst << (holds() ? kMostLayerDoublings : std::min(number, kMostLayerDoublings)))) {
    return false;
  }
  fillSolver();
  solve(number);
  move();
  return true;
}

void PileProjection::fillSolver() {
  solver_.begin(bodies_.size());
  for (const int body : reached_) {
    solver_.setBody(body, bodies_[at(body)], kTellPush * tolerated(bodies_[at(body)].length));
  }
  for (const std::size_t n : chosen_) {
    const PileManifold& manifold = manifolds_[at(near_[n])];
    const Vec3 apart = bodies_[at(manifold.a)].position - bodies_[at(manifold.b)].position;
    const ContactFrame* begun = nullptr;
    std::optional<PileManifold> before;
    if (holds()) {
      takeBack_(before.emplace(manifold));
    }
    const double left = kLeft * tolerated(manifold.length);
    for (int k = 0; k < manifold.count; ++k) {
      const PilePoint& point = manifold.points[at(k)];
      if (point.gap < kNear * manifold.length) {
        const ContactFrame& frame = manifold.frameOf(k);
        if (begun != &frame) {
          solver_.beginBlock(manifold.a, manifold.b, 0, frame, apart);
          begun = &frame;
        }
        const double held = before ? -kHeld * before->points[at(k)].gap : 0;
        solver_.add({.arm = point.world, .bound = -(point.gap + std::max(left, held))});
      }
    }
  }
  solver_.link();
}

// And looks at what that changes.
void PileProjection::move() {
  for (const int body : reached_) {
    if (solver_.pushed(body)) {
      moveBody(body);
      moved_.push_back(body);
    }
  }
  for (const std::size_t n : chosen_) {
    PileManifold& manifold = manifolds_[at(near_[n])];
    forBodies(manifold, [&](int body) {
      if (isReached_[at(body)] != 0 && solver_.pushed(body)) {
        manifold.moved +=
            solver_.velocity(body).norm() + bodies_[at(body)].radius * solver_.omega(body).norm();
        seen_[n].upToDate = false;
      }
    });
  }
  team_->share(chosen_.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      if (!seen_[chosen_[k]].upToDate) {
        lookAt(chosen_[k]);
      }
    }
  });
}

void PileProjection::moveBody(int index) {
  PileBody& body = bodies_[at(index)];
  Vec3 shift = solver_.velocity(index);
  Vec3 turn = solver_.omega(index);
  const double far = shift.norm() + body.radius * turn.norm();
  const double most = kLongest * body.length;
  if (far > most) {
    shift *= most / far;
    turn *= most / far;
  }
  body.position += shift;
  turnBy(body, turn);
  body.path += std::min(far, most);
  farthest_ = std::max(farthest_, std::min(far, most));
  body.turned += body.radius * turn.norm();
}

}  // namespace careen
