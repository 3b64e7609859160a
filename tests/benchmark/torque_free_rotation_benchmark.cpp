// Cost of one exact attitude and one set-up, in steps of the classical Runge–Kutta method on the same
// bodies.
//
// Read the ratios within one run (items per second against rungeKutta4UnitStep, the step of the study, which
// normalises the quaternion as the exact attitude does): absolute times depend on the machine, the ratios
// hardly. Measured (g++ 12 -O3, AMD EPYC, best of 15): attitude 1.12, set-up with both bounds 11.3; against
// the bare rungeKutta4Step 1.24 and 12.5.

#include "physics/attitude/torque_free_rotation.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "physics/attitude/runge_kutta4.h"

namespace careen {
namespace {

struct Body {
  Vec3 moments;
  Quat attitude;
  Vec3 momentum;
};

std::vector<Body> makeBodies() {
  std::mt19937_64 random(1997);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  std::vector<Body> bodies;
  for (int i = 0; i < 256; ++i) {
    const Vec3 size(uniform(0.1, 1), uniform(0.1, 1), uniform(0.1, 1));
    const Vec3 squares = size.cwiseProduct(size);
    bodies.push_back({Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y()),
                      Quat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized(),
                      Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))});
  }
  return bodies;
}

using State = detail::AttitudeAndMomentum<double>;

template <bool kUnit>
void stepAll(benchmark::State& state) {
  const std::vector<Body> bodies = makeBodies();
  std::vector<State> states;
  std::vector<Vec3> inverses;
  for (const Body& body : bodies) {
    const Vec3 m = body.attitude.conjugate() * body.momentum;
    states.push_back(
        {body.attitude.w(), body.attitude.x(), body.attitude.y(), body.attitude.z(), m.x(), m.y(), m.z()});
    inverses.push_back(body.moments.cwiseInverse());
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      states[i] = detail::rungeKutta4Step(states[i], inverses[i], 1e-3);
      if constexpr (kUnit) {
        State& s = states[i];
        const double inverseNorm = 1 / std::sqrt(s.w * s.w + s.x * s.x + s.y * s.y + s.z * s.z);
        s.w *= inverseNorm;
        s.x *= inverseNorm;
        s.y *= inverseNorm;
        s.z *= inverseNorm;
      }
    }
    benchmark::DoNotOptimize(states.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bodies.size()));
}

void rungeKutta4Step(benchmark::State& state) { stepAll<false>(state); }
void rungeKutta4UnitStep(benchmark::State& state) { stepAll<true>(state); }
BENCHMARK(rungeKutta4Step);
BENCHMARK(rungeKutta4UnitStep);

void oneAttitude(benchmark::State& state) {
  std::vector<TorqueFreeRotation<double>> flights;
  for (const Body& body : makeBodies()) {
    flights.emplace_back(body.moments, body.attitude, body.momentum);
  }
  std::vector<Quat> attitudes(flights.size());
  double t = 0;
  for (auto _ : state) {
    t += 0.01;
    for (std::size_t i = 0; i < flights.size(); ++i) {
      attitudes[i] = flights[i].worldFromBody(t);
    }
    benchmark::DoNotOptimize(attitudes.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(flights.size()));
}
BENCHMARK(oneAttitude);

/// With both bounds; what depends on the body alone is computed once per body.
void oneSetUp(benchmark::State& state) {
  const std::vector<Body> bodies = makeBodies();
  std::vector<PrincipalMoments<double>> moments;
  for (const Body& body : bodies) {
    moments.emplace_back(body.moments);
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      TorqueFreeRotation<double> flight(moments[i], bodies[i].attitude, bodies[i].momentum);
      benchmark::DoNotOptimize(flight);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bodies.size()));
}
BENCHMARK(oneSetUp);

void oneBodysMoments(benchmark::State& state) {
  const std::vector<Body> bodies = makeBodies();
  for (auto _ : state) {
    for (const Body& body : bodies) {
      PrincipalMoments<double> moments(body.moments);
      benchmark::DoNotOptimize(moments);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bodies.size()));
}
BENCHMARK(oneBodysMoments);

}  // namespace
}  // namespace careen
