#include "view/orbit.h"

#include <algorithm>
#include <cmath>

namespace careen {
namespace {

double elevationOf(const Camera& camera) {
  const Vec3 back = (camera.eye - camera.target).normalized();
  return std::asin(std::clamp(back.dot(camera.up.normalized()), -1.0, 1.0));
}

// The film's elevation plus `added`, within limits.
double withinReach(double film, double added) {
  const double reach = std::max(kSteepest, std::abs(film));
  return std::clamp(film + added, -reach, reach);
}

}  // namespace

Camera orbited(const Camera& film, const Orbit& orbit) {
  if (orbit == Orbit()) {
    return film;
  }
  const Vec3 up = film.up.normalized();
  const Vec3 back = film.eye - film.target;
  const Vec3 level = (back - up * up.dot(back)).normalized();
  const Vec3 turnedLevel = level * std::cos(orbit.azimuth) + up.cross(level) * std::sin(orbit.azimuth);
  const double elevation = withinReach(elevationOf(film), orbit.elevation);
  Camera camera = film;
  camera.eye = film.target +
               back.norm() * orbit.distance * (turnedLevel * std::cos(elevation) + up * std::sin(elevation));
  return camera;
}

Orbit turned(const Orbit& orbit, const Camera& film, const Orbit& by) {
  const double elevation = elevationOf(film);
  return {.azimuth = orbit.azimuth + by.azimuth,
          .elevation = withinReach(elevation, orbit.elevation + by.elevation) - elevation,
          .distance = std::clamp(orbit.distance * by.distance, kNearest, kFarthest)};
}

}  // namespace careen
