#include "audit/audit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "audit/between_rows.h"
#include "audit/findings.h"
#include "audit/groups.h"
#include "audit/joint_gap.h"
#include "audit/ledger.h"
#include "audit/moments.h"
#include "audit/near_pairs.h"
#include "audit/overlap.h"
#include "audit/samples.h"
#include "audit/seams.h"
#include "core/brief.h"
#include "core/error.h"

namespace careen {
namespace {

// A table is held to a part of the size of its boxes.
RunSettings settingsOf(const Trajectory& run, const AuditLimits& limits) {
  RunSettings settings = run.settings;
  if (run.given) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Body& body : run.world.bodies) {
      smallest = isImmovable(body.mass) ? smallest : std::min(smallest, body.halfExtents.norm());
    }
    settings.tolerance = limits.table * smallest;
  }
  return settings;
}

// Budgets, in states looked at.
constexpr std::size_t kStatesAtMoments = 4'000;
constexpr std::size_t kStatesAtMomentsInFull = 400'000;
constexpr std::size_t kSeamsOfAll = 1'500;
constexpr std::size_t kStatesAroundWorst = 1'500;
constexpr std::size_t kMostMoments = 1'000;
constexpr std::size_t kFewestMoments = 16;
constexpr std::size_t kWorst = 4;
constexpr double kNear = 0.1;  // [1] of how far the boxes of a table may overlap: they push each other,
                               // and as the scene allows its crowds

class Auditor {
 public:
  Auditor(const Trajectory& run, AuditDepth depth, const AuditLimits& limits, const std::stop_token& stop)
      : run_(run),
        depth_(depth),
        stop_(stop),
        part_(limits.table),
        settings_(settingsOf(run, limits)),
        findings_(settings_, promises(limits, false), promises(limits, true), crowdBeginnings(run)),
        impulses_(impulsesOfBodies(run)),
        fallingSpeeds_(fallingSpeeds(run.world)),
        badness_(run.tracks.size(), 0) {}

  Audit run();

 private:
  Promises promises(const AuditLimits& limits, bool pile) const;
  bool isFull() const { return depth_ == AuditDepth::kFull; }
  std::size_t bodies() const { return run_.tracks.size(); }
  const Body& body(std::size_t index) const { return run_.world.bodies[index]; }
  double radius(std::size_t index) const { return radiusOf(body(index)); }

  std::vector<double> moments() const;
  bool areMotionsFinite();
  void checkMoments(const Samples& samples);
  void checkWalls(std::size_t body, const Pose& pose, double time);
  void checkPair(std::size_t a, const Pose& poseA, std::size_t b, const Pose& poseB, double time);
  template <class PoseOf>
  void checkJoint(std::size_t index, const PoseOf& poseOf, double time);
  void checkSeams();
  void checkAround(std::size_t body, double time);
  void checkWorst();
  void checkEverySegment(std::size_t body, std::size_t stride);
  void found(AuditKind kind, double rounding, const Finding& finding);
  void rest() const;
  Audit result() const;
  std::vector<std::string> namesOf(const Finding& finding) const;

  const Trajectory& run_;
  AuditDepth depth_;
  const std::stop_token& stop_;
  double part_;  // see AuditLimits::table
  RunSettings settings_;
  Findings findings_;
  std::vector<ImpulsesOfBody> impulses_;  // of each body
  std::vector<double> fallingSpeeds_;     // likewise
  std::vector<double> badness_;           // of each body: how far it is from what it should be
  std::size_t looks_ = 0;
};

Promises Auditor::promises(const AuditLimits& limits, bool pile) const {
  Promises promises = run_.given ? promisesOfTable(limits.table) : promisesOf(run_.settings.method, pile);
  for (const auto& [kind, size] : limits.sizes) {
    promises.at(indexOf(kind)) = size ? std::optional(Promise{.absolute = *size}) : std::nullopt;
  }
  return promises;
}

void Auditor::rest() const {
  if (stop_.stop_requested()) {
    throw Interrupted();
  }
}

