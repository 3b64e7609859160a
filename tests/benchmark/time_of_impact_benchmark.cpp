#include <benchmark/benchmark.h>

#include <vector>

#include "support/tumbling_box.h"

namespace careen::test {
namespace {

constexpr double kRoom = 3;

std::vector<TumblingBox> flights(int count) {
  Dice dice(7);
  std::vector<TumblingBox> boxes;
  for (int i = 0; i < count; ++i) {
    TumblingBox box = tumblingBox(dice, {0.5, 0.3, 0.2}, 5, 5);
    box.position = dice.vector(2);
    box.gravity = {0, 0, -9.81};
    boxes.push_back(box);
  }
  return boxes;
}

void attitude(benchmark::State& state) {
  const std::vector<TumblingBox> boxes = flights(256);
  std::size_t k = 0;
  double t = 0;
  for ([[maybe_unused]] auto step : state) {
    benchmark::DoNotOptimize(boxes[k++ % boxes.size()](t += 1e-6));
  }
}
BENCHMARK(attitude);

// Next impact of a box in a room of six walls.
void nextImpact(benchmark::State& state, const std::vector<TumblingBox>& boxes) {
  std::size_t k = 0;
  double evaluations = 0;
  for ([[maybe_unused]] auto step : state) {
    const MovingBox box = boxes[k++ % boxes.size()].moving();
    double until = 10;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        const FirstContact contact =
            firstContactWithWall(box, side * Vec3::Unit(axis), -kRoom, {.from = 0, .until = until});
        evaluations += contact.evaluations;
        until = contact.time;
      }
    }
    benchmark::DoNotOptimize(until);
  }
  state.counters["evaluations"] = benchmark::Counter(evaluations, benchmark::Counter::kAvgIterations);
}

void boxInRoom(benchmark::State& state) { nextImpact(state, flights(256)); }
BENCHMARK(boxInRoom);

// The same after a bounce: one corner of the box has just left the floor.
void bounceInRoom(benchmark::State& state) {
  std::vector<TumblingBox> boxes = flights(256);
  for (TumblingBox& box : boxes) {
    box.velocity.z() = 5;
    box.position.z() -= gapToPlane({box.moving().poseAt(0), box.halfExtents}, Vec3::UnitZ(), -kRoom);
  }
  nextImpact(state, boxes);
}
BENCHMARK(bounceInRoom);

// One wall, with an impact.
void boxOnWall(benchmark::State& state) {
  const std::vector<TumblingBox> boxes = flights(256);
  std::size_t k = 0;
  double evaluations = 0;
  for ([[maybe_unused]] auto step : state) {
    const MovingBox box = boxes[k++ % boxes.size()].moving();
    const FirstContact contact = firstContactWithWall(box, Vec3::UnitZ(), -kRoom, {.from = 0, .until = 10});
    evaluations += contact.evaluations;
    benchmark::DoNotOptimize(contact.time);
  }
  state.counters["evaluations"] = benchmark::Counter(evaluations, benchmark::Counter::kAvgIterations);
}
BENCHMARK(boxOnWall);

// Two boxes under the same gravity that collide after about a second.
void boxOnBox(benchmark::State& state) {
  const std::vector<TumblingBox> boxes = flights(256);
  std::vector<TumblingBox> others = flights(512);
  others.erase(others.begin(), others.begin() + 256);
  for (std::size_t i = 0; i < others.size(); ++i) {
    Dice dice(i);
    // Aimed to pass within half a metre after about a second.
    others[i].position = boxes[i].position + 4 * dice.direction();
    others[i].velocity = boxes[i].velocity + (boxes[i].position - others[i].position) + dice.vector(0.5);
  }
  std::size_t k = 0;
  double evaluations = 0;
  double impacts = 0;
  for ([[maybe_unused]] auto step : state) {
    const FirstContact contact =
        firstContactOfBoxes(boxes[k].moving(), others[k].moving(), {.from = 0, .until = 10});
    k = (k + 1) % boxes.size();
    evaluations += contact.evaluations;
    impacts += contact.kind == ContactKind::kImpact ? 1 : 0;
    benchmark::DoNotOptimize(contact.time);
  }
  state.counters["evaluations"] = benchmark::Counter(evaluations, benchmark::Counter::kAvgIterations);
  state.counters["impacts"] = benchmark::Counter(impacts, benchmark::Counter::kAvgIterations);
}
BENCHMARK(boxOnBox);

// Two boxes that never come near each other.
void boxFarFromBox(benchmark::State& state) {
  const std::vector<TumblingBox> boxes = flights(256);
  std::size_t k = 0;
  for ([[maybe_unused]] auto step : state) {
    MovingBox other = boxes[(k + 1) % boxes.size()].moving();
    other.position += Vec3(100, 0, 0);
    benchmark::DoNotOptimize(firstContactOfBoxes(boxes[k].moving(), other, {.from = 0, .until = 1}));
    k = (k + 1) % boxes.size();
  }
}
BENCHMARK(boxFarFromBox);

}  // namespace
}  // namespace careen::test
