#include "physics/pile/projection.h"

#include <algorithm>
#include <cmath>

#include "physics/pile/index.h"

namespace careen {
namespace {

constexpr double kLeft = 1.0 / 3;  // [1] of the tolerance: penetration kept, so that contacts persist
constexpr double kTellPush =
    1.0 / 12;                      // [1] of the tolerance: smallest displacement that re-solves neighbours
constexpr double kLongest = 0.25;  // [1] of the smallest size: largest displacement per pass
constexpr int kLayersAtFirst = 3;
constexpr int kMostLayerDoublings = 4;
// Passes by Gauss–Seidel, the first with so many sweeps, the next with twice as many.
constexpr int kSweptPasses = 2;
constexpr int kSweepsAtFirst = 20;
constexpr int kGradients = 300;
constexpr double kEnough = 0.03;  // [1] of the tolerance: what gradients may leave
constexpr double kNear = 0x1p-6;  // [1] of the smallest size: larger gaps are ignored

double lowestGap(const PileManifold& manifold) {
  double gap = manifold.length;
  for (int k = 0; k < manifold.count; ++k) {
    gap = std::min(gap, manifold.points[at(k)].gap);
  }
  return gap;
}

template <class Visit>
void forBodies(const PileManifold& manifold, const Visit& visit) {
  visit(manifold.a);
  if (!manifold.b.isWall()) {
    visit(manifold.b.body());
  }
}

}  // namespace

// reached_: 1 for bodies of penetrating pairs, one more for each layer around them.
bool PileProjection::collect(std::span<const PileBody> bodies, std::span<PileManifold> manifolds,
                             std::span<const int> near, int layers) {
  reached_.assign(bodies.size(), 0);
  const auto mark = [&](const PileManifold& manifold, int layer) {
    forBodies(manifold, [&](int body) {
      if (!bodies[at(body)].still() && reached_[at(body)] == 0) {
        reached_[at(body)] = static_cast<char>(layer);
      }
    });
  };
  const auto isIn = [&](const PileManifold& manifold, int layer) {
    bool found = false;
    forBodies(manifold, [&](int body) { found = found || reached_[at(body)] == layer; });
    return found;
  };
  bool any = false;
  for (const int slot : near) {
    const PileManifold& manifold = manifolds[at(slot)];
    if (lowestGap(manifold) < -tolerated(manifold.length)) {
      mark(manifold, 1);
      any = true;
    }
  }
  if (!any) {
    return false;
  }
  chosen_.clear();
  for (int layer = 1; layer <= layers; ++layer) {
    for (const int slot : near) {
      const PileManifold& manifold = manifolds[at(slot)];
      const bool touches = isIn(manifold, layer);
      if (touches && layer < layers && lowestGap(manifold) < kNear * manifold.length) {
        mark(manifold, layer + 1);
      }
    }
  }
  for (const int slot : near) {
    bool reached = false;
    forBodies(manifolds[at(slot)], [&](int body) { reached = reached || reached_[at(body)] != 0; });
    if (reached) {
      chosen_.push_back(slot);
    }
  }
  return true;
}

void PileProjection::solve(std::span<const PileBody> bodies, int number) {
  if (number < kSweptPasses) {
    solver_.wakeAll();
    solver_.solve(kSweepsAtFirst << number, false);
    return;
  }
  const auto mover = [&](int body) {
    return at(body) < bodies.size() && reached_[at(body)] != 0 ? body : DisplacementSolver::kNobody;
  };
  gradients_.begin(bodies);
  for (std::size_t k = 0; k < solver_.rowCount(); ++k) {
    const PileSolver::RowView row = solver_.row(static_cast<int>(k));
    gradients_.add({.a = mover(row.a),
                    .b = mover(row.b),
                    .armA = row.armA,
                    .armB = row.armB,
                    .normal = row.directions[0],
                    .bound = row.bound});
  }
  gradients_.solve(kEnough * tolerance_, kGradients);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int body = static_cast<int>(i);
    if (gradients_.moves(body)) {
      solver_.setPushed(body, gradients_.displacement(body), gradients_.turn(body));
    }
  }
}

bool PileProjection::pass(std::span<PileBody> bodies, std::span<PileManifold> manifolds,
                          std::span<const int> near, int number) {
  moved_.assign(bodies.size(), 0);
  farthest_ = 0;
  if (!collect(bodies, manifolds, near, kLayersAtFirst << std::min(number, kMostLayerDoublings))) {
    return false;
  }
  solver_.begin(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (reached_[i] != 0) {
      solver_.setBody(static_cast<int>(i), bodies[i], kTellPush * tolerated(bodies[i].length));
    }
  }
  for (const int slot : chosen_) {
    const PileManifold& manifold = manifolds[at(slot)];
    const Vec3 apart = manifold.b.isWall()
                           ? Vec3::Zero()
                           : Vec3(bodies[at(manifold.a)].position - bodies[at(manifold.b.body())].position);
    const PileFrame* begun = nullptr;
    const double left = kLeft * tolerated(manifold.length);
    for (int k = 0; k < manifold.count; ++k) {
      const PilePoint& point = manifold.points[at(k)];
      if (point.gap < kNear * manifold.length) {
        const PileFrame& frame = manifold.frameOf(k);
        if (begun != &frame) {
          solver_.beginBlock(manifold.a, manifold.b, 0, frame, apart);
          begun = &frame;
        }
        solver_.add({.arm = point.world, .bound = -(point.gap + left)});
      }
    }
  }
  solver_.link();
  solve(bodies, number);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int index = static_cast<int>(i);
    if (reached_[i] == 0 || !solver_.pushed(index)) {
      continue;
    }
    PileBody& body = bodies[i];
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
    moved_[i] = 1;
  }
  for (const int slot : near) {
    PileManifold& manifold = manifolds[at(slot)];
    forBodies(manifold, [&](int body) {
      if (moved_[at(body)] != 0) {
        manifold.moved +=
            solver_.velocity(body).norm() + bodies[at(body)].radius * solver_.omega(body).norm();
      }
    });
  }
  return true;
}

}  // namespace careen