std::vector<double> Auditor::moments() const {
  const std::size_t budget = isFull() ? kStatesAtMomentsInFull : kStatesAtMoments;
  const std::size_t each = std::clamp(budget / std::max<std::size_t>(bodies(), 1), kFewestMoments,
                                      (isFull() ? 10 : 1) * kMostMoments);
  if (run_.given) {
    return momentsOfRows(run_, each);
  }
  std::vector<double> moments = goldenMoments(run_.settings.duration, each);
  for (const GravityChange& change : run_.world.gravityChanges) {
    if (change.time < run_.settings.duration) {
      moments.insert(std::lower_bound(moments.begin(), moments.end(), change.time), change.time);
    }
  }
  const auto addParts = [&](const auto& all) {
    for (const auto& owner : all) {
      for (const CoursePart& part : owner.course) {
        const auto at = std::lower_bound(moments.begin(), moments.end(), part.from);
        if (part.from < run_.settings.duration && (at == moments.end() || *at != part.from)) {
          moments.insert(at, part.from);
        }
      }
    }
  };
  addParts(run_.world.bodies);
  addParts(run_.world.walls);
  return moments;
}

void Auditor::found(AuditKind kind, double rounding, const Finding& finding) {
  for (const std::size_t body : finding.bodies) {
    badness_[body] = std::max(badness_[body], finding.size);
  }
  findings_.add(kind, rounding, finding);
}

void Auditor::checkWalls(std::size_t index, const Pose& pose, double time) {
  if (isImmovable(body(index).mass)) {
    return;
  }
  for (std::size_t wall = 0; wall < run_.world.walls.size(); ++wall) {
    const double depth = -separationOf(body(index), pose, planeAt(run_.world.walls[wall], time));
    if (!(depth <= 0)) {
      found(AuditKind::kWallOverlap, placeRounding(body(index), pose.position),
            {.size = depth, .time = time, .bodies = {index}, .wall = wall});
    }
  }
}

void Auditor::checkPair(std::size_t a, const Pose& poseA, std::size_t b, const Pose& poseB, double time) {
  if ((isImmovable(body(a).mass) && isImmovable(body(b).mass)) ||
      !mayTouch(run_.world, static_cast<int>(a), static_cast<int>(b))) {
    return;
  }
  const double depth = -separationOf(body(a), poseA, body(b), poseB);
  if (!(depth <= 0)) {
    found(AuditKind::kBoxOverlap,
          placeRounding(body(a), poseA.position) + placeRounding(body(b), poseB.position),
          {.size = depth, .time = time, .bodies = {a, b}, .wall = {}});
  }
}

// Until it lets go. `poseOf(body)`: the pose there.
template <class PoseOf>
void Auditor::checkJoint(std::size_t index, const PoseOf& poseOf, double time) {
  const Joint& joint = run_.world.joints[index];
  if (!(time < joint.until)) {
    return;
  }
  std::vector<std::size_t> members;
  const auto place = [&](const JointEnd& end) {
    if (!end.body) {
      return Pose{};
    }
    members.push_back(static_cast<std::size_t>(*end.body));
    return poseOf(members.back());
  };
  const Pose from = place(joint.from);
  const Pose to = place(joint.to);
  const JointGap gap = jointGapOf(run_.world, joint, from, to);
  for (const auto& [kind, size] :
       {std::pair(AuditKind::kJointGap, gap.open), std::pair(AuditKind::kJointLimit, gap.beyond)}) {
    if (size > 0) {
      found(kind, gap.rounding, {.size = size, .time = time, .bodies = members, .wall = {}, .joint = index});
    }
  }
}

void Auditor::checkMoments(const Samples& samples) {
  std::vector<Ball> balls(bodies());
  for (std::size_t moment = 0; moment < samples.moments(); ++moment) {
    rest();
    const double time = samples.times()[moment];
    for (std::size_t index = 0; index < bodies(); ++index) {
      const BodyState& state = samples.state(moment, index);
      checkState(state, index, time, findings_);
      balls[index] = {state.pose.position, radius(index)};
      if (state.pose.position.allFinite()) {
        checkWalls(index, state.pose, time);
      }
    }
    for (const auto& [a, b] : nearPairs(balls)) {
      checkPair(a, samples.state(moment, a).pose, b, samples.state(moment, b).pose, time);
    }
    for (std::size_t joint = 0; joint < run_.world.joints.size(); ++joint) {
      checkJoint(
          joint, [&](std::size_t body) { return samples.state(moment, body).pose; }, time);
    }
  }
  looks_ += samples.moments() * bodies();
}

