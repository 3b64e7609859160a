#include "physics/pile/crowd_restitution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/pile/index.h"

namespace careen {
namespace {

/// [1] of the fastest that strikes: to that a projection is found; and slower approach is not reflected.
constexpr double kFound = 0x1p-20;
constexpr double kReflected = 0x1p-7;
constexpr double kRounded = 0x1p-10;  ///< [1] of the slowest impact: to that P is found
/// Of points in reflections, and for each that is reached; what is left then is projected.
constexpr std::size_t kVisits = 0x4000;
constexpr std::size_t kVisitsOfPoint = 32;
constexpr int kProjectionSweeps = 100;
/// Values of e that are told apart.
constexpr std::size_t kMostLevels = 8;

}  // namespace

void CrowdRestitution::begin() {
  fastest_ = 0;
  points_.clear();
  bodies_.clear();
  front_.clear();
  changed_.clear();
  reachedAt_.assign(members_.size(), kNobody);
  firstPoint_.assign(contacts_.manifoldCount(), kNobody);
  firstSlot_.assign(members_.size() + 1, 0);
  const auto forSides = [&](const auto& use) {
    for (const int slot : contacts_.near()) {
      const PileManifold& manifold = contacts_[slot];
      use(manifold.a, slot);
      use(manifold.b, slot);
    }
  };
  forSides([&](int place, int) { ++firstSlot_[at(place) + 1]; });
  for (std::size_t i = 0; i < members_.size(); ++i) {
    firstSlot_[i + 1] += firstSlot_[i];
  }
  slots_.resize(at(firstSlot_.back()));
  std::vector<int> next(firstSlot_.begin(), firstSlot_.end() - 1);
  forSides([&](int place, int slot) { slots_[at(next[at(place)]++)] = slot; });
}

void CrowdRestitution::strike(int slot, int index, double approach) {
  const int first = listManifold(slot);
  for (std::size_t p = at(first); p < points_.size() && points_[p].slot == slot; ++p) {
    if (points_[p].index == index) {
      points_[p].before = -approach;
      points_[p].strikes = true;
      fastest_ = std::max(fastest_, approach);
    }
  }
}

int CrowdRestitution::reach(int place) {
  if (members_[place].still()) {
    return kNobody;
  }
  if (reachedAt_[at(place)] == kNobody) {
    reachedAt_[at(place)] = static_cast<int>(bodies_.size());
    bodies_.push_back({.place = place, .mass = solverBody(members_[place], 0)});
  }
  return reachedAt_[at(place)];
}

int CrowdRestitution::listManifold(int slot) {
  if (firstPoint_[at(slot)] != kNobody) {
    return firstPoint_[at(slot)];
  }
  const PileManifold& manifold = contacts_[slot];
  firstPoint_[at(slot)] = static_cast<int>(points_.size());
  const std::array<int, 2> bodies{reach(manifold.a), reach(manifold.b)};
  const Vec3 apart = members_.apart(manifold.a, manifold.b);
  for (int k = 0; k < manifold.count; ++k) {
    const PilePoint& from = manifold.points[at(k)];
    if (from.row < 0) {
      continue;
    }
    Point point{.slot = slot,
                .index = k,

                .bodies = bodies,
                .arms = {from.world, from.world + apart},
                .normal = manifold.frameOf(k).normal,
                .restitution = manifold.restitution,
                .before = std::max(0.0, from.speed),
                .friction = manifold.friction};
    double inverse = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      if (bodies[side] != kNobody) {
        const CrowdMembers::Way& way = members_.ways[at(bodies_[at(bodies[side])].place)];
        const Vec3 velocity = way.velocity + way.omega.cross(point.arms[side]);
        point.slip += side == 0 ? velocity : Vec3(-velocity);
        const SolverBody& mass = bodies_[at(bodies[side])].mass;
        const Vec3 turn = point.arms[side].cross(point.normal);
        inverse += mass.inverseMass + dot(turn, mass.turned(turn));
        bodies_[at(bodies[side])].points.push_back(static_cast<int>(points_.size()));
      }
    }
    point.mass = inverse > 0 ? 1 / inverse : 0;
    point.slip -= dot(point.normal, point.slip) * point.normal;
    points_.push_back(point);
  }
  return firstPoint_[at(slot)];
}

