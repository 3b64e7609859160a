#include "physics/pile/crowd_restitution.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

void CrowdRestitution::restart() {
  reached_.setVelocities([](const ReachedPoint&) { return 0.0; });
  front_.clear();
  for (std::size_t p = 0; p < reached_.points().size(); ++p) {
    reached_.points()[p].impulse = 0;
    if (reached_.points()[p].strikes) {
      front_.push_back(static_cast<int>(p));
    }
  }
}

void CrowdRestitution::findApproaching(std::vector<int>& approaching) const {
  approaching.clear();
  for (const int p : front_) {
    const ReachedPoint& point = reached_[p];
    if (point.mass > 0 && reached_.speed(point) < -slow_) {
      approaching.push_back(p);
    }
  }
}

// To begin with: equal impulses at points of a manifold that approach alike, so that what meets flat is not
// turned. Gauss–Seidel alone takes a hundred sweeps to undo that.
void CrowdRestitution::guess(std::span<const int> ofManifold) {
  ReachedContacts::Velocities velocities;
  reached_.swap(reached_[ofManifold.front()], velocities);
  for (const int p : ofManifold) {
    reached_.push(reached_[p], 1);
  }
  for (const int p : ofManifold) {
    reached_[p].ofPass = dot(reached_[p].normal, reached_.change(reached_[p]));
  }
  reached_.swap(reached_[ofManifold.front()], velocities);
  for (const int p : ofManifold) {
    const double change = reached_[p].ofPass;
    reached_[p].ofPass = change > 0 ? std::max(0.0, -reached_.speed(reached_[p]) / change) : 0;
  }
  for (const int p : ofManifold) {
    reached_.push(reached_[p], reached_[p].ofPass);
  }
}

// One step of Gauss–Seidel; returns by how much [m/s].
double CrowdRestitution::solveAt(ReachedPoint& point) {
  const double impulse = std::max(-reached_.speed(point) * point.mass, -point.ofPass);
  point.ofPass += impulse;
  reached_.push(point, impulse);
  return std::fabs(impulse) / point.mass;
}

// Onto the motions in which none of the chosen approaches, by Gauss–Seidel.
void CrowdRestitution::project(std::span<const int> chosen) {
  for (auto first = chosen.begin(); first != chosen.end();) {
    const int slot = reached_[*first].slot;
    const auto last = std::find_if(first, chosen.end(), [&](int p) { return reached_[p].slot != slot; });
    guess({first, last});
    first = last;
  }
  double largest = std::numeric_limits<double>::infinity();
  for (int sweep = 0; sweep < kProjectionSweeps && largest > kFound * reached_.fastest(); ++sweep) {
    largest = 0;
    visits_ += chosen.size();
    for (const int p : chosen) {
      largest = std::max(largest, solveAt(reached_[p]));
    }
  }
}

// Onto the motions in which no point of restitution up to that approaches, as far as that reaches.
void CrowdRestitution::projectAll(double most) {
  std::vector<int> chosen;
  std::vector<char> isChosen;
  const auto choose = [&](std::span<const int> more) {
    isChosen.resize(reached_.points().size(), 0);
    for (const int p : more) {
      if (isChosen[at(p)] == 0 && reached_[p].mass > 0 && reached_[p].restitution <= most) {
        isChosen[at(p)] = 1;
        reached_[p].ofPass = 0;
        chosen.push_back(p);
      }
    }
  };
  choose(front_);
  const auto solve = [&](ReachedPoint& point) {
    if (point.ofPass == 0 && reached_.speed(point) >= -slow_) {
      return 0.0;
    }
    ++visits_;
    return solveAt(point);
  };
  reached_.sweep(chosen, kProjectionSweeps, kRounded * slow_, solve, [&] { reached_.forPushed(choose); });
  for (const int p : chosen) {
    reached_[p].impulse += reached_[p].ofPass;
    reached_.note(reached_[p]);
  }
  reached_.findFront(chosen, front_);
}