// A body among the others at one moment; of those that are far away only the place is computed.
void Auditor::checkAround(std::size_t index, double time) {
  const BodyState state = run_.state(index, time);
  ++looks_;
  checkState(state, index, time, findings_);
  if (!state.pose.position.allFinite()) {
    return;
  }
  checkWalls(index, state.pose, time);
  for (std::size_t joint = 0; joint < run_.world.joints.size(); ++joint) {
    const Joint& each = run_.world.joints[joint];
    if (each.from.body == static_cast<int>(index) || each.to.body == static_cast<int>(index)) {
      checkJoint(
          joint, [&](std::size_t body) { return run_.state(body, time).pose; }, time);
    }
  }
  for (std::size_t other = 0; other < bodies(); ++other) {
    const Track& track = run_.tracks[other];
    const Segment segment = track.segments[segmentAt(track, time)];
    const double reach = radius(index) + radius(other);
    if (other != index &&
        (centerAt(segment.motion, time - segment.start) - state.pose.position).squaredNorm() <=
            reach * reach) {
      ++looks_;
      const BodyState there = stateAt(segment.motion, body(other).mass, time - segment.start);
      checkPair(std::min(index, other), index < other ? state.pose : there.pose, std::max(index, other),
                index < other ? there.pose : state.pose, time);
    }
  }
}

// Both sides of the seams of all bodies, or of as many as the budget allows, evenly spread, and of those
// where one comes to rest.
void Auditor::checkSeams() {
  if (run_.given) {
    const std::vector<char> followed = checkBetweenRows(
        run_, kNear * settings_.tolerance + settings_.crowds.tolerance, part_, fallingSpeeds_, findings_);
    for (std::size_t index = 0; index < bodies(); ++index) {
      rest();
      if (followed[index] == 0) {
        checkSteps(run_, index, findings_);
      }
    }
    return;
  }
  std::size_t all = 0;
  for (const Track& track : run_.tracks) {
    all += track.segments.size();
  }
  const std::size_t stride = isFull() ? 1 : 1 + all / kSeamsOfAll;
  std::size_t number = 0;
  for (std::size_t index = 0; index < bodies(); ++index) {
    rest();
    for (const Seam& seam : seamsOf(run_.tracks[index])) {
      const Segment after = run_.tracks[index].segments[seam.after];
      const bool isLooked = number++ % stride == 0 || std::holds_alternative<Rest>(after.motion);
      if (isLooked && after.start <= run_.settings.duration) {
        checkSeam(run_, index, seam, impulses_[index], fallingSpeeds_[index], findings_);
        looks_ += 2;
      }
    }
  }
}

// Start and middle of segments of a body; its end is the start of the next one. Of a table only its rows:
// nobody knows what was between them.
void Auditor::checkEverySegment(std::size_t index, std::size_t stride) {
  const Segments& segments = run_.tracks[index].segments;
  for (std::size_t k = 0; k < segments.size(); k += stride) {
    rest();
    const double end = k + 1 < segments.size() ? segments[k + 1].start : run_.settings.duration;
    if (segments[k].start <= run_.settings.duration) {
      checkAround(index, segments[k].start);
      if (run_.given) {
        continue;
      }
      checkAround(index, std::clamp(segments[k].start + (end - segments[k].start) / 2, segments[k].start,
                                    run_.settings.duration));
    }
  }
}

void Auditor::checkWorst() {
  std::vector<std::size_t> order(bodies());
  for (std::size_t index = 0; index < bodies(); ++index) {
    order[index] = index;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t x, std::size_t y) { return badness_[x] > badness_[y]; });
  if (!isFull()) {
    order.resize(std::min(order.size(), kWorst));
  }
  for (const std::size_t index : order) {
    const std::size_t cost = 2 * run_.tracks[index].segments.size() * (1 + bodies() / 16) * kWorst;
    checkEverySegment(index, isFull() ? 1 : 1 + cost / kStatesAroundWorst);
  }
}

// Whether every motion has states; each box that has a motion without is found.
bool Auditor::areMotionsFinite() {
  bool all = true;
  for (std::size_t index = 0; index < bodies(); ++index) {
    const Segments& segments = run_.tracks[index].segments;
    const auto broken = std::find_if(segments.begin(), segments.end(),
                                     [](const Segment& segment) { return !isFinite(segment.motion); });
    if (broken != segments.end()) {
      all = false;
      findings_.add(AuditKind::kNotFinite, 0,
                    {.size = 1, .time = broken->start, .bodies = {index}, .wall = {}});
    }
  }
  return all;
}