void CrowdRestitution::listPoints(Reached& body) {
  if (body.isListed) {
    return;
  }
  body.isListed = true;
  const int place = body.place;  // bodies_ grows, and `body` with it moves
  for (int n = firstSlot_[at(place)]; n < firstSlot_[at(place) + 1]; ++n) {
    listManifold(slots_[at(n)]);
  }
}

// [m/s] Of its relative velocity, by impulses.
Vec3 CrowdRestitution::change(const Point& point) const {
  Vec3 change = Vec3::Zero();
  for (std::size_t side = 0; side < 2; ++side) {
    if (point.bodies[side] != kNobody) {
      const Reached& body = bodies_[at(point.bodies[side])];
      const Vec3 ofPoint = body.velocity + body.omega.cross(point.arms[side]);
      change += side == 0 ? ofPoint : Vec3(-ofPoint);
    }
  }
  return change;
}

Vec3 CrowdRestitution::sliding(const Point& point) const {
  const Vec3 change = this->change(point);
  return point.slip + change - dot(point.normal, change) * point.normal;
}

void CrowdRestitution::push(const Point& point, const Vec3& impulse) {
  for (std::size_t side = 0; side < 2; ++side) {
    if (point.bodies[side] != kNobody) {
      Reached& body = bodies_[at(point.bodies[side])];
      const Vec3 pushed = side == 0 ? impulse : Vec3(-impulse);
      body.velocity += body.mass.inverseMass * pushed;
      body.omega += body.mass.turned(point.arms[side].cross(pushed));
    }
  }
  note(point);
}

// Its bodies are pushed: others may approach them.
void CrowdRestitution::note(const Point& point) {
  for (const int body : point.bodies) {
    if (body != kNobody && !bodies_[at(body)].changed) {
      bodies_[at(body)].changed = true;
      changed_.push_back(body);
    }
  }
}

void CrowdRestitution::setVelocities(double (*impulseOf)(const Point&)) {
  for (Reached& body : bodies_) {
    body.velocity = body.omega = Vec3::Zero();
    body.changed = false;
    body.stirred = 0;
  }
  changed_.clear();
  for (const Point& point : points_) {
    if (const double impulse = impulseOf(point); impulse != 0) {
      push(point, impulse);
    }
  }
}

void CrowdRestitution::restart() {
  setVelocities([](const Point&) { return 0.0; });
  front_.clear();
  for (std::size_t p = 0; p < points_.size(); ++p) {
    points_[p].impulse = 0;
    if (points_[p].strikes) {
      front_.push_back(static_cast<int>(p));
    }
  }
}

void CrowdRestitution::findApproaching(std::vector<int>& approaching) const {
  approaching.clear();
  for (const int p : front_) {
    const Point& point = points_[at(p)];
    if (point.mass > 0 && speed(point) < -slow_) {
      approaching.push_back(p);
    }
  }
}

// The points of bodies that were pushed, and these.
void CrowdRestitution::findFront(std::span<const int> more) {
  front_.assign(more.begin(), more.end());
  for (const int body : changed_) {
    Reached& reached = bodies_[at(body)];
    reached.changed = false;
    listPoints(reached);
    front_.insert(front_.end(), bodies_[at(body)].points.begin(), bodies_[at(body)].points.end());
  }
  changed_.clear();
  std::sort(front_.begin(), front_.end());
  front_.erase(std::unique(front_.begin(), front_.end()), front_.end());
}

// To begin with: equal impulses at points of a manifold that approach alike, so that what meets flat is not
// turned. Gauss–Seidel alone takes a hundred sweeps to undo that.
void CrowdRestitution::guess(std::span<const int> ofManifold) {
  std::array<std::pair<Vec3, Vec3>, 2> velocities;
  const std::array<int, 2> sides = points_[at(ofManifold.front())].bodies;
  const auto swap = [&] {
    for (std::size_t side = 0; side < 2; ++side) {
      if (sides[side] != kNobody) {
        std::swap(velocities[side].first, bodies_[at(sides[side])].velocity);
        std::swap(velocities[side].second, bodies_[at(sides[side])].omega);
      }
    }
  };
  velocities.fill({Vec3::Zero(), Vec3::Zero()});
  swap();
  for (const int p : ofManifold) {
    push(points_[at(p)], 1);
  }
  for (const int p : ofManifold) {
    points_[at(p)].ofPass = dot(points_[at(p)].normal, change(points_[at(p)]));
  }
  swap();
  for (const int p : ofManifold) {
    const double change = points_[at(p)].ofPass;
    points_[at(p)].ofPass = change > 0 ? std::max(0.0, -speed(points_[at(p)]) / change) : 0;
  }
  for (const int p : ofManifold) {
    push(points_[at(p)], points_[at(p)].ofPass);
  }
}

