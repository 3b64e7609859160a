#include "audit/groups.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <variant>

#include "audit/near_pairs.h"
#include "audit/overlap.h"
#include "core/disjoint_sets.h"

namespace careen {
namespace {

class Joining {
 public:
  explicit Joining(const Trajectory& run) : run_(run), sets_(run.world.bodies.size()) {}

  bool isMovable(std::size_t body) const { return !isImmovable(run_.world.bodies[body].mass); }
  void join(std::size_t a, std::size_t b) {
    if (isMovable(a) && isMovable(b)) {
      sets_.join(a, b);
    }
  }
  std::size_t root(std::size_t body) { return sets_.root(body); }
  bool areJoined(std::size_t a, std::size_t b) { return sets_.root(a) == sets_.root(b); }

 private:
  const Trajectory& run_;
  DisjointSets sets_;
};

void joinByImpacts(const Trajectory& run, Joining& joining) {
  for (const Impact& impact : run.impacts) {
    if (!impact.b.isWall()) {
      joining.join(static_cast<std::size_t>(impact.a.value), static_cast<std::size_t>(impact.b.body()));
    }
  }
}

// Springs or joints.
template <class Link>
void joinByLinks(const std::vector<Link>& links, Joining& joining) {
  for (const Link& link : links) {
    if (link.from.body && link.to.body) {
      joining.join(static_cast<std::size_t>(*link.from.body), static_cast<std::size_t>(*link.to.body));
    }
  }
}

// Calls `add` with the index of each, and a body of its ends that can move.
template <class Link, class Add>
void forMovableEnds(const std::vector<Link>& links, const Joining& joining, const Add& add) {
  for (std::size_t index = 0; index < links.size(); ++index) {
    for (const std::optional<int>& body : {links[index].from.body, links[index].to.body}) {
      if (body && joining.isMovable(static_cast<std::size_t>(*body))) {
        add(index, static_cast<std::size_t>(*body));
        break;
      }
    }
  }
}

// Bodies in contact with each other are stepped together: their contact steps begin at the same bits of time.
void joinBySteps(const Trajectory& run, Joining& joining) {
  if (run.tracks.size() < 2) {
    return;
  }
  std::unordered_map<std::uint64_t, std::size_t> firstAt;
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    for (const Segment& segment : run.tracks[body].segments) {
      if (std::holds_alternative<ContactStep>(segment.motion)) {
        const auto [at, isFirst] = firstAt.try_emplace(std::bit_cast<std::uint64_t>(segment.start), body);
        if (!isFirst) {
          joining.join(at->second, body);
        }
      }
    }
  }
}

// Bodies that lie on each other, and those of a crowd or a table, which meet between the moments too.
void joinByPlaces(const Trajectory& run, const Samples& samples, Joining& joining) {
  const std::size_t count = run.tracks.size();
  std::vector<Ball> balls(count);
  std::vector<double> margins(count);
  const std::vector<double> crowdFrom = crowdBeginnings(run);
  for (std::size_t moment = 0; moment < samples.moments() && count > 1; ++moment) {
    const double time = samples.times()[moment];
    const double before = moment > 0 ? samples.times()[moment - 1] : time;
    const double after = moment + 1 < samples.moments() ? samples.times()[moment + 1] : time;
    for (std::size_t body = 0; body < count; ++body) {
      const BodyState& state = samples.state(moment, body);
      margins[body] =
          touchingDistance(run.world.bodies[body], run.settings) +
          (crowdFrom[body] <= after ? std::max(after - time, time - before) * state.velocity.norm() : 0);
      balls[body] = {state.pose.position, radiusOf(run.world.bodies[body]) + margins[body]};
    }
    for (const auto& [a, b] : nearPairs(balls)) {
      const auto touches = [&](std::size_t body) {
        return mayTouch(run.tracks[body].segments[segmentAt(run.tracks[body], time)].motion);
      };
      if (!joining.areJoined(a, b) && (touches(a) || touches(b)) &&
          mayTouch(run.world, static_cast<int>(a), static_cast<int>(b)) &&
          separationOf(run.world.bodies[a], samples.state(moment, a).pose, run.world.bodies[b],
                       samples.state(moment, b).pose) <= margins[a] + margins[b]) {
        joining.join(a, b);
      }
    }
  }
}

bool mayLose(const Material& a, const Material& b) {
  const Material pair = touching(a, b);
  return pair.restitution < 1 || pair.friction > 0;
}

/// How many bodies of a run are not fully elastic, and how many have friction.
struct Lossy {
  std::ptrdiff_t inelastic = 0;
  std::ptrdiff_t rough = 0;
};

bool isInelastic(const Body& body) { return body.material.restitution < 1; }
bool isRough(const Body& body) { return body.material.friction > 0; }

Lossy lossyOf(const World& world) {
  return {.inelastic = std::count_if(world.bodies.begin(), world.bodies.end(), isInelastic),
          .rough = std::count_if(world.bodies.begin(), world.bodies.end(), isRough)};
}

// Restitution is the larger, and friction the geometric mean, of both: a body loses energy with any other
// one of its kind.
bool mayLose(const World& world, const Lossy& lossy, const ExchangeGroup& group) {
  return std::any_of(group.bodies.begin(), group.bodies.end(), [&](std::size_t member) {
    const Body& own = world.bodies[member];
    return (isInelastic(own) && lossy.inelastic > 1) || (isRough(own) && lossy.rough > 1) ||
           std::any_of(world.walls.begin(), world.walls.end(),
                       [&](const Wall& wall) { return mayLose(own.material, wall.material); });
  });
}

}  // namespace