Audit Auditor::run() {
  if (!areMotionsFinite()) {
    return result();
  }
  const Samples samples(run_, moments(), stop_);
  checkMoments(samples);
  checkSeams();
  checkBalances(run_, samples, exchangeGroups(run_, samples), fallingSpeeds_, findings_);
  checkWorst();
  return result();
}

std::vector<std::string> Auditor::namesOf(const Finding& finding) const {
  std::vector<std::string> names;
  for (const std::size_t index : finding.bodies) {
    names.push_back(body(index).name);
  }
  if (finding.wall) {
    names.push_back(run_.world.walls[*finding.wall].name);
  }
  if (finding.joint) {
    names.push_back(run_.world.joints[*finding.joint].name);
  }
  return names;
}

Audit Auditor::result() const {
  Audit audit;
  audit.depth = depth_;
  audit.looks = looks_;
  for (const AuditKindTraits& traits : kAuditKinds) {
    const Finding& largest = findings_.largest(traits.kind);
    audit.figures[indexOf(traits.kind)] = {
        .size = largest.size,
        .time = largest.time,
        .bodies = namesOf(largest),
        .promised = largest.promised && findings_.promise(traits.kind, largest)};
    if (const std::optional<Finding>& breach = findings_.firstBreach(traits.kind)) {
      audit.breaches.push_back(
          {.kind = traits.kind,
           .size = breach->size,
           .allowed = allowed(*findings_.promise(traits.kind, *breach), settings_, breach->length),
           .largest = largest.size,
           .time = breach->time,
           .bodies = namesOf(*breach)});
    }
  }
  std::stable_sort(audit.breaches.begin(), audit.breaches.end(),
                   [](const AuditBreach& x, const AuditBreach& y) { return x.time < y.time; });
  return audit;
}

}  // namespace

Audit audit(const Trajectory& run, AuditDepth depth, const std::stop_token& stop, const AuditLimits& limits) {
  if (depth == AuditDepth::kNone) {
    return {};
  }
  return Auditor(run, depth, limits, stop).run();
}

std::string describe(const AuditBreach& breach, const Trajectory& run) {
  constexpr std::size_t kMostNamed = 4;
  std::string names;
  for (std::size_t i = 0; i < breach.bodies.size() && i < kMostNamed; ++i) {
    names += (i == 0 ? "" : ", ") + breach.bodies[i];
  }
  if (breach.bodies.size() > kMostNamed) {
    names += " and " + std::to_string(breach.bodies.size() - kMostNamed) + " more";
  }
  const AuditKindTraits& traits = traitsOf(breach.kind);
  std::string unit;
  if (traits.unit != "1") {
    unit.append(" ").append(traits.unit);
  }
  std::string text = "at " + brief(breach.time) + " s " + names + ": ";
  text.append(traits.what).append(": ").append(brief(breach.size)).append(unit);
  if (breach.largest > breach.size) {
    text.append(", later ").append(brief(breach.largest)).append(unit);
  }
  const std::string most = "at most " + brief(breach.allowed) + unit;
  return run.given
             ? text.append(", where ").append(most).append(" is allowed")
             : text.append(", where method ").append(run.methodName()).append(" promises ").append(most);
}

std::string inWords(const Audit& audit) {
  std::string promised;
  std::string others;
  for (const AuditKindTraits& traits : kAuditKinds) {
    const AuditFigure& figure = audit.figure(traits.kind);
    if (figure.size > 0) {
      std::string& text = figure.promised ? promised : others;
      text.append(text.empty() ? "" : ", ").append(traits.name).append(" ").append(brief(figure.size, 3));
      text.append(traits.unit == "1" ? "" : " ").append(traits.unit == "1" ? "" : traits.unit);
    }
  }
  if (!others.empty()) {
    others.insert(0, promised.empty() ? "no promise concerns " : "; no promise concerns ");
  }
  if (promised.empty() && others.empty()) {
    return "nothing found";
  }
  return (audit.breaches.empty() ? "" : "BROKEN: ") + promised + others;
}

}  // namespace careen
