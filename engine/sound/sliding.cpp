#include "sound/sliding.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "physics/world/kinematics.h"
#include "sound/block_modes.h"
#include "trajectory/force_samples.h"

namespace careen {
namespace {

constexpr double kEvery = 1.0 / 60;     // [s] of the scene, between moments at which friction is asked for
constexpr double kAsperity = 5e-4;      // [m] from one bump of a surface to the next
constexpr double kRadiated = 3e-5;      // [1] of the power of friction becomes sound
constexpr double kLowest = 60;          // [Hz] of the highest tones
constexpr double kHighestNoise = 8000;  // [Hz] likewise
constexpr double kBand = 8;             // [1] from the highest tones of the noise to the lowest

/// What slides at a moment of the scene.
struct Slide {
  double pressure = 0;  // [Pa²] mean square at the camera
  double tone = 0;      // [Hz] its highest, by pressure
};

Vec3 velocityAt(const Trajectory& run, const std::vector<BodyState>& states, std::size_t body,
                const Vec3& point, const Vec3& normal) {
  const Body& of = run.world.bodies[body];
  const BodyState& state = states[body];
  return pointVelocity(state.velocity, angularVelocity(of.mass, state), point - state.pose.position) +
         of.material.surface.along(normal, point);
}

// [m/s] Of a, along the contact and as seen from b.
Vec3 slipOf(const Trajectory& run, const std::vector<BodyState>& states, double time,
            const ContactPush& push) {
  Vec3 slip = velocityAt(run, states, static_cast<std::size_t>(push.a.value), push.point, push.normal);
  if (push.b->isWall()) {
    const Wall& wall = run.world.walls[push.b->wall()];
    const Kinematics moves = wallMotion(wall, time);
    slip -= wall.material.surface.along(push.normal, push.point) +
            moves.velocityAt(push.point - moves.pose.position);
  } else {
    slip -= velocityAt(run, states, static_cast<std::size_t>(push.b->body()), push.point, push.normal);
  }
  return slip - dot(slip, push.normal) * push.normal;
}

Slide slideAt(const Trajectory& run, const ForceSamples& forces, double time, const Vec3& eye) {
  Slide slide;
  const std::vector<BodyState> states = run.states(time);
  for (const ContactPush& push : forces.at(time)) {
    if (!push.b) {
      continue;
    }
    const Vec3 slip = slipOf(run, states, time, push);
    const double power = std::max(0.0, -dot(push.force, slip));
    const double distance = std::max(0.1, (push.point - eye).norm());
    const double pressure =
        kRadiated * power * kAirDensity * kSpeedOfSound / (4 * std::numbers::pi * distance * distance);
    slide.pressure += pressure;
    slide.tone += pressure * std::clamp(slip.norm() / kAsperity, kLowest, kHighestNoise);
  }
  slide.tone = slide.pressure > 0 ? slide.tone / slide.pressure : kLowest;
  return slide;
}

// −1 … 1, evenly: the bits of the sample's number, mixed (G. Steele, D. Lea, C. Flood, "Fast splittable
// pseudorandom number generators", 2014).
double noiseOf(std::int64_t sample) {
  std::uint64_t bits = static_cast<std::uint64_t>(sample + 1) * 0x9e3779b97f4a7c15U;
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
  bits ^= bits >> 31U;
  return static_cast<double>(bits >> 11U) * 0x1p-52 - 1;
}

/// Noise between two tones, of mean square 1.
class Noise {
 public:
  double next(std::int64_t sample, double tone) {
    const double high = partOf(tone);
    const double low = partOf(tone / kBand);
    smooth_ += high * (noiseOf(sample) - smooth_);
    drift_ += low * (smooth_ - drift_);
    const double p = 1 - high;
    const double q = 1 - low;
    // The sum of the squares of what an impulse becomes; noise from −1 to 1 has the mean square 1/3.
    const double passed = 2 * high * high * q * q / ((1 + p) * (1 + q) * (1 - p * q));
    return (smooth_ - drift_) / std::sqrt(passed / 3);
  }

 private:
  static double partOf(double tone) {
    const double turn = 2 * std::numbers::pi * tone / kSampleRate;
    return turn / (1 + turn);
  }
  double smooth_ = 0;
  double drift_ = 0;
};

}  // namespace

void addSliding(std::span<double> samples, std::int64_t first, const Trajectory& run, const FilmClock& clock,
                const CameraPath& camera, Pitch pitch, const std::stop_token& stop) {
  if (samples.empty()) {
    return;
  }
  const auto filmTime = [](std::int64_t sample) { return static_cast<double>(sample) / kSampleRate; };
  const double from = clock.sceneTime(filmTime(first));
  const double to = clock.sceneTime(filmTime(first + std::ssize(samples) - 1));
  const ForceSamples forces(run);
  std::vector<Slide> slides;
  const auto count = static_cast<std::int64_t>(std::ceil((to - from) / kEvery)) + 1;
  for (std::int64_t k = 0; k < count; ++k) {
    if (stop.stop_requested()) {
      throw Interrupted();
    }
    const double time = std::min(from + static_cast<double>(k) * kEvery, run.settings.duration);
    slides.push_back(slideAt(run, forces, time, camera.at(clock.filmTime(time).value_or(0)).eye));
  }
  Noise noise;
  for (const SampleRun& part : clock.runs(first, first + std::ssize(samples))) {
    const double rate = part.sceneStep * kSampleRate;
    for (std::int64_t k = part.first; k < part.end; ++k) {
      const double place = std::max(0.0, (clock.sceneTime(filmTime(k)) - from) / kEvery);
      const auto before = std::min(static_cast<std::size_t>(place), slides.size() - 1);
      const std::size_t after = std::min(before + 1, slides.size() - 1);
      const double share = std::min(1.0, place - static_cast<double>(before));
      const double pressure = (1 - share) * slides[before].pressure + share * slides[after].pressure;
      const double tone = (1 - share) * slides[before].tone + share * slides[after].tone;
      const double heard = noise.next(k, pitch == Pitch::kSlows ? std::max(1.0, tone * rate) : tone);
      samples[static_cast<std::size_t>(k - first)] += rate > 0 ? std::sqrt(pressure) * heard : 0;
    }
  }
}

}  // namespace careen