// One step of Gauss–Seidel; returns by how much [m/s].
double CrowdRestitution::solveAt(Point& point) {
  const double impulse = std::max(-speed(point) * point.mass, -point.ofPass);
  point.ofPass += impulse;
  push(point, impulse);
  return std::fabs(impulse) / point.mass;
}

// Onto the motions in which none of the chosen approaches, by Gauss–Seidel.
void CrowdRestitution::project(std::span<const int> chosen) {
  for (auto first = chosen.begin(); first != chosen.end();) {
    const int slot = points_[at(*first)].slot;
    const auto last = std::find_if(first, chosen.end(), [&](int p) { return points_[at(p)].slot != slot; });
    guess({first, last});
    first = last;
  }
  double largest = std::numeric_limits<double>::infinity();
  for (int sweep = 0; sweep < kProjectionSweeps && largest > kFound * fastest_; ++sweep) {
    largest = 0;
    visits_ += chosen.size();
    for (const int p : chosen) {
      largest = std::max(largest, solveAt(points_[at(p)]));
    }
  }
}

// Whether one of its bodies was pushed since the last sweep; in the first one all are.
bool CrowdRestitution::isDue(const Point& point, int sweep) const {
  return std::any_of(point.bodies.begin(), point.bodies.end(),
                     [&](int body) { return body != kNobody && bodies_[at(body)].stirred >= sweep - 1; });
}

void CrowdRestitution::stir(const Point& point, int sweep) {
  for (const int body : point.bodies) {
    if (body != kNobody) {
      bodies_[at(body)].stirred = sweep;
    }
  }
}

// Onto the motions in which no point of restitution up to that approaches, as far as that reaches.
void CrowdRestitution::projectAll(double most) {
  std::vector<int> chosen;
  std::vector<char> isChosen;
  const auto choose = [&](std::span<const int> more) {
    isChosen.resize(points_.size(), 0);
    for (const int p : more) {
      if (isChosen[at(p)] == 0 && points_[at(p)].mass > 0 && points_[at(p)].restitution <= most) {
        isChosen[at(p)] = 1;
        points_[at(p)].ofPass = 0;
        chosen.push_back(p);
      }
    }
  };
  choose(front_);
  std::vector<char> isReached;
  for (Reached& body : bodies_) {
    body.stirred = 0;
  }
  bool moves = true;
  for (int sweep = 1; sweep <= kProjectionSweeps && moves; ++sweep) {
    moves = false;
    for (const int p : chosen) {
      Point& point = points_[at(p)];
      if (!isDue(point, sweep) || (point.ofPass == 0 && speed(point) >= -slow_)) {
        continue;
      }
      ++visits_;
      if (solveAt(point) > kRounded * slow_) {
        stir(point, sweep);
        moves = true;
      }
    }
    for (const int body : changed_) {
      bodies_[at(body)].changed = false;
      isReached.resize(bodies_.size(), 0);
      if (isReached[at(body)] == 0) {
        isReached[at(body)] = 1;
        listPoints(bodies_[at(body)]);
        choose(bodies_[at(body)].points);
      }
    }
    changed_.clear();
  }
  for (const int p : chosen) {
    points_[at(p)].impulse += points_[at(p)].ofPass;
    note(points_[at(p)]);
  }
  findFront(chosen);
}

