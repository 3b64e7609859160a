#include "audit/between_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "audit/encounter.h"
#include "audit/flown.h"
#include "audit/near_pairs.h"
#include "audit/overlap.h"
#include "audit/passage.h"
#include "audit/samples.h"
#include "audit/seams.h"
#include "core/disjoint_sets.h"
#include "physics/world/partner.h"

namespace careen {
namespace {

constexpr double kRowRounding = 4096 * std::numeric_limits<double>::epsilon();
constexpr double kMostTurnOfRow = 3;  // [rad] from row to row: of more, the attitude tells nothing

/// A body from one row to the next, while it is looked at.
struct Flying {
  const BodyState* before = nullptr;
  const BodyState* after = nullptr;
  double speed = 0;  // [m/s] of no point more
  std::vector<Partner> partners = {};
};

class Rows {
 public:
  Rows(const Trajectory& run, double near, double part, const std::vector<double>& fallingSpeeds,
       Findings& findings)
      : run_(run), near_(near), part_(part), fallingSpeeds_(fallingSpeeds), findings_(findings) {}

  std::vector<char> check();

 private:
  const Body& body(std::size_t index) const { return run_.world.bodies[index]; }
  bool isHeld(std::size_t index) const { return isImmovable(body(index).mass); }
  void listPulled();
  bool haveCommonRows() const;
  void look(std::size_t row);
  Flying flyingOf(std::size_t index, std::size_t row) const;
  void findPartners(std::size_t row);
  void hasten();
  std::pair<const BodyState&, const BodyState&> rowsOf(std::size_t index, std::size_t row) const;
  ObservedEncounter encounterOf(std::size_t index, Partner partner, std::size_t row) const;
  bool canTouch(std::size_t index, Partner partner, std::size_t row) const;
  void settle(std::size_t index, std::size_t row);
  void checkWay(std::size_t index, std::size_t row);
  void checkFriction(std::size_t row);
  void checkBounce(std::size_t index, std::size_t row);
  double start(std::size_t row) const { return run_.tracks[rowsOf_].segments.unpacked()[row].start; }
  double seconds(std::size_t row) const {
    return std::get<SampledStep>(run_.tracks[rowsOf_].segments.unpacked()[row].motion).duration;
  }

  Vec3 gravityOf(std::size_t row) const {
    return meanGravity(run_.world, start(row), start(row) + seconds(row));
  }

