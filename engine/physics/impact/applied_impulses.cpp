#include "physics/impact/applied_impulses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/math/order_free_sum.h"

namespace careen {

void applyImpulses(int index, const ImpactBody& body, std::span<const ImpactContact> contacts,
                   std::span<const ImpactShare> shares, std::span<const Vec3> impulses) {
  using Six = std::array<double, 6>;
  BodyState& state = *body.state;
  std::vector<Six> terms;
  terms.reserve(1 + 2 * contacts.size());
  const auto add = [&terms](const Vec3& linear, const Vec3& angular) {
    terms.push_back({linear[0], linear[1], linear[2], angular[0], angular[1], angular[2]});
  };
  add(state.velocity, state.angularMomentum);
  const bool turns = !body.mass->inverseInertiaBody.isZero(0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (const bool second : {false, true}) {
      if ((second ? contacts[c].b : contacts[c].a) != index) {
        continue;
      }
      if (contacts[c].rows) {
        const BodyImpulse sum = impulseOf(second ? contacts[c].rows->b : contacts[c].rows->a, shares[c].rows);
        add(body.mass->inverseMass * sum.push, turns ? sum.twist : Vec3(Vec3::Zero()));
      } else {
        const Vec3 impulse = second ? Vec3(-impulses[c]) : impulses[c];
        const Vec3& arm = second ? contacts[c].armB : contacts[c].armA;
        add(body.mass->inverseMass * impulse, turns ? arm.cross(impulse) : Vec3(Vec3::Zero()));
      }
    }
  }
  Six sums = orderFreeSums<6>(terms);
  for (std::size_t k = 0; k < 6; ++k) {
    double largest = 0;
    for (const Six& term : terms) {
      largest = std::max(largest, std::fabs(term[k]));
    }
    sums[k] = std::fabs(sums[k]) <= 0x1p-49 * largest ? 0 : sums[k];
  }
  state.velocity = Vec3(sums[0], sums[1], sums[2]);
  state.angularMomentum = Vec3(sums[3], sums[4], sums[5]);
}

}  // namespace careen
