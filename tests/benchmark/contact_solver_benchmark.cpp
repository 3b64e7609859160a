#include "physics/solver/contact_solver.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>

#include "physics/solver/contact_scene.h"

namespace {

using namespace careen;

/// Cold: without the impulses found before.
void solve(benchmark::State& state, const ContactScene& scene, bool warm) {
  ContactSolver solver;
  ContactSolution solution;
  solver.solve(scene.problem, solution);
  for (auto _ : state) {
    if (!warm) {
      solution.impulses.clear();
    }
    solver.solve(scene.problem, solution);
    benchmark::DoNotOptimize(solution.residual);
  }
  state.counters["factorisations"] = solution.factorisations;
  state.counters["contacts"] = static_cast<double>(scene.problem.contacts.size());
}

ContactScene oneContact() {
  ContactScene scene;
  scene.add(1, {0.5, 0.4, 0.3}, {0, 0, 0.7}, {0.4, 0.3, -1}, {0.1, 0.2, 0.3});
  scene.touch(0, ContactProblem::kNobody, {0.2, -0.3, 0}, 2, 1, 0.2);
  return scene;
}

/// All bricks of a standing wall at rest but for one that was hit.
ContactScene hitWall(int rows, int columns) {
  ContactScene scene = brickWall(rows, columns, 0.01, 0.6);
  scene.problem.free[static_cast<std::size_t>(rows / 2 * columns + columns / 2) * 6 + 1] = 3;
  return scene;
}

ContactScene sliding(ContactScene scene) {
  for (std::size_t k = 0; k < scene.problem.free.size(); k += 6) {
    scene.problem.free[k] = 3;
    scene.problem.free[k + 1] = -1;
  }
  return scene;
}

BENCHMARK_CAPTURE(solve, one_contact, oneContact(), false);
BENCHMARK_CAPTURE(solve, four_contacts, cubeStack(1, 1, 1, 0.5), false);
BENCHMARK_CAPTURE(solve, four_contacts_sliding, sliding(cubeStack(1, 1, 1, 0.2)), false);
BENCHMARK_CAPTURE(solve, four_contacts_warm, cubeStack(1, 1, 1, 0.5), true);
BENCHMARK_CAPTURE(solve, stack_10, cubeStack(10, 1, 1, 0.5), false);
BENCHMARK_CAPTURE(solve, stack_10_sliding, sliding(cubeStack(10, 1, 1, 0.2)), false);
BENCHMARK_CAPTURE(solve, wall_44, brickWall(4, 11, 0.01, 0.6), false);
BENCHMARK_CAPTURE(solve, wall_44_warm, brickWall(4, 11, 0.01, 0.6), true);
BENCHMARK_CAPTURE(solve, wall_44_hit, hitWall(4, 11), false);
BENCHMARK_CAPTURE(solve, wall_200, brickWall(10, 20, 0.01, 0.6), false);
BENCHMARK_CAPTURE(solve, wall_200_hit, hitWall(10, 20), false);

}  // namespace