// One step of Gauss–Seidel against its sliding; returns by how much [m/s].
double CrowdRestitution::rubAt(Point& point) {
  const Vec3 sliding = this->sliding(point);
  const double speed = sliding.norm();
  const double most = point.friction * (point.ofPass + std::max(0.0, point.whole - point.plastic));
  Vec3 rubbing = point.rubbing;
  double mass = point.mass;
  if (speed > 0) {
    double inverse = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      if (point.bodies[side] != kNobody) {
        const SolverBody& body = bodies_[at(point.bodies[side])].mass;
        const Vec3 turn = point.arms[side].cross(sliding) / speed;
        inverse += body.inverseMass + dot(turn, body.turned(turn));
      }
    }
    mass = 1 / inverse;
    rubbing -= mass * sliding;
  }
  const double size = rubbing.norm();
  if (size > most) {
    rubbing *= most / size;
  }
  const Vec3 more = rubbing - point.rubbing;
  point.rubbing = rubbing;
  push(point, more);
  return more.norm() / mass;
}

// What plastic impulses take with friction, whose cones are those of the whole impulses.
void CrowdRestitution::rub() {
  std::vector<int> acting;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    Point& point = points_[p];
    point.ofPass = point.plastic;
    if (point.plastic > 0 || point.whole > 0) {
      acting.push_back(static_cast<int>(p));
    }
  }
  for (Reached& body : bodies_) {
    body.stirred = 0;
  }
  bool moves = true;
  for (int sweep = 1; sweep <= kProjectionSweeps && moves; ++sweep) {
    moves = false;
    for (const int p : acting) {
      Point& point = points_[at(p)];
      if (!isDue(point, sweep)) {
        continue;
      }
      if (std::max(solveAt(point), point.friction > 0 ? rubAt(point) : 0.0) > kRounded * slow_) {
        stir(point, sweep);
        moves = true;
      }
    }
  }
  for (const int p : acting) {
    Point& point = points_[at(p)];
    point.taken = -0.5 * (point.ofPass * (point.before + speed(point)) +
                          dot(point.rubbing, point.slip + sliding(point)));
  }
}

// Reflections about the contacts of restitution above the threshold; where none of those approaches,
// projection onto the motions in which no other one does; until none approaches.
void CrowdRestitution::reflect(double threshold) {
  restart();
  std::vector<int> approaching;
  for (visits_ = 0; visits_ <= kVisits + kVisitsOfPoint * points_.size();) {
    findApproaching(approaching);
    if (approaching.empty()) {
      return;
    }
    const auto others = std::stable_partition(approaching.begin(), approaching.end(),
                                              [&](int p) { return points_[at(p)].restitution > threshold; });
    if (others == approaching.begin()) {
      projectAll(threshold);
      continue;
    }
    const std::span<const int> elastic(approaching.begin(), others);
    project(elastic);
    for (const int p : elastic) {
      Point& point = points_[at(p)];
      point.impulse += 2 * point.ofPass;
      push(point, point.ofPass);
    }
    findFront(approaching);
  }
  projectAll(std::numeric_limits<double>::infinity());
}

// The e of what took impulses, ascending; where they are too many, even parts of the largest.
std::vector<double> CrowdRestitution::levels() const {
  std::vector<double> levels;
  for (const Point& point : points_) {
    if (point.restitution > 0 && point.impulse > 0) {
      levels.push_back(point.restitution);
    }
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  if (levels.size() > kMostLevels) {
    const double top = levels.back();
    levels.clear();
    for (std::size_t k = 1; k <= kMostLevels; ++k) {
      levels.push_back(top * static_cast<double>(k) / kMostLevels);
    }
  }
  return levels;
}

void CrowdRestitution::resolve(double slow) {
  slow_ = std::max(slow, kReflected * fastest_);
  restart();
  projectAll(std::numeric_limits<double>::infinity());
  for (Point& point : points_) {
    point.plastic = point.impulse;
  }
  reflect(0);
  double below = 0;
  for (const double level : levels()) {
    if (below > 0) {
      reflect(below);
    }
    for (Point& point : points_) {
      point.whole += (level - below) * point.impulse;
    }
    below = level;
  }
  for (Point& point : points_) {
    point.whole += (1 - below) * point.plastic;
  }
  setVelocities([](const Point& point) { return point.plastic; });
  for (Point& point : points_) {
    point.afterPlastic = speed(point);
  }
  rub();
  setVelocities([](const Point& point) { return point.whole - point.plastic; });
  for (Point& point : points_) {
    point.added = speed(point) - point.before;
  }
}

}  // namespace careen
