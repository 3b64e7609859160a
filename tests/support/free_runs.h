#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "physics/attitude/free_step.h"
#include "support/free_bodies.h"
#include "support/quad.h"
#include "support/taylor_oracle.h"
#include "support/without_traps.h"

namespace careen {

template <class Real>
using FreeSteps = void (*)(const Vector3<Real>&, FreeState<Real>&, const Real&, std::int64_t);

/// A free body and its conserved quantities.
template <class Real>
struct FreeRun {
  Vector3<Real> moments;
  FreeState<Real> state;

  explicit FreeRun(const oracle::Start& start)
      : moments(start.moments.cast<Real>()), state{unit<Real>(start.attitude.cast<Real>()), {}} {
    state.bodyMomentum = state.worldFromBody.conjugate() * start.momentum.cast<Real>().eval();
  }
  Real energy() const { return state.bodyMomentum.cwiseQuotient(moments).dot(state.bodyMomentum) / 2; }
  Real length() const { return state.bodyMomentum.norm(); }
};

/// Relative changes between two times of a run.
struct FreeChange {
  double energy, length, world;

  template <class Real>
  FreeChange(const FreeRun<Real>& from, const FreeRun<Real>& to)
      : energy(static_cast<double>(to.energy() / from.energy() - 1)),
        length(static_cast<double>(to.length() / from.length() - 1)),
        world(static_cast<double>(
            (to.state.angularMomentumWorld() - from.state.angularMomentumWorld()).norm() / from.length())) {}
};

/// The box of the reference values: half sizes (0.1, 0.2, 0.3) m, 1 kg, ω = (1, 2, 3) rad/s.
inline oracle::Start tumblingStart(const Vec3& omega = {1, 2, 3}) {
  const Vec3 moments = Vec3(0.13, 0.1, 0.05) / 3;
  return {moments, Quat::Identity(), moments.cwiseProduct(omega)};
}

struct Orders {
  std::array<double, 3> attitude{};
  std::array<double, 3> energy{};
  double leastAttitudeError = 0;
};

/// Observed orders: halvings of the error per halving of the step, for three halvings, over five bodies
/// together that rotate by about 3 rad in `count`, 2 `count`, 4 `count`, 8 `count` steps. In quadruple
/// precision, so that high orders are not limited by rounding.
inline Orders observedOrders(FreeSteps<Quad> steps, std::int64_t count) {
  const WithoutTraps withoutTraps;  // the oracle's step size for a series that ends
  oracle::StartSource source(1);
  std::array<double, 4> attitude{};
  std::array<double, 4> energy{};
  for (int body = 0; body < 5; ++body) {
    const oracle::Start start = body == 0 ? tumblingStart() : source.draw(oracle::Draw::kGeneric);
    const Quad duration(3 / oracle::angularSpeedAtStart(start));
    oracle::FreeBody<Quad> truth = oracle::freeBody<Quad>(start);
    oracle::advance(truth, duration);
    for (std::size_t k = 0; k < attitude.size(); ++k) {
      const FreeRun<Quad> before(start);
      FreeRun<Quad> run(start);
      const std::int64_t number = count << k;
      steps(run.moments, run.state, duration / number, number);
      attitude.at(k) += oracle::angleBetween(truth, run.state.worldFromBody);
      energy.at(k) += std::fabs(FreeChange(before, run).energy);
    }
  }
  Orders orders;
  for (std::size_t k = 0; k < orders.attitude.size(); ++k) {
    orders.attitude.at(k) = std::log2(attitude.at(k) / attitude.at(k + 1));
    orders.energy.at(k) = std::log2(energy.at(k) / energy.at(k + 1));
    ::testing::Test::RecordProperty(
        "order" + std::to_string(k),
        std::to_string(orders.attitude.at(k)) + ", energy " + std::to_string(orders.energy.at(k)));
  }
  orders.leastAttitudeError = attitude.back();
  return orders;
}

}  // namespace careen
