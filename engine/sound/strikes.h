#pragma once

#include <vector>

#include "sound/film_clock.h"
#include "trajectory/trajectory.h"
#include "view/camera_path.h"

namespace careen {

/// What a body that can move is given by an impact, for its sound.
struct Strike {
  double time = 0;  ///< [s] of the film
  std::size_t body = 0;
  Vec3 point = Vec3::Zero();    ///< [m] from the middle of its box, along its axes
  Vec3 impulse = Vec3::Zero();  ///< [N s] along its axes, normal to the contact
  double contact = 0;           ///< [s] how long it lasts, by Hertz: brighter if shorter
  double distance = 1;          ///< [m] from the camera
};

/// Of all impacts that the film shows, in its order of time. Hertz's time of contact of balls, 2.87 (m²/(R E²
/// v))^⅕ (K. L. Johnson, Contact Mechanics, 11.4), with rounded corners as radii: a twentieth of the smallest
/// half side.
std::vector<Strike> strikesOf(const Trajectory& run, const FilmClock& clock, const CameraPath& camera);

/// What a body of the run sounds like, and what it strikes.
SoundMaterial soundOf(const Stage& stage, std::size_t body);
SoundMaterial soundOf(const Stage& stage, const Partner& partner);

}  // namespace careen
