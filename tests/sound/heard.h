#pragma once

#include <cmath>
#include <numbers>
#include <span>

#include "scene/plan.h"
#include "scene/scene.h"
#include "trajectory/trajectory.h"

namespace careen {

/// A wooden box of 2 kg, 1 m by 0.4 m by 0.2 m, that falls flat by so much [m] and bounces.
inline Scene drop(double height) {
  Scene scene;
  scene.gravity = Vec3(0, 0, -10);
  scene.settings.duration = 1;
  scene.walls = {{.name = "floor", .normal = Vec3::UnitZ(), .offset = 0, .material = {}}};
  scene.wallSounds.resize(1);
  SceneBox& box = scene.boxes.emplace_back();
  box.name = "box";
  box.halfExtents = Vec3(0.5, 0.2, 0.1);
  box.mass = 2;
  box.pose.position = Vec3(0, 0, 0.1 + height);
  box.material.restitution = 0.5;
  scene.camera = Camera{.eye = Vec3(0, -4, 1), .target = Vec3(0, 0, 0.5)};
  return scene;
}
inline Trajectory dropped(double height) { return record(setupOf(drop(height))); }

/// How much of a tone [Hz] is in these samples, of a sampling rate of 48 kHz: a Fourier sum.
inline double toneIn(std::span<const double> samples, double tone) {
  double re = 0;
  double im = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double angle = 2 * std::numbers::pi * tone * static_cast<double>(k) / 48000;
    re += samples[k] * std::cos(angle);
    im += samples[k] * std::sin(angle);
  }
  return std::hypot(re, im);
}

}  // namespace careen
