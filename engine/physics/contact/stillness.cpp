#include "physics/contact/stillness.h"

#include <algorithm>
#include <cmath>

#include "physics/contact/three_at.h"

namespace careen {
namespace {

using Mode = ContactForces::Mode;

/// Slip of less than this many tolerances, in the time to fall one's own size, counts as stopped.
constexpr double kStopped = 4;
/// [1] of a tolerance, in the time to fall one's own size: slip that counts as none where contacts are found
/// anew.
constexpr double kCreeps = 0.25;
/// [1] Accelerations this small relative to what pulls count as zero: rounding errors. A box on its edge that
/// leans by 1e-12 has more.
constexpr double kStill = 0x1p-42;
/// [1] The same relative to the accelerations by contact forces beyond those that carry a body alone.
constexpr double kStillLoaded = 0x1p-40;

// [N] The force of a contact along its normal; of a joint's condition all of it.
double sizeOf(const ContactForces::Force& force, const ContactFeature& feature) {
  return feature.isTwoSided() ? Vec3(force[0], force[1], force[2]).norm() : force[0];
}

// [m/s²] The largest acceleration of a body by the forces of its contacts, all in one direction: their
// rounding errors accelerate too.
double loadOf(const ContactSystem& system) {
  std::vector<double> loads(system.bodies().size(), 0.0);
  for (std::size_t c = 0; c < system.features().size(); ++c) {
    const ContactFeature& feature = system.features()[c];
    const auto add = [&](int body) {
      const auto i = static_cast<std::size_t>(body);
      loads[i] += sizeOf(system.forces().forces()[c], feature) * system.bodies()[i].body->mass.inverseMass;
    };
    add(feature.a);
    add(feature.b);
  }
  return loads.empty() ? 0 : *std::max_element(loads.begin(), loads.end());
}

bool hasNearlyStopped(const ContactSystem& system, std::size_t contact, double tolerance) {
  const double speed = system.states()[contact].slip.norm();
  const double rate = system.slipSpeedRate(contact);
  return speed > 0 && rate < 0 && speed <= kStopped * tolerance * std::sqrt(-rate / system.radius());
}

}  // namespace

bool isAtRest(const ContactSystem& system) {
  if (system.hasTime()) {
    return false;
  }
  const double still = std::max(kStill * system.pull(), kStillLoaded * (loadOf(system) - system.pull()));
  std::size_t at = 0;
  for (const TouchingBody& body : system.bodies()) {
    if (body.isHeld()) {
      continue;
    }
    const double radius = radiusOf(*body.body);
    const double linear = threeAt(system.forces().accelerations(), at).norm();
    const double turning = threeAt(system.forces().accelerations(), at + 3).norm() * radius;
    const double speed = std::max(body.velocity.norm(), body.angularVelocityBody.norm() * radius);
    if (speed > system.restSpeed() || std::max(linear, turning) > still) {
      return false;
    }
    at += kSix;
  }
  return true;
}

bool creeps(const ContactSystem& system, std::size_t contact, double tolerance) {
  const ContactFeature& feature = system.features()[contact];
  const ContactState& state = system.states()[contact];
  return (feature.material.friction > 0 || feature.grips()) &&
         (feature.grips() ? std::fabs(state.rate) : state.slip.norm()) <=
             kCreeps * tolerance * std::sqrt(system.pull() / system.radius());
}

bool stopSlip(ContactSystem& system, std::vector<double>& y, double tolerance) {
  const std::vector<Mode> kept = system.modes();
  bool stopped = false;
  for (std::size_t c = 0; c < kept.size(); ++c) {
    if (kept[c] == Mode::kSlip && hasNearlyStopped(system, c, tolerance)) {
      system.modes()[c] = Mode::kStick;
      stopped = true;
    }
  }
  if (stopped) {
    system.projectVelocities(y);
    system.modes() = kept;
  }
  return stopped;
}

}  // namespace careen
