#include "physics/search/neighbors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.h"
#include "physics/search/concave_bound.h"

namespace careen {
namespace {

constexpr double kLarge = 4;            // [1] times the median radius
constexpr double kMargin = 1.0 / 16;    // [1] of an edge: hysteresis before a body changes cell
constexpr double kMostCells = 0x1p+52;  // beyond, adjacent cells cannot be distinguished
constexpr double kNeverCrosses = std::numeric_limits<double>::max();

// [s] First t ≥ from with position + v t + ½ a t² = limit, from below. If already at or above it: `from`.
double whenAbove(double limit, double position, double velocity, double acceleration, double from) {
  const double room = limit - (position + (velocity + 0.5 * from * acceleration) * from);
  if (room <= 0) {
    return from;
  }
  const double more = firstRoot(room, -(velocity + from * acceleration), acceleration, kNeverCrosses);
  return more < kNeverCrosses ? from + more : kNeverCrosses;
}

}  // namespace

std::size_t Neighbors::CellHash::operator()(const Cell& cell) const {
  std::uint64_t h = 0;
  for (const std::int64_t part : cell) {
    h = (h ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15U;
    h ^= h >> 29U;
  }
  return static_cast<std::size_t>(h);
}

Neighbors::Neighbors(std::span<const double> radii) {
  if (radii.size() <= kFew) {
    return;
  }
  std::vector<double> sorted(radii.begin(), radii.end());
  std::sort(sorted.begin(), sorted.end());
  const double most = kLarge * sorted[(sorted.size() - 1) / 2];
  for (const double radius : sorted) {
    if (radius <= most) {
      largestFiled_ = radius;
    }
  }
  // Spheres two cells apart: edge − 2 margins ≥ one diameter.
  edge_ = 2 * largestFiled_ / (1 - 2 * kMargin);
}

Cell Neighbors::cellOf(const Vec3& position) const {
  Cell cell{};
  for (int i = 0; i < 3; ++i) {
    const double at = std::floor(position(i) / edge_);
    if (!(std::fabs(at) < kMostCells)) {
      throw NumericalError("a body is too far away, for its size, to look for its neighbours");
    }
    cell[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(at);
  }
  return cell;
}

void Neighbors::insert(Key body, const Vec3& position, double radius) {
  const bool filed = edge_ > 0 && radius <= largestFiled_;
  const Cell cell = filed ? cellOf(position) : Cell{};
  if (!places_.emplace(body, Place{.cell = cell, .filed = filed}).second) {
    throw NumericalError("a body was given to the neighbour search twice");
  }
  if (filed) {
    file(body, cell);
  } else {
    large_.insert(std::lower_bound(large_.begin(), large_.end(), body), body);
  }
}

void Neighbors::erase(Key body) {
  const Place place = places_.at(body);
  if (place.filed) {
    unfile(body, place.cell);
  } else {
    large_.erase(std::lower_bound(large_.begin(), large_.end(), body));
  }
  places_.erase(body);
}

void Neighbors::move(Key body, const Cell& cell) {
  Place& place = places_.at(body);
  if (place.filed && place.cell != cell) {
    unfile(body, place.cell);
    file(body, cell);
    place.cell = cell;
  }
}

void Neighbors::file(Key body, const Cell& cell) { cells_[cell].push_back(body); }

void Neighbors::unfile(Key body, const Cell& cell) {
  const auto found = cells_.find(cell);
  std::erase(found->second, body);
  if (found->second.empty()) {
    cells_.erase(found);
  }
}

void Neighbors::findCandidates(Key body, std::vector<Key>& candidates) const {
  candidates.clear();
  const Place& place = places_.at(body);
  if (!place.filed) {
    for (const auto& [key, other] : places_) {
      candidates.push_back(key);
    }
  } else {
    candidates.assign(large_.begin(), large_.end());
    anyAround(place.cell, [&](const std::vector<Key>& filed) {
      candidates.insert(candidates.end(), filed.begin(), filed.end());
      return false;
    });
  }
  std::erase(candidates, body);
  std::sort(candidates.begin(), candidates.end());
}

void Neighbors::findWithin(const Vec3& low, const Vec3& high, std::vector<Key>& found) const {
  found.clear();
  if (!(low.array() <= high.array()).all()) {
    return;
  }
  // A centre may be outside its cell by as much as it may before it is filed anew, and what is filed ahead of
  // its step by half of that.
  const Vec3 reach = Vec3::Constant(largestFiled_ + 2 * kMargin * edge_);
  const double cells = edge_ > 0 ? Vec3((high - low + 2 * reach) / edge_ + Vec3::Ones()).prod()
                                 : std::numeric_limits<double>::infinity();
  if (!(cells < static_cast<double>(places_.size()))) {
    for (const auto& [key, place] : places_) {
      found.push_back(key);
    }
  } else {
    found.assign(large_.begin(), large_.end());
    const Cell first = cellOf(low - reach);
    const Cell last = cellOf(high + reach);
    for (std::int64_t x = first[0]; x <= last[0]; ++x) {
      for (std::int64_t y = first[1]; y <= last[1]; ++y) {
        for (std::int64_t z = first[2]; z <= last[2]; ++z) {
          if (const auto cell = cells_.find({x, y, z}); cell != cells_.end()) {
            found.insert(found.end(), cell->second.begin(), cell->second.end());
          }
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
}

Neighbors::Crossing Neighbors::nextCrossing(const Vec3& position, const Vec3& velocity,
                                            const Vec3& acceleration, const Cell& cell, double from) const {
  Crossing first{.time = kNeverCrosses, .cell = cell};
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto low = static_cast<double>(cell[k]);
    const double upper = edge_ * (low + 1 + kMargin);
    const double lower = edge_ * (low - kMargin);
    const double up = whenAbove(upper, position(i), velocity(i), acceleration(i), from);
    const double down = whenAbove(-lower, -position(i), -velocity(i), -acceleration(i), from);
    const double time = std::min(up, down);
    if (time < first.time) {
      first = {.time = time, .cell = cell};
      first.cell[k] += up <= down ? 1 : -1;
    }
  }
  return first;
}

double Neighbors::room(const Vec3& position, const Cell& cell) const {
  double least = kNeverCrosses;
  for (int i = 0; i < 3; ++i) {
    const double inside = position(i) / edge_ - static_cast<double>(cell[static_cast<std::size_t>(i)]);
    least = std::min(least, std::min(inside, 1 - inside) + kMargin);
  }
  return least * edge_;
}

Neighbors::Crossing Neighbors::nextCrossing(const Flight& flight, double lasts, const Cell& cell,
                                            double from) const {
  if (flight.jerk.isZero(0)) {
    return nextCrossing(flight.position, flight.velocity, flight.acceleration, cell, from);
  }
  const double most = std::max(flight.acceleration.norm(), flight.accelerationAt(lasts).norm());
  for (double time = from; time < lasts;) {
    const Vec3 position = flight.positionAt(time);
    const double left = room(position, cell);
    if (left < kMargin / 4 * edge_) {
      return {.time = time, .cell = cellOf(position)};
    }
    // v t + ½ a t² ≤ room
    const double speed = flight.velocityAt(time).norm();
    time += 2 * left / (speed + std::sqrt(speed * speed + 2 * most * left));
  }
  return {.time = kNeverCrosses, .cell = cell};
}

// Conservative advancement: in each pass by the time in which the fastest would use up the room.
Neighbors::Crossing Neighbors::nextCrossing(const ContactStep& step, double speedBound, const Cell& cell,
                                            double from) const {
  for (double time = from; time < step.duration;) {
    const Vec3 position = positionAt(step, time);
    const double left = room(position, cell);
    if (left < kMargin / 4 * edge_) {
      return {.time = time, .cell = cellOf(position)};
    }
    time += left / speedBound;
  }
  return {.time = kNeverCrosses, .cell = cell};
}

}  // namespace careen
