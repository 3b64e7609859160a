#include "sound/ringing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>

#include "core/math/elementary.h"
#include "sound/block_modes.h"

namespace careen {
namespace {

constexpr double kHighest = 20'000;     // [Hz] that is heard
constexpr std::size_t kMostModes = 24;  // of a body
constexpr double kSilence = 1e-6;       // of the loudest beginning of a mode: −120 dB
constexpr double kFrozen = 0.02;        // [s] what rings falls silent within this time of a frozen picture
constexpr double kSwitched = 0.005;     // [s] within which a mode is heard that was too high before
constexpr double kStep = 1.0 / kSampleRate;  // [s]

/// A complex number, whose imaginary part is heard.
struct Phasor {
  double re = 0;
  double im = 0;
  Phasor operator*(const Phasor& by) const { return {re * by.re - im * by.im, re * by.im + im * by.re}; }
};

// How a mode goes on over this time [s]: e^((−α + iω) time).
Phasor turnOver(const BlockMode& mode, double time) {
  const double decay = elementary::exp(-std::numbers::pi * mode.damping * mode.frequency * time);
  const auto turn = elementary::sinCos(2 * std::numbers::pi * mode.frequency * time);
  return {decay * turn.cos, decay * turn.sin};
}

// [Pa] of a body's mode for each metre per second: a small source of its surface, or a large one's plane
// wave.
double radiation(const BlockMode& mode, const Vec3& half) {
  const double surface = 8 * (half.x() * half.y() + half.y() * half.z() + half.z() * half.x());
  const double radius = std::sqrt(surface / (4 * std::numbers::pi));
  const double wave = 2 * std::numbers::pi * mode.frequency / kSpeedOfSound;
  return kAirDensity * kSpeedOfSound * radius * std::min(1.0, wave * radius);
}

/// A mode of a body, and its strikes, in order of time.
struct StruckMode {
  BlockMode mode;
  std::span<const Strike> strikes;
  std::vector<double> loudness;  ///< [Pa] of each strike
};

/// Its sound, from `floor` [Pa] on.
class Ringing {
 public:
  Ringing(const StruckMode& struck, double floor)
      : mode_(struck.mode), strikes_(struck.strikes), loudness_(struck.loudness), floor_(floor) {}

  void addTo(std::span<double> samples, std::int64_t first, std::span<const SampleRun> runs, Pitch pitch) {
    for (const SampleRun& run : runs) {
      rate_ = pitch == Pitch::kStays ? 1 : run.sceneStep / kStep;
      const bool fades = pitch == Pitch::kSlows && run.sceneStep == 0;
      turn_ = fades ? Phasor{elementary::exp(-kStep / kFrozen), 0} : turnOver(mode_, rate_ * kStep);
      const double heard = audible();
      for (std::int64_t k = run.first; k < run.end;) {
        k = silentUntil(k, run.end);
        if (k < run.end) {
          weight_ += (heard - weight_) * (kStep / kSwitched);
          samples[static_cast<std::size_t>(k - first)] += weight_ * state_.im;
          state_ = state_ * turn_;
          takeUntil(k + 1);
          ++k;
        }
      }
    }
  }

 private:
  // The next sample at which it is heard.
  std::int64_t silentUntil(std::int64_t sample, std::int64_t end) {
    if (state_.re * state_.re + state_.im * state_.im > floor_ * floor_) {
      return sample;
    }
    state_ = {};
    if (next_ == strikes_.size()) {
      return end;
    }
    const auto struck = static_cast<std::int64_t>(std::ceil(strikes_[next_].time * kSampleRate));
    const std::int64_t at = std::clamp(struck, sample, end);
    if (at < end) {
      takeUntil(at);
      weight_ = audible();
    }
    return at;
  }

  // 1 below the highest tone, and 0 from a tenth above it on.
  double audible() const { return std::clamp(10 * (1.1 - mode_.frequency * rate_ / kHighest), 0.0, 1.0); }

  // Strikes until this sample, as they are there.
  void takeUntil(std::int64_t sample) {
    const double time = static_cast<double>(sample) / kSampleRate;
    for (; next_ < strikes_.size() && strikes_[next_].time <= time; ++next_) {
      const Phasor since = turnOver(mode_, rate_ * (time - strikes_[next_].time));
      state_.re += loudness_[next_] * since.re;
      state_.im += loudness_[next_] * since.im;
    }
  }

  const BlockMode& mode_;
  std::span<const Strike> strikes_;
  std::span<const double> loudness_;
  double floor_;
  Phasor state_;
  Phasor turn_;
  double rate_ = 1;
  double weight_ = 1;
  std::size_t next_ = 0;
};

double loudnessOf(const BlockMode& mode, const Body& body, const Strike& strike) {
  const double mass = 1 / body.mass.inverseMass;
  const double slow = 2 * mode.frequency * strike.contact;  // of a half sine of force, about
  return excitation(mode, body.halfExtents, mass, strike.point, strike.impulse) / (1 + slow * slow) *
         radiation(mode, body.halfExtents) / strike.distance;
}

}  // namespace

void addRinging(std::span<double> samples, std::int64_t first, const Trajectory& run, const FilmClock& clock,
                const std::vector<Strike>& strikes, Pitch pitch) {
  const std::vector<SampleRun> runs = clock.runs(first, first + std::ssize(samples));
  double slowest = 1;
  for (const SampleRun& each : runs) {
    if (pitch == Pitch::kSlows && each.sceneStep > 0 && each.end > each.first + 1) {
      slowest = std::min(slowest, each.sceneStep / kStep);
    }
  }
  std::map<std::size_t, std::vector<Strike>> byBody;
  for (const Strike& strike : strikes) {
    byBody[strike.body].push_back(strike);
  }
  std::vector<StruckMode> all;
  double loudest = 0;
  for (const auto& [index, ofBody] : byBody) {
    const Body& body = run.world.bodies[index];
    const SoundMaterial& material = soundOf(run.stage, index);
    for (const BlockMode& mode : modesOf(body.halfExtents, material, kHighest / slowest, kMostModes)) {
      StruckMode& struck = all.emplace_back(StruckMode{.mode = mode, .strikes = ofBody, .loudness = {}});
      for (const Strike& strike : ofBody) {
        struck.loudness.push_back(loudnessOf(mode, body, strike));
        loudest = std::max(loudest, std::fabs(struck.loudness.back()));
      }
    }
  }
  for (const StruckMode& struck : all) {
    Ringing(struck, kSilence * loudest).addTo(samples, first, runs, pitch);
  }
}

}  // namespace careen
