#include "sound/strikes.h"

#include <algorithm>
#include <optional>

#include "core/math/elementary.h"
#include "sound/block_modes.h"

namespace careen {
namespace {

constexpr double kRounded = 0.05;  // [1] radius of corners, of the smallest half side
constexpr double kHertz = 2.87;    // [1]
constexpr double kNearest = 0.1;   // [m] of a camera that a box passes through
constexpr double kSlowest = 1e-3;  // [m/s] of what jams and does not approach

double inverseStiffness(const SoundMaterial& material) {
  return (1 - kPoisson * kPoisson) / material.modulus;
}

double contactTime(const Trajectory& run, const Impact& impact) {
  const auto a = static_cast<std::size_t>(impact.a.value);
  double inverseMass = run.world.bodies[a].mass.inverseMass;
  double smallest = run.world.bodies[a].thinnest();
  if (!impact.b.isWall()) {
    const Body& other = run.world.bodies[static_cast<std::size_t>(impact.b.body())];
    inverseMass += other.mass.inverseMass;
    smallest = std::min(smallest, other.thinnest());
  }
  const double compliance =
      inverseStiffness(soundOf(run.stage, a)) + inverseStiffness(soundOf(run.stage, impact.b));
  const double speed = std::max({impact.approach, 0.5 * impact.impulse * inverseMass, kSlowest});
  const double fifth = compliance * compliance / (inverseMass * inverseMass * kRounded * smallest * speed);
  return kHertz * elementary::exp(elementary::log(fifth) / 5);
}

}  // namespace

SoundMaterial soundOf(const Stage& stage, std::size_t body) {
  return body < stage.boxSounds.size() ? stage.boxSounds[body] : SoundMaterial();
}

SoundMaterial soundOf(const Stage& stage, const Partner& partner) {
  if (!partner.isWall()) {
    return soundOf(stage, static_cast<std::size_t>(partner.body()));
  }
  return partner.wall() < stage.wallSounds.size() ? stage.wallSounds[partner.wall()] : kSoundOfWalls;
}

std::vector<Strike> strikesOf(const Trajectory& run, const FilmClock& clock, const CameraPath& camera) {
  std::vector<Strike> strikes;
  for (const Impact& impact : run.impacts) {
    const std::optional<double> time = clock.filmTime(impact.time);
    if (!time || !(impact.impulse > 0)) {
      continue;
    }
    const double contact = contactTime(run, impact);
    const double distance = std::max(kNearest, (impact.point - camera.at(*time).eye).norm());
    const auto add = [&](std::size_t body, const Vec3& impulse) {
      if (!isImmovable(run.world.bodies[body].mass)) {
        const Pose pose = run.boxPoseAt(body, impact.time);
        strikes.push_back({.time = *time,
                           .body = body,
                           .point = pose.worldFromBody.transpose() * (impact.point - pose.position),
                           .impulse = pose.worldFromBody.transpose() * impulse,
                           .contact = contact,
                           .distance = distance});
      }
    };
    add(static_cast<std::size_t>(impact.a.value), impact.impulse * impact.normal);
    if (!impact.b.isWall()) {
      add(static_cast<std::size_t>(impact.b.body()), -impact.impulse * impact.normal);
    }
  }
  return strikes;
}

}  // namespace careen
