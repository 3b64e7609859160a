#include "study/own_methods.h"

#include "physics/simulate.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"
#include "study/sampled_states.h"
#include "trajectory/trajectory.h"

namespace careen {
namespace {

class OwnMethod : public Contestant {
 public:
  explicit OwnMethod(const MethodTraits& traits) : traits_(traits) {}

  std::string name() const override { return std::string(traits_.name); }
  std::string settings() const override {
    if (!traits_.steps()) {
      return "careen: closed forms from impact to impact; contact in adaptive time steps that hold the "
             "tolerance";
    }
    return "careen: order " + std::to_string(traits_.order) +
           (traits_.forces ? ", the time loop of the 1997 sample" : ", impacts at roots of the gap function");
  }
  bool steps() const override { return traits_.steps(); }

  std::string refuses(const World& world) const override {
    if (!traits_.forces && (!world.springs.empty() || world.drag)) {
      return "no springs, no drag";
    }
    if (!traits_.joints && !world.joints.empty()) {
      return "no joints";
    }
    if (!traits_.boxBox && world.bodies.size() > 1) {
      return "no collisions between boxes";
    }
    return "";
  }

  std::vector<std::vector<BodyState>> run(const World& world, double fineness, std::span<const double> times,
                                          const std::stop_token& stop) const override {
    SampledStates states(world, times);
    simulate(world, settingsOf(fineness, times.back()), states, stop);
    return states.finish();
  }

  std::optional<Audit> audited(const World& world, double fineness, double duration,
                               const std::stop_token& stop) const override {
    return audit(record(world, settingsOf(fineness, duration), "", stop), AuditDepth::kUsual, stop);
  }

 private:
  RunSettings settingsOf(double fineness, double duration) const {
    RunSettings settings{.method = traits_.method, .duration = duration};
    (traits_.steps() ? settings.dt : settings.tolerance) = fineness;
    return settings;
  }

  const MethodTraits& traits_;
};

}  // namespace

Contestants ownMethods() {
  Contestants all;
  for (const MethodTraits& traits : kMethods) {
    all.push_back(std::make_unique<OwnMethod>(traits));
  }
  return all;
}

}  // namespace careen
