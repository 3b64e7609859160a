#include "physics/pile/lane_sweep.h"

namespace careen {

void LaneSweep::begin(const BlockGroups& groups) {
  changes_.assign(groups.bodyCount(), 0);
  seen_.assign(groups.groups().size() * kLanes, 0);
}

std::int64_t LaneSweep::run(Kind kind, int most, LaneRows& rows, std::span<Moving> moving, double change) {
  const Swept swept{.groups = rows.groups().groups(),
                    .blocks = rows.blocks(),
                    .rows = rows.rows(),
                    .shifts = rows.shifts(),
                    .moving = moving,
                    .change = change};
  return kind == Kind::kFriction       ? runKind<Kind::kFriction>(most, rows, swept)
         : kind == Kind::kFrictionless ? runKind<Kind::kFrictionless>(most, rows, swept)
                                       : runKind<Kind::kShift>(most, rows, swept);
}

template <LaneSweep::Kind kKind>
std::int64_t LaneSweep::runKind(int most, LaneRows& rows, const Swept& swept) {
  return rows.groups().sweep(most, [&](std::size_t, std::size_t first, std::size_t last) {
    std::int64_t solved = 0;
    runInLanes(
        [&]() __attribute__((always_inline)) { solved = sweepGroups<kKind>(swept, first, last); },
        rows.registers());
    return solved;
  });
}

CAREEN_LANES LaneCounts LaneSweep::changesOf(const LaneBodies& bodies) const {
  return LaneCounts{changes_[at(bodies[0])], changes_[at(bodies[1])], changes_[at(bodies[2])],
                    changes_[at(bodies[3])]};
}

// Blocks put on the list ahead of the present group are solved in this sweep, the others in the next.
template <LaneSweep::Kind kKind>
CAREEN_LANES std::int64_t LaneSweep::sweepGroups(const Swept& swept, std::size_t first, std::size_t last) {
  std::int64_t solved = 0;
  for (std::size_t index = first; index < last; ++index) {
    const BlockGroups::Group& group = swept.groups[index];
    const LaneCounts changes = changesOf(group.a) + changesOf(group.b);
    std::uint32_t* const seen = &seen_[index * kLanes];
    const LaneMask asked = maskOf(changes != countsFrom(seen));
    if (any(asked)) {
      countsTo(changes, seen);
      solved -= sumOf(asked);
      solveGroup<kKind>(swept, index, asked);
    }
  }
  return solved;
}

template <LaneSweep::Kind kKind>
CAREEN_LANES void LaneSweep::solveGroup(const Swept& swept, std::size_t index, const LaneMask& asked) {
  const BlockGroups::Group& group = swept.groups[index];
  const LaneBlock& block = swept.blocks[index];
  const MovingLanes fromA = movingOf(swept.moving, group.a);
  const MovingLanes fromB = movingOf(swept.moving, group.b);
  MovingLanes a = fromA;
  MovingLanes b = fromB;
  LaneMask changed{};
  for (int k = group.first; k < group.first + group.count; ++k) {
    LaneRow& row = swept.rows[at(k)];
    const LanesVec armB = row.arm + block.apart;
    const LanesVec u = (a.v + cross(a.w, row.arm)) - (b.v + cross(b.w, armB));
    Lanes& sum = kKind == Kind::kShift ? swept.shifts[at(k)].impulse : row.normalImpulse;
    const Lanes& bound = kKind == Kind::kShift ? swept.shifts[at(k)].bound : row.bound;
    const Lanes before = sum;
    const Lanes wanted = before - row.relaxedMass * (dot(block.normal, u) - bound);
    const Lanes normal = asked ? (wanted > 0 ? wanted : Lanes{}) : before;
    const Lanes change = normal - before;
    const LaneMask acts = (normal != 0) | (before != 0);
    if (!any(acts)) {
      continue;  // most rows are open
    }
    changed |= asked & acts;
    sum = normal;
    LanesVec impulse = change * block.normal;
    if constexpr (kKind == Kind::kFriction) {
      const Lanes u1 = dot(block.tangent1, u) + row.normalToTangent1 * change;
      const Lanes u2 = dot(block.tangent2, u) + row.normalToTangent2 * change;
      const Lanes limit = block.friction * normal;
      const Lanes square = limit * limit;
      Lanes p1 = row.tangential1 - (row.stop11 * u1 + row.stop12 * u2);
      Lanes p2 = row.tangential2 - (row.stop12 * u1 + row.stop22 * u2);
      const LaneMask slides = p1 * p1 + p2 * p2 > square;
      if (any(slides)) {
        const Lanes slid1 = row.tangential1 - row.slide * u1;
        const Lanes slid2 = row.tangential2 - row.slide * u2;
        const Lanes squared = slid1 * slid1 + slid2 * slid2;
        const LaneMask outside = squared > square;
        const Lanes one = allOf(1);
        const Lanes scale = outside ? limit / rootOf(outside ? squared : one) : one;
        p1 = slides ? scale * slid1 : p1;
        p2 = slides ? scale * slid2 : p2;
      }
      p1 = asked ? p1 : row.tangential1;
      p2 = asked ? p2 : row.tangential2;
      impulse = impulse + (p1 - row.tangential1) * block.tangent1 + (p2 - row.tangential2) * block.tangent2;
      row.tangential1 = p1;
      row.tangential2 = p2;
    }
    a.v = a.v + block.a.inverseMass * impulse;
    b.v = b.v - block.b.inverseMass * impulse;
    a.w = a.w + block.a.inertia * cross(row.arm, impulse);
    b.w = b.w - block.b.inertia * cross(armB, impulse);
  }
  if (any(changed)) {
    store<kKind>(swept, group.a, block.a, fromA, a, changed);
    store<kKind>(swept, group.b, block.b, fromB, b, changed);
  }
}

// Of bodies that cannot move, what was there.
template <LaneSweep::Kind kKind>
CAREEN_LANES void LaneSweep::store(const Swept& swept, const LaneBodies& bodies, const LaneSide& side,
                                   const MovingLanes& from, MovingLanes to, const LaneMask& changed) {
  const Lanes change = sumOfSizes(to.v - from.v) + side.radius * sumOfSizes(to.w - from.w);
  const Lanes sum = from.unqueuedChange + change;
  const LaneMask queued = sum > (kKind == Kind::kShift ? allOf(swept.change) : side.change);
  to.unqueuedChange = queued ? Lanes{} : sum;
  to.pushed = changed & (side.inverseMass > 0) ? allOf(1) : from.pushed;
  setMoving(swept.moving, bodies, to);
  for (int lane = 0; lane < kLanes; ++lane) {
    changes_[at(bodies[at(lane)])] -= static_cast<std::uint32_t>(queued[lane]);
  }
}

}  // namespace careen