double touchingDistance(const Body& body, const RunSettings& settings) {
  constexpr double kOfSize = 1e-3;
  constexpr double kTolerances = 64;
  return kOfSize * body.halfExtents.norm() + kTolerances * settings.tolerance;
}

std::vector<ExchangeGroup> exchangeGroups(const Trajectory& run, const Samples& samples) {
  Joining joining(run);
  joinByImpacts(run, joining);
  joinByLinks(run.world.springs, joining);
  joinByLinks(run.world.joints, joining);
  joinBySteps(run, joining);
  joinByPlaces(run, samples, joining);
  std::vector<ExchangeGroup> groups;
  std::vector<std::size_t> groupOf(run.tracks.size(), run.tracks.size());
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    if (joining.isMovable(body)) {
      std::size_t& group = groupOf[joining.root(body)];
      if (group == run.tracks.size()) {
        group = groups.size();
        groups.emplace_back();
      }
      groups[group].bodies.push_back(body);
      groupOf[body] = group;
    }
  }
  forMovableEnds(run.world.springs, joining, [&](std::size_t spring, std::size_t body) {
    groups[groupOf[body]].springs.push_back(spring);
  });
  forMovableEnds(run.world.joints, joining, [&](std::size_t index, std::size_t body) {
    ExchangeGroup& group = groups[groupOf[body]];
    const Joint& joint = run.world.joints[index];
    const bool stops =
        joint.kind == Joint::Kind::kRope || joint.lowest > -Joint::kFree || joint.highest < Joint::kFree;
    group.joints.push_back(index);
    group.jointsLose = group.jointsLose || (stops && joint.restitution < 1);
  });
  for (std::size_t k = 0; k < run.impacts.size(); ++k) {
    const auto a = static_cast<std::size_t>(run.impacts[k].a.value);
    const std::size_t hit = joining.isMovable(a) || run.impacts[k].b.isWall()
                                ? a
                                : static_cast<std::size_t>(run.impacts[k].b.body());
    if (joining.isMovable(hit)) {
      groups[groupOf[hit]].impacts.push_back(k);
    }
  }
  const Lossy lossy = lossyOf(run.world);
  for (ExchangeGroup& group : groups) {
    group.mayLose = mayLose(run.world, lossy, group);
  }
  return groups;
}

}  // namespace careen