// One step of Gauss–Seidel against its sliding; returns by how much [m/s].
double CrowdRestitution::rubAt(ReachedPoint& point) {
  const Vec3 sliding = reached_.sliding(point);
  const double speed = sliding.norm();
  const double most = point.friction * (point.ofPass + std::max(0.0, point.whole - point.plastic));
  Vec3 rubbing = point.rubbing;
  double mass = point.mass;
  if (speed > 0) {
    mass = reached_.massAlong(point, sliding, speed);
    rubbing -= mass * sliding;
  }
  const double size = rubbing.norm();
  if (size > most) {
    rubbing *= most / size;
  }
  const Vec3 more = rubbing - point.rubbing;
  point.rubbing = rubbing;
  reached_.push(point, more);
  return more.norm() / mass;
}

// What plastic impulses take with friction, whose cones are those of the whole impulses.
void CrowdRestitution::rub() {
  std::vector<int> acting;
  for (std::size_t p = 0; p < reached_.points().size(); ++p) {
    ReachedPoint& point = reached_.points()[p];
    point.ofPass = point.plastic;
    if (point.plastic > 0 || point.whole > 0) {
      acting.push_back(static_cast<int>(p));
    }
  }
  const auto solve = [&](ReachedPoint& point) {
    const double rubbed = point.friction > 0 ? rubAt(point) : 0.0;  // first: arguments have no order
    return std::max(solveAt(point), rubbed);
  };
  reached_.sweep(acting, kProjectionSweeps, kRounded * slow_, solve, [] {});
  for (const int p : acting) {
    ReachedPoint& point = reached_[p];
    point.taken = -0.5 * (point.ofPass * (point.before + reached_.speed(point)) +
                          dot(point.rubbing, point.slip + reached_.sliding(point)));
  }
}

// Reflections about the contacts of restitution above the threshold; where none of those approaches,
// projection onto the motions in which no other one does; until none approaches.
void CrowdRestitution::reflect(double threshold) {
  restart();
  std::vector<int> approaching;
  for (visits_ = 0; visits_ <= kVisits + kVisitsOfPoint * reached_.points().size();) {
    findApproaching(approaching);
    if (approaching.empty()) {
      return;
    }
    const auto others = std::stable_partition(approaching.begin(), approaching.end(),
                                              [&](int p) { return reached_[p].restitution > threshold; });
    if (others == approaching.begin()) {
      projectAll(threshold);
      continue;
    }
    const auto elastic = std::span(approaching).first(static_cast<std::size_t>(others - approaching.begin()));
    project(elastic);
    for (const int p : elastic) {
      ReachedPoint& point = reached_[p];
      point.impulse += 2 * point.ofPass;
      reached_.push(point, point.ofPass);
    }
    reached_.findFront(approaching, front_);
  }
  projectAll(std::numeric_limits<double>::infinity());
}

// The e of what took impulses, ascending; where they are too many, even parts of the largest.
std::vector<double> CrowdRestitution::levels() const {
  std::vector<double> levels;
  for (const ReachedPoint& point : reached_.points()) {
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
  slow_ = std::max(slow, kReflected * reached_.fastest());
  restart();
  projectAll(std::numeric_limits<double>::infinity());
  for (ReachedPoint& point : reached_.points()) {
    point.plastic = point.impulse;
  }
  reflect(0);
  double below = 0;
  for (const double level : levels()) {
    if (below > 0) {
      reflect(below);
    }
    for (ReachedPoint& point : reached_.points()) {
      point.whole += (level - below) * point.impulse;
    }
    below = level;
  }
  for (ReachedPoint& point : reached_.points()) {
    point.whole += (1 - below) * point.plastic;
  }
  reached_.setVelocities([](const ReachedPoint& point) { return point.plastic; });
  for (ReachedPoint& point : reached_.points()) {
    point.afterPlastic = reached_.speed(point);
  }
  rub();
  reached_.setVelocities([](const ReachedPoint& point) { return point.whole - point.plastic; });
  for (ReachedPoint& point : reached_.points()) {
    point.added = reached_.speed(point) - point.before;
  }
}

}  // namespace careen
