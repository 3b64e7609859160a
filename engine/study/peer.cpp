#include "study/peer.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/error.h"
#include "physics/world/diagnostics.h"

namespace careen {

std::string refusalOfPeers(const World& world) {
  return !world.gravityChanges.empty()          ? "no gravity that changes"
         : hasCourses(world)                    ? "no " + whatHasCourses(world) + " that move"
         : hasBelts(world)                      ? "no surfaces that move"
         : world.springs.empty() && !world.drag ? ""
                                                : "no springs, no drag";
}

std::string Peer::refusesJoint(const Joint& joint) const {
  const bool isLine = joint.kind == Joint::Kind::kRod || joint.kind == Joint::Kind::kRope;
  return isLine ? "no rods, no ropes" : joint.isLoaded() ? "no springs, no friction of joints" : "";
}

std::string Peer::refuses(const World& world) const {
  std::string why = world.control ? "no motors" : refusalOfPeers(world);
  for (const Joint& joint : world.joints) {
    if (why.empty()) {
      why = std::isfinite(joint.until) ? "no joints that let go" : refusesJoint(joint);
    }
  }
  return why;
}

std::vector<std::vector<BodyState>> Peer::run(const World& world, double dt, std::span<const double> times,
                                              const std::stop_token& stop) const {
  const std::unique_ptr<Engine> engine = feed(world);
  std::vector<std::vector<BodyState>> states;
  double now = 0;
  for (const double time : times) {
    // The factor prevents rounding from splitting an interval of n steps into n + 1.
    const double steps = std::ceil((time - now) / dt * (1 - 1e-12));
    if (!(steps < 0x1p53)) {
      throw NumericalError(name() + ": its steps are too many to be counted");
    }
    const auto count = static_cast<std::int64_t>(steps);
    for (std::int64_t k = 0; k < count; ++k) {
      if (stop.stop_requested()) {
        throw Interrupted();
      }
      engine->step((time - now) / static_cast<double>(count));
    }
    now = time;

    std::vector<BodyState>& sampled = states.emplace_back();
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      const Body& body = world.bodies[i];
      sampled.push_back(isImmovable(body.mass) ? BodyState{.pose = body.initial.pose} : engine->state(i));
      if (!isFinite(sampled.back())) {
        throw NumericalError(name() + ": the state of " + body.name +
                             " is not finite by t = " + std::to_string(time) + " s");
      }
    }
  }
  return states;
}

}  // namespace careen
