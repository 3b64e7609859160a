// Cost of one step of each method, compared with the exact attitude and its set-up.
//
// Read the ratios within one run (items per second against exactAttitude): absolute times depend on the
// machine, the ratios hardly. Every body takes a run of 100 steps, so that the set-up of a run is shared as
// in use; a step is a twentieth of a radian. Accuracy per step differs more than cost: a method of order 10
// needs few steps.
//
// Measured (g++ 12 -O3, AMD EPYC), relative to an exact attitude: strang 0.72, runge-kutta-4 1.13,
// taylor-8 3.5, moser-veselov-10 1.8, Listing 1 1.9, the exact set-up 11.4; a step alone 2.9, 1.2, 5.5, 3.5.

#include <benchmark/benchmark.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "physics/attitude/free_methods.h"
#include "physics/attitude/torque_free_rotation.h"
#include "physics/motion/listing1.h"
#include "physics/world/method.h"

namespace careen {
namespace {

constexpr std::int64_t kSteps = 100;
constexpr double kAnglePerStep = 0.05;  // [rad]

struct FreeBody {
  Vec3 moments;
  FreeState<double> state;

  double timeStep() const { return kAnglePerStep / state.bodyMomentum.cwiseQuotient(moments).norm(); }
};

std::vector<FreeBody> makeBodies() {
  std::mt19937_64 random(1997);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
  };
  std::vector<FreeBody> bodies;
  for (int i = 0; i < 64; ++i) {
    const Vec3 size(uniform(0.1, 1), uniform(0.1, 1), uniform(0.1, 1));
    const Vec3 squares = size.cwiseProduct(size);
    const Quat attitude(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    bodies.push_back({Vec3(squares.y() + squares.z(), squares.x() + squares.z(), squares.x() + squares.y()),
                      {attitude.normalized(), Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1))}});
  }
  return bodies;
}

void countSteps(benchmark::State& state, std::size_t bodies, std::int64_t steps) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(bodies) * steps);
}

void step(benchmark::State& state, const FreeMethod& method) {
  std::vector<FreeBody> bodies = makeBodies();
  for (auto _ : state) {
    for (FreeBody& body : bodies) {
      method.steps(body.moments, body.state, body.timeStep(), kSteps);
    }
    benchmark::DoNotOptimize(bodies.data());
    benchmark::ClobberMemory();
  }
  countSteps(state, bodies.size(), kSteps);
}

/// One call per step, as where every step is inspected.
void lonelyStep(benchmark::State& state, const FreeMethod& method) {
  std::vector<FreeBody> bodies = makeBodies();
  for (auto _ : state) {
    for (FreeBody& body : bodies) {
      method.steps(body.moments, body.state, body.timeStep(), 1);
    }
    benchmark::DoNotOptimize(bodies.data());
    benchmark::ClobberMemory();
  }
  countSteps(state, bodies.size(), 1);
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const FreeMethod& method : freeMethods()) {
    const std::string name(traitsOf(method.method).name);
    benchmark::RegisterBenchmark(("freeStep/" + name).c_str(), step, method);
    benchmark::RegisterBenchmark(("freeStepAlone/" + name).c_str(), lonelyStep, method);
  }
  return true;
}();

void freeStepListing1(benchmark::State& state) {
  struct Falling {
    MassProperties mass;
    BodyState state;
    double dt;
  };
  std::vector<Falling> all;
  for (const FreeBody& body : makeBodies()) {
    Falling falling{};
    falling.dt = body.timeStep();
    falling.mass.inertiaBody = body.moments;
    falling.mass.inverseInertiaBody = body.moments.cwiseInverse();
    falling.state.pose.worldFromBody = body.state.worldFromBody.toRotationMatrix();
    falling.state.angularMomentum = body.state.angularMomentumWorld();
    all.push_back(falling);
  }
  for (auto _ : state) {
    for (Falling& falling : all) {
      for (std::int64_t i = 0; i < kSteps; ++i) {
        falling.state = listing1Step(falling.mass, falling.state, {}, falling.dt);
      }
    }
    benchmark::DoNotOptimize(all.data());
    benchmark::ClobberMemory();
  }
  countSteps(state, all.size(), kSteps);
}
BENCHMARK(freeStepListing1);

void exactAttitude(benchmark::State& state) {
  std::vector<TorqueFreeRotation<double>> flights;
  for (const FreeBody& body : makeBodies()) {
    flights.emplace_back(body.moments, body.state.worldFromBody, body.state.angularMomentumWorld());
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
  countSteps(state, flights.size(), 1);
}
BENCHMARK(exactAttitude);

void exactSetUp(benchmark::State& state) {
  const std::vector<FreeBody> bodies = makeBodies();
  for (auto _ : state) {
    for (const FreeBody& body : bodies) {
      TorqueFreeRotation<double> flight(body.moments, body.state.worldFromBody,
                                        body.state.angularMomentumWorld());
      benchmark::DoNotOptimize(flight);
    }
  }
  countSteps(state, bodies.size(), 1);
}
BENCHMARK(exactSetUp);

}  // namespace
}  // namespace careen