  const Trajectory& run_;
  double near_;
  double part_;
  const std::vector<double>& fallingSpeeds_;
  Findings& findings_;
  std::size_t rowsOf_ = 0;  // a body that moves
  double seconds_ = 0;      // from the row looked at to the next
  std::vector<char> pulled_;
  std::vector<Flying> flying_;
  std::vector<std::vector<Passage>> passages_;  // of each body
};

void Rows::listPulled() {
  pulled_.assign(run_.tracks.size(), run_.world.drag ? 1 : 0);
  const auto pull = [this](const std::optional<int>& body) {
    if (body) {
      pulled_[static_cast<std::size_t>(*body)] = 1;
    }
  };
  for (const Spring& spring : run_.world.springs) {
    pull(spring.from.body);
    pull(spring.to.body);
  }
  for (const Joint& joint : run_.world.joints) {
    pull(joint.from.body);
    pull(joint.to.body);
  }
}

bool Rows::haveCommonRows() const {
  const Segments& rows = run_.tracks[rowsOf_].segments;
  for (std::size_t index = 0; index < run_.tracks.size(); ++index) {
    if (!isHeld(index) &&
        !std::equal(rows.begin(), rows.end(), run_.tracks[index].segments.begin(),
                    run_.tracks[index].segments.end(),
                    [](const Segment& x, const Segment& y) { return x.start == y.start; })) {
      return false;
    }
  }
  return true;
}

std::vector<char> Rows::check() {
  while (rowsOf_ < run_.tracks.size() && isHeld(rowsOf_)) {
    ++rowsOf_;
  }
  if (rowsOf_ == run_.tracks.size() || !haveCommonRows()) {
    return std::vector<char>(run_.tracks.size(), 0);
  }
  listPulled();
  const std::size_t rows = run_.tracks[rowsOf_].segments.size();
  passages_.assign(run_.tracks.size(), {});
  for (std::size_t index = 0; index < run_.tracks.size(); ++index) {
    passages_[index].resize(isHeld(index) ? 0 : rows);
  }
  for (std::size_t row = 0; row < rows; ++row) {
    look(row);
  }
  const bool isKnown = run_.given->velocities && run_.given->angularVelocities;
  for (std::size_t row = 0; row < rows; ++row) {
    flying_.clear();
    for (std::size_t index = 0; index < run_.tracks.size(); ++index) {
      if (isKnown && !isHeld(index) && passages_[index][row].met) {
        checkBounce(index, row);
      }
    }
  }
  for (std::size_t index = 0; index < run_.tracks.size(); ++index) {
    addUp(run_, index, passages_[index], fallingSpeeds_[index], findings_);
  }
  std::vector<char> followed;
  for (std::size_t index = 0; index < run_.tracks.size(); ++index) {
    followed.push_back(!isHeld(index) && pulled_[index] == 0 ? 1 : 0);
  }
  return followed;
}

Flying Rows::flyingOf(std::size_t index, std::size_t row) const {
  if (isHeld(index)) {
    return {.before = &body(index).initial, .after = &body(index).initial};
  }
  const SampledStep& step = std::get<SampledStep>(run_.tracks[index].segments.unpacked()[row].motion);
  Flying flying{.before = &step.start, .after = &step.end};
  for (const BodyState* state : {flying.before, flying.after}) {
    flying.speed =
        std::max(flying.speed, state->velocity.norm() +
                                   radiusOf(body(index)) * angularVelocity(body(index).mass, *state).norm());
  }
  flying.speed += mostGravity(run_.world) * step.duration;
  return flying;
}

void Rows::look(std::size_t row) {
  flying_.clear();
  for (std::size_t index = 0; index < run_.tracks.size(); ++index) {
    flying_.push_back(flyingOf(index, row));
  }
  seconds_ = seconds(row);
  findPartners(row);
  hasten();
  findPartners(row);
  for (std::size_t index = 0; index < run_.tracks.size(); ++index) {
    if (!isHeld(index) && pulled_[index] == 0) {
      settle(index, row);
    }
  }
  checkFriction(row);
}

// What others strike meanwhile may be faster for a while: by all of their energy.
void Rows::hasten() {
  DisjointSets joined(flying_.size());
  for (std::size_t index = 0; index < flying_.size(); ++index) {
    for (const Partner partner : flying_[index].partners) {
      if (!isHeld(index) && !partner.isWall() && !isHeld(static_cast<std::size_t>(partner.body()))) {
        joined.join(index, static_cast<std::size_t>(partner.body()));
      }
    }
  }
  std::vector<double> energies(flying_.size(), 0);
  std::vector<int> members(flying_.size(), 0);
  for (std::size_t index = 0; index < flying_.size(); ++index) {
    const MassProperties& mass = body(index).mass;
    const double fall = mostGravity(run_.world) * seconds_;
    energies[joined.root(index)] +=
        0.5 * mass.mass * fall * fall +
        std::max(kineticEnergy(mass, *flying_[index].before), kineticEnergy(mass, *flying_[index].after));
    ++members[joined.root(index)];
  }
  for (std::size_t index = 0; index < flying_.size(); ++index) {
    const MassProperties& mass = body(index).mass;
    const std::size_t root = joined.root(index);
    if (members[root] > 1) {
      const double radius = radiusOf(body(index));
      const double most = mass.inverseMass + radius * radius * mass.inverseInertiaBody.maxCoeff();
      flying_[index].speed = std::max(flying_[index].speed, std::sqrt(2 * energies[root] * most));
    }
  }
}

void Rows::findPartners(std::size_t row) {
  for (Flying& flying : flying_) {
    flying.partners.clear();
  }
  std::vector<Ball> balls(run_.tracks.size());
  for (std::size_t index = 0; index < run_.tracks.size(); ++index) {
    const Flying& flying = flying_[index];
    balls[index] = {flying.before->pose.position,
                    radiusOf(body(index)) + near_ + flying.speed * seconds(row)};
    for (std::size_t wall = 0; wall < run_.world.walls.size() && !isHeld(index); ++wall) {
      if (canTouch(index, Partner::ofWall(wall), row)) {
        flying_[index].partners.push_back(Partner::ofWall(wall));
      }
    }
  }
  for (const auto& [a, b] : nearPairs(balls)) {
    if ((!isHeld(a) || !isHeld(b)) && mayTouch(run_.world, static_cast<int>(a), static_cast<int>(b)) &&
        canTouch(isHeld(a) ? b : a, Partner::ofBody(static_cast<int>(isHeld(a) ? a : b)), row)) {
      flying_[a].partners.push_back(Partner::ofBody(static_cast<int>(b)));
      flying_[b].partners.push_back(Partner::ofBody(static_cast<int>(a)));
    }
  }
}

std::pair<const BodyState&, const BodyState&> Rows::rowsOf(std::size_t index, std::size_t row) const {
  if (isHeld(index)) {
    return {body(index).initial, body(index).initial};
  }
  const SampledStep& step = std::get<SampledStep>(run_.tracks[index].segments.unpacked()[row].motion);
  return {step.start, step.end};
}

ObservedEncounter Rows::encounterOf(std::size_t index, Partner partner, std::size_t row) const {
  ObservedEncounter encounter{
      .body = &body(index), .gravity = gravityOf(row), .seconds = seconds(row), .near = near_, .part = part_};
  std::tie(encounter.before, encounter.after) = rowsOf(index, row);
  if (partner.isWall()) {
    encounter.wall = &run_.world.walls[partner.wall()];
  } else {
    const auto other = static_cast<std::size_t>(partner.body());
    encounter.other = &body(other);
    std::tie(encounter.otherBefore, encounter.otherAfter) = rowsOf(other, row);
  }
  if (!run_.given->velocities || !run_.given->angularVelocities) {
    const double spin = angularVelocity(body(index).mass, encounter.before).norm();
    encounter.doubt = encounter.seconds * (encounter.gravity.norm() + spin * spin * radiusOf(body(index)));
  }
  return encounter;
}

// Whether they may have come as near as things that push each other: two points with a gap that closes and
// opens again between the rows, at no more than their speeds.
bool Rows::canTouch(std::size_t index, Partner partner, std::size_t row) const {
  const ObservedEncounter encounter = encounterOf(index, partner, row);
  const double other = partner.isWall() ? 0 : flying_[static_cast<std::size_t>(partner.body())].speed;
  const double closing = (flying_[index].speed + other) * encounter.seconds;
  const double gap = gapOf(encounter, encounter.before, encounter.otherBefore);
  const auto stays = [](const BodyState& x, const BodyState& y) {
    return x.pose.position == y.pose.position && x.pose.worldFromBody == y.pose.worldFromBody;
  };
  const double gaps =
      gap + (stays(encounter.before, encounter.after) && stays(encounter.otherBefore, encounter.otherAfter)
                 ? gap
                 : gapOf(encounter, encounter.after, encounter.otherAfter));
  return !(gaps - closing > 2 * near_);
}

// Where they cannot move, the flight says when both can have touched.
void Rows::settle(std::size_t index, std::size_t row) {
  const Flying& flying = flying_[index];
  Passage& passage = passages_[index][row];
  const MassProperties& mass = body(index).mass;
  const BodyState flight = flown(mass, *flying.before, gravityOf(row), seconds(row));
  passage.impulse = mass.mass * (flying.after->velocity - flight.velocity);
  passage.angularImpulse = flying.after->angularMomentum - flight.angularMomentum;
  const double turns = seconds(row) * std::max(angularVelocity(mass, *flying.before).norm(),
                                               angularVelocity(mass, *flying.after).norm());
  if (run_.given->velocities) {
    passage.way = flying.after->pose.position - flight.pose.position;
  }
  if (run_.given->angularVelocities && turns < kMostTurnOfRow) {
    passage.turn = turnBetween(flight.pose.worldFromBody, flying.after->pose.worldFromBody);
  }
  const auto isFixed = [&](Partner partner) {
    return partner.isWall() || isHeld(static_cast<std::size_t>(partner.body()));
  };
  const double still = kRowRounding * (1 + flying.after->pose.position.norm() / radiusOf(body(index)));
  if (passage.impulse.norm() <= still * mass.mass * flying.speed &&
      passage.angularImpulse.norm() <= still * flying.after->angularMomentum.norm()) {
    passage.kind = Passage::Kind::kFlew;
    return;
  }
  std::vector<ObservedEncounter> fixed;
  for (const Partner partner : flying.partners) {
    if (isFixed(partner)) {
      fixed.push_back(encounterOf(index, partner, row));
    }
  }
  if (flying.partners.empty() ||
      (fixed.size() == flying.partners.size() && turns <= kMostTurnOfRow && leastDistance(fixed) > near_)) {
    passage.kind = Passage::Kind::kFlew;
    return;
  }
  checkWay(index, row);
  const bool isOnly = flying.partners.size() == 1;
  const Partner partner = flying.partners.front();
  if (isOnly && turns <= kMostTurnOfRow &&
      (isFixed(partner) || flying_[static_cast<std::size_t>(partner.body())].partners.size() == 1) &&
      (partner.isWall() || pulled_[static_cast<std::size_t>(partner.body())] == 0)) {
    passage.met = partner;
  }
}

// What is struck several times between two rows has any velocity up to the fastest meanwhile.
void Rows::checkWay(std::size_t index, std::size_t row) {
  const Flying& flying = flying_[index];
  if (!run_.given->velocities) {
    return;
  }
  const Vec3 mean = 0.5 * (flying.before->velocity + flying.after->velocity);
  const Vec3 way = flying.after->pose.position - flying.before->pose.position;
  findings_.add(AuditKind::kContinuity, kRowRounding * (way.norm() + flying.after->pose.position.norm()),
                {.size = (way - seconds(row) * mean).norm() - seconds(row) * flying.speed,
                 .time = start(row),
                 .bodies = {index},
                 .wall = {}});
}

// Bodies that touched one thing got all of their impulse from it. They are taken away, and others then
// touched one thing less, but passed that impulse on.
void Rows::checkFriction(std::size_t row) {
  std::vector<Vec3> passed(run_.tracks.size(), Vec3::Zero());
  std::vector<std::vector<Partner>> partners;
  std::vector<std::size_t> leaves;
  for (std::size_t index = 0; index < run_.tracks.size(); ++index) {
    partners.push_back(flying_[index].partners);
    if (partners[index].size() == 1) {
      leaves.push_back(index);
    }
  }
  while (!leaves.empty()) {
    const std::size_t index = leaves.back();
    leaves.pop_back();
    if (isHeld(index) || pulled_[index] != 0 || partners[index].size() != 1 ||
        passages_[index][row].kind == Passage::Kind::kFlew) {
      continue;
    }
    const Partner partner = partners[index].front();
    ObservedEncounter encounter = encounterOf(index, partner, row);
    encounter.passed = passed[index];
    if (const std::optional<Friction> friction = frictionOf(encounter)) {
      Passage& passage = passages_[index][row];
      passage.kind = Passage::Kind::kTouched;
      passage.missing = friction->missing;
      passage.surplus = friction->surplus;
    }
    partners[index].clear();
    if (!partner.isWall()) {
      const auto other = static_cast<std::size_t>(partner.body());
      passed[other] += impulseOf(encounter);
      std::erase(partners[other], Partner::ofBody(static_cast<int>(index)));
      if (partners[other].size() == 1) {
        leaves.push_back(other);
      }
    }
  }
}

// From the last row at which both were apart to the first at which they are again, as far as they flew.
void Rows::checkBounce(std::size_t index, std::size_t row) {
  const Partner partner = *passages_[index][row].met;
  const auto flew = [&](std::size_t at) {
    return passages_[index][at].kind == Passage::Kind::kFlew &&
           (partner.isWall() || isHeld(static_cast<std::size_t>(partner.body())) ||
            passages_[static_cast<std::size_t>(partner.body())][at].kind == Passage::Kind::kFlew);
  };
  const auto stateAt = [&](std::size_t body, std::size_t at, bool isEnd) {
    const SampledStep& step = std::get<SampledStep>(run_.tracks[body].segments.unpacked()[at].motion);
    return isEnd ? step.end : step.start;
  };
  ObservedEncounter encounter = encounterOf(index, partner, row);
  const auto set = [&](std::size_t at, bool isEnd) {
    (isEnd ? encounter.after : encounter.before) = stateAt(index, at, isEnd);
    if (!partner.isWall() && !isHeld(static_cast<std::size_t>(partner.body()))) {
      (isEnd ? encounter.otherAfter : encounter.otherBefore) =
          stateAt(static_cast<std::size_t>(partner.body()), at, isEnd);
    }
  };
  std::size_t first = row;
  set(first, false);
  while (gapOf(encounter, encounter.before, encounter.otherBefore) <= near_ && first > 0 && flew(first - 1)) {
    set(--first, false);
  }
  std::size_t last = row;
  set(last, true);
  while (gapOf(encounter, encounter.after, encounter.otherAfter) <= near_ &&
         last + 1 < passages_[index].size() && flew(last + 1)) {
    set(++last, true);
  }
  encounter.seconds = start(last) + seconds(last) - start(first);
  const double time = start(row);
  Finding finding{.size = restitutionBeyond(encounter), .time = time, .bodies = {index}, .wall = {}};
  if (encounter.wall != nullptr) {
    finding.wall = static_cast<std::size_t>(encounter.wall - run_.world.walls.data());
  } else {
    finding.bodies.push_back(static_cast<std::size_t>(encounter.other - run_.world.bodies.data()));
  }
  findings_.add(AuditKind::kRestitution, 0, finding);
}

}  // namespace

std::vector<char> checkBetweenRows(const Trajectory& run, double near, double part,
                                   const std::vector<double>& fallingSpeeds, Findings& findings) {
  return Rows(run, near, part, fallingSpeeds, findings).check();
}

}  // namespace careen
