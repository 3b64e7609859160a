// Cost of pouring boxes into a pit, per frame of 1/60 s, and its growth with their number; compared with
// Bullet's double-precision library, as shipped, on the same scene (-DCAREEN_PEERS=ON). Compare within one
// run: --benchmark_enable_random_interleaving=true --benchmark_repetitions=5, minimum of each.
//
// Measured, 1000 boxes over 10 s, mean of four heaps that differ by rounding: 7.2 ms per frame, by two
// threads 5.3, Bullet (one thread) 10.5, in turns, in steps that no frame cuts short. Two thirds of that are
// the first 3 s, with boxes arriving at 20 m/s; parts sleep from 4.5 s on, all at 6 to 7 s but some tens in
// one heap of six. 8028 boxes over 3 s cost 18 times what 1000 do (of an earlier version): 12 times a step,
// and 1.4 times the steps, as the fastest of more boxes is faster and one that is deep makes all go back.
#include <benchmark/benchmark.h>

#include "support/crowd_run.h"
#include "support/pile_scenes.h"

#ifdef CAREEN_PEERS
#include <btBulletDynamicsCommon.h>

#include <cmath>

#include <memory>
#endif

namespace careen {
namespace {

constexpr double kFrame = 1.0 / 60;

// Arguments: boxes, seconds, boxes across a layer, threads.
World sceneOf(const benchmark::State& state) {
  return test::pouring(static_cast<int>(state.range(0)), 0.5, 0, 1, static_cast<int>(state.range(2)));
}

void perFrame(benchmark::State& state, std::int64_t frames) {
  state.counters["frame"] =
      benchmark::Counter(static_cast<double>(frames),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void pour(benchmark::State& state) {
  const World world = sceneOf(state);
  const std::int64_t frames = 60 * state.range(1);
  for (auto _ : state) {
    test::CrowdRun crowd(world, Crowd::kUsualTolerance, kFrame, static_cast<int>(state.range(3)));
    for (std::int64_t k = 0; k < frames; ++k) {
      crowd.step();
    }
    benchmark::DoNotOptimize(crowd.states().data());
  }
  perFrame(state, frames);
}
BENCHMARK(pour)
    ->Args({1000, 10, 6, 1})
    ->Args({1000, 10, 6, 2})
    ->Iterations(1)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
// Boxes still falling on each other; the same depth, so the same work per box.
BENCHMARK(pour)
    ->Args({250, 3, 3, 1})
    ->Args({1000, 3, 6, 1})
    ->Args({8028, 3, 17, 1})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// After all bodies sleep.
void settled(benchmark::State& state) {
  const World world = sceneOf(state);
  test::CrowdRun crowd(world);
  for (std::int64_t k = 0; k < 60 * state.range(1) && !crowd.atRest(); ++k) {
    crowd.step();
  }
  for (auto _ : state) {
    crowd.step();
  }
  state.counters["atRest"] = crowd.atRest() ? 1 : 0;
}
BENCHMARK(settled)->Args({200, 20, 6});

#ifdef CAREEN_PEERS
btVector3 toBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

class BulletPit {
 public:
  explicit BulletPit(const World& world) {
    world_.setGravity(toBullet(world.gravity));
    for (const Body& body : world.bodies) {
      add(std::make_unique<btBoxShape>(toBullet(body.halfExtents)), body);
    }
    for (const Wall& wall : world.walls) {
      add(std::make_unique<btStaticPlaneShape>(toBullet(wall.normal), wall.offset),
          {.name = wall.name, .mass = immovable(), .material = wall.material, .initial = {}});
    }
  }
  ~BulletPit() {
    for (const auto& object : objects_) {
      world_.removeRigidBody(object.get());
    }
  }
  BulletPit(const BulletPit&) = delete;
  BulletPit& operator=(const BulletPit&) = delete;

  void step(double h) { world_.stepSimulation(h, 0); }

 private:
  void add(std::unique_ptr<btCollisionShape> shape, const Body& body) {
    btRigidBody::btRigidBodyConstructionInfo info(body.mass.mass, nullptr, shape.get(),
                                                  toBullet(body.mass.inertiaBody));
    const Mat3& a = body.initial.pose.worldFromBody;
    info.m_startWorldTransform = btTransform(
        btMatrix3x3(a(0, 0), a(0, 1), a(0, 2), a(1, 0), a(1, 1), a(1, 2), a(2, 0), a(2, 1), a(2, 2)),
        toBullet(body.initial.pose.position));
    // Bullet multiplies the coefficients of two bodies; here all have the same.
    info.m_friction = std::sqrt(body.material.friction);
    objects_.push_back(std::make_unique<btRigidBody>(info));
    shapes_.push_back(std::move(shape));
    world_.addRigidBody(objects_.back().get());
  }

  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> objects_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

void pourBullet(benchmark::State& state) {
  const World world = sceneOf(state);
  const std::int64_t frames = 60 * state.range(1);
  for (auto _ : state) {
    BulletPit pit(world);
    for (std::int64_t k = 0; k < frames; ++k) {
      pit.step(kFrame);
    }
  }
  perFrame(state, frames);
}
BENCHMARK(pourBullet)->Args({1000, 10, 6})->Args({1000, 3, 6})->Iterations(1)->Unit(benchmark::kMillisecond);
#endif

}  // namespace
}  // namespace careen
