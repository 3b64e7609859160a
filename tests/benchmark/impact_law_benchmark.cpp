#include "physics/impact/impact_law.h"

#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>

namespace {

using namespace careen;

/// A box in the corner of a room: `corners` of its corners on one wall, or all twelve contacts with three
/// walls.
void resolve(benchmark::State& state, std::size_t count, double restitution, double friction) {
  const Vec3 half(0.5, 0.3, 0.2);
  const MassProperties mass = solidBox(half, 2);
  BodyState before;
  before.velocity = Vec3(-1.5, -2.5, -3);
  before.angularMomentum = Vec3(0.01, 0.02, -0.03);
  std::array<ImpactContact, 12> contacts;
  std::array<ImpactShare, 12> shares;
  std::size_t next = 0;
  for (int axis = 2; axis >= 0; --axis) {
    for (int k = kCorners - 1; k >= 0; --k) {
      if (((k >> (2 - axis)) & 1) != 0) {
        contacts[next++] = {.a = 0,
                            .b = 1,
                            .armA = corner(half, k),
                            .armB = Vec3::Zero(),
                            .normal = Vec3(Vec3::Unit(axis)),
                            .material = {.restitution = restitution, .friction = friction}};
      }
    }
  }
  for (auto _ : state) {
    BodyState body = before;
    BodyState still;
    const std::array<ImpactBody, 2> bodies{{{&mass, &body}, {&bodyOfWalls().mass, &still}}};
    resolveImpact(bodies, std::span(contacts).first(count), std::span(shares).first(count));
    benchmark::DoNotOptimize(body);
  }
}

// What is not needed costs nothing: compare friction with no friction, and one contact with several.
BENCHMARK_CAPTURE(resolve, one_contact, 1, 0.8, 0.0);
BENCHMARK_CAPTURE(resolve, one_contact_friction, 1, 0.8, 0.3);
BENCHMARK_CAPTURE(resolve, four_contacts_elastic, 4, 1.0, 0.0);
BENCHMARK_CAPTURE(resolve, four_contacts, 4, 0.8, 0.0);
BENCHMARK_CAPTURE(resolve, four_contacts_friction, 4, 0.8, 0.3);
BENCHMARK_CAPTURE(resolve, twelve_contacts_elastic, 12, 1.0, 0.0);
BENCHMARK_CAPTURE(resolve, twelve_contacts, 12, 0.8, 0.0);
BENCHMARK_CAPTURE(resolve, twelve_contacts_friction, 12, 0.8, 0.3);

}  // namespace
