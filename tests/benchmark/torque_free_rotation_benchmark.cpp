// What one exact attitude and one set-up cost, in steps of the classical Runge–Kutta method on the same
// bodies.
//
// Read the ratios within one run (items per second against rungeKutta4Step): absolute times differ from
// machine to machine, the ratios hardly. The step is the bare method; rungeKutta4UnitStep also brings the
// quaternion back to unit length, which the exact attitude includes. Measured (g++ 12 -O3, AMD EPYC, medians
// of 15): attitude 1.18 and 0.87, set-up with both bounds 12.0 and 8.8, a body's moments, once, 1.4 and 1.04.

#include "physics/torque_free_rotation.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

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

struct State {
  double w, x, y, z;
  double m0, m1, m2;
};

inline State derivative(const State& s, const Vec3& inverse) {
  const double a = s.m0 * inverse[0];
  const double b = s.m1 * inverse[1];
  const double c = s.m2 * inverse[2];
  return {-0.5 * (s.x * a + s.y * b + s.z * c),
          0.5 * (s.w * a + s.y * c - s.z * b),
          0.5 * (s.w * b + s.z * a - s.x * c),
          0.5 * (s.w * c + s.x * b - s.y * a),
          s.m1 * c - s.m2 * b,
          s.m2 * a - s.m0 * c,
          s.m0 * b - s.m1 * a};
}

inline State moved(const State& s, const State& d, double h) {
  return {s.w + h * d.w,   s.x + h * d.x,   s.y + h * d.y,  s.z + h * d.z,
          s.m0 + h * d.m0, s.m1 + h * d.m1, s.m2 + h * d.m2};
}

State rungeKutta4(const State& s, const Vec3& inverse, double h) {
  const State k1 = derivative(s, inverse);
  const State k2 = derivative(moved(s, k1, 0.5 * h), inverse);
  const State k3 = derivative(moved(s, k2, 0.5 * h), inverse);
  const State k4 = derivative(moved(s, k3, h), inverse);
  return moved(moved(moved(moved(s, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
}

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
      states[i] = rungeKutta4(states[i], inverses[i], 1e-3);
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

/// With both bounds; what depends on the body alone is worked out once per body.
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
