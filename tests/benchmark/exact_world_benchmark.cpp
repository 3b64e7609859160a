// Cost of a run of method exact, and evidence that what a scene does not need costs nothing: compare within
// one run (--benchmark_enable_random_interleaving=true --benchmark_repetitions=9, minimum of each).
#include <benchmark/benchmark.h>

#include <string>

#include "physics/simulate.h"
#include "physics/world/method.h"
#include "support/exact_runs.h"
#include "support/tumbling_box.h"

namespace careen {
namespace {

class Deaf : public Recorder {
 public:
  void moves(BodyIndex /*body*/, double /*time*/, const Motion& /*motion*/) override {}
  void strikes(const Impact& /*impact*/) override { ++impacts; }
  std::size_t impacts = 0;
};

// Counts simulated seconds and impacts per second.
void run(benchmark::State& state, const World& world, const RunSettings& settings) {
  double seconds = 0;
  double impacts = 0;
  for (auto _ : state) {
    Deaf recorder;
    const RunFigures figures = simulate(world, settings, recorder);
    benchmark::DoNotOptimize(figures);
    seconds += settings.duration;
    impacts += static_cast<double>(recorder.impacts);
  }
  state.counters["simulated"] = benchmark::Counter(seconds, benchmark::Counter::kIsRate);
  state.counters["impacts"] = benchmark::Counter(impacts, benchmark::Counter::kIsRate);
}

// One box in a room, e = 1, for a minute: the same with both methods.
void elasticRoomByExact(benchmark::State& state) { run(state, elasticRoom(), {.duration = 60}); }
BENCHMARK(elasticRoomByExact);
void elasticRoomByListing1(benchmark::State& state) {
  run(state, elasticRoom(), {.method = Method::kListing1, .duration = 60, .dt = 1.0 / 240});
}
BENCHMARK(elasticRoomByListing1);

// Boxes without gravity, e = 1, as in assets/scenes/gas.json: a cube of n³ boxes, each with the same space.
// Measured per impact: 22 µs for 125 boxes, 32 for 1000, 54 for 8000, which no longer fit the cache.
void gas(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  test::Dice dice(100);
  World world;
  for (int axis = 0; axis < 3; ++axis) {
    world.walls.push_back(wall("low-" + std::to_string(axis), Vec3::Unit(axis), 0));
    world.walls.push_back(wall("high-" + std::to_string(axis), -Vec3::Unit(axis), -n));
  }
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 place(i % n + 0.5, i / n % n + 0.5, i / (n * n) + 0.5);
    const Vec3 velocity = dice.vector(2);
    const Vec3 spin = dice.vector(3);
    world.bodies.push_back(box("box-" + std::to_string(i), Vec3(0.15, 0.12, 0.1), 1, place, velocity, spin));
  }
  run(state, world, {.duration = 10});
}
BENCHMARK(gas)->Arg(5)->Arg(10)->Arg(20);

// One box between floor and ceiling, then one feature more at a time. Gravity and friction change the number
// of impacts: compare the time per impact. Measured relative to oneBox: gravity 1.06, friction 1.18, a
// second box far away or near 1.05.
World hop() {
  World world;
  world.walls = {wall("floor", Vec3(0, 0, 1), 0), wall("ceiling", Vec3(0, 0, -1), -6)};
  world.bodies = {box("crate", Vec3(0.5, 0.3, 0.2), 1, Vec3(0, 0, 3), Vec3(0.1, 0, -2), Vec3(1, 2, 3))};
  return world;
}
void oneBox(benchmark::State& state) { run(state, hop(), {.duration = 60}); }
BENCHMARK(oneBox);
void oneBoxUnderGravity(benchmark::State& state) {
  World world = hop();
  world.gravity = Vec3(0, 0, -1);
  run(state, world, {.duration = 60});
}
BENCHMARK(oneBoxUnderGravity);
void oneBoxWithFriction(benchmark::State& state) {
  World world = hop();
  world.bodies[0].material.friction = 0.3;
  for (Wall& each : world.walls) {
    each.material.friction = 0.3;
  }
  run(state, world, {.duration = 60});
}
BENCHMARK(oneBoxWithFriction);
void oneBoxAndOneFarAway(benchmark::State& state) {
  World world = hop();
  Body held = box("far", Vec3(0.5, 0.3, 0.2), 1, Vec3(500, 0, 3));
  held.mass = immovable();
  world.bodies.push_back(held);
  run(state, world, {.duration = 60});
}
BENCHMARK(oneBoxAndOneFarAway);
void oneBoxAndOneNear(benchmark::State& state) {
  World world = hop();
  Body held = box("near", Vec3(0.5, 0.3, 0.2), 1, Vec3(0, 1.5, 3));
  held.mass = immovable();
  world.bodies.push_back(held);
  run(state, world, {.duration = 60});
}
BENCHMARK(oneBoxAndOneNear);
// Bodies at rest cost nothing: a stack of cubes, far away, for a minute and for a hundred. Measured: five
// cost 0.12 ms and ten 0.3 ms at the start, when their contact forces are found; after that the impacts of
// the other box cost 1.2 and 1.4 times as much as alone, because its search for partners covers all bodies.
void oneBoxAndAStackAtRest(benchmark::State& state) {
  World world = hop();
  world.gravity = Vec3(0, 0, -1);
  for (int i = 0; i < state.range(0); ++i) {
    world.bodies.push_back(
        box("cube-" + std::to_string(i), Vec3::Constant(0.25), 1, Vec3(0, 500, 0.25 + 0.5 * i)));
    world.bodies.back().material = {.restitution = 0, .friction = 0.5};
  }
  run(state, world, {.duration = static_cast<double>(state.range(1))});
}
BENCHMARK(oneBoxAndAStackAtRest)->ArgsProduct({{0, 5, 10}, {60, 6000}});

}  // namespace
}  // namespace careen
